// What a good file becomes.
#include "tests/unit/case/case_files.h"

#include <cmath>

using namespace crossray;

using CaseReader = CaseFiles;

TEST_F(CaseReader, readsTheExampleOfTheDocument)
{
    const Case c = readOne(R"(
schema  = 1
name    = "refraction/sphere_true_sphere"
summary = "On a real sphere the sphere model is exact: the exit ray is the one optics gives."
tags    = ["refraction", "exact"]

[scene]
size = [32, 48]
primitives = [{ shape = "sphere", center = [0, 0, -4], radius = 1.0, material = "glass" }]

[material]
refraction_model = "sphere"
ior              = 1.25
thickness        = 2.0

[[expect]]
output    = "RayDirWS"
truth     = "refracted_exit_direction"
tolerance = { degrees = 1e-3 }

[[expect]]
output    = "RayDirWS"
agree     = ["lavapipe", "osmesa", "swiftshader", "cpu64"]
tolerance = { degrees = 1e-4, outliers = 0.01, worst = 2 }
)");
    EXPECT_EQ(c.name, "refraction/sphere_true_sphere");
    EXPECT_EQ(c.tags, (std::vector<std::string>{"refraction", "exact"}));
    EXPECT_EQ(c.effect, TraceEffect::kRefraction); // implied by the model
    EXPECT_EQ(c.camera.width, 32);
    EXPECT_EQ(c.camera.height, 48);
    ASSERT_EQ(c.scene.primitives.size(), 1u);
    EXPECT_EQ(c.scene.primitives[0].shape, PrimitiveShape::kSphere);
    EXPECT_EQ(c.scene.primitives[0].center, glm::dvec3(0, 0, -4));
    EXPECT_EQ(c.scene.primitives[0].material, "glass");
    EXPECT_EQ(c.scene.primitives[0].ior, 1.25); // the material's, where the primitive has none of its own
    EXPECT_EQ(c.material.refractionModel, RefractionModel::kSphere);
    EXPECT_EQ(c.material.thickness, 2.0);
    ASSERT_EQ(c.expectations.size(), 2u);
    EXPECT_EQ(std::get<TruthSource>(c.expectations[0].source).quantity, "refracted_exit_direction");
    EXPECT_EQ(c.expectations[0].tolerance.degrees, 1e-3);
    EXPECT_EQ(c.expectations[0].position.line, 16);
    EXPECT_EQ(std::get<AgreeSource>(c.expectations[1].source).backends.back(), "cpu64");
    EXPECT_EQ(c.expectations[1].tolerance.outlierShare, 0.01);
    EXPECT_EQ(c.expectations[1].tolerance.worst, 2.0);
    ASSERT_EQ(c.outputs.size(), 1u);
    EXPECT_EQ(c.outputs[0].name, "RayDirWS");
}

TEST_F(CaseReader, aBoundSpeaksOfItsOutputAndFiniteOfEachOne)
{
    const Case c = readOne("schema = 1\nname = \"a\"\nsummary = \"s\"\nscene = {}\noutputs = [\"HitDepth\"]\n"
                           "[[expect]]\nfinite = true\n"
                           "[[expect]]\noutput = \"IterationCount\"\nat_most = 64\n"
                           "[[expect]]\noutput = \"RayDirWS\"\nfinite = true\nwhere = \"traced\"\n");
    ASSERT_EQ(c.outputs.size(), 3u);
    ASSERT_EQ(c.expectations.size(), 5u);
    for (size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(c.expectations[i].output.name, c.outputs[i].name);
        EXPECT_EQ(c.expectations[i].where, Where::kAll);
        EXPECT_EQ(c.expectations[i].position.line, 6);
        EXPECT_FALSE(std::get<BoundSource>(c.expectations[i].source).atMost);
    }
    EXPECT_EQ(std::get<BoundSource>(c.expectations[3].source).atMost, 64.0);
    EXPECT_EQ(c.expectations[3].where, Where::kTraced);
    EXPECT_EQ(c.expectations[4].output.name, "RayDirWS");
    EXPECT_EQ(c.expectations[4].where, Where::kTraced);
}

TEST_F(CaseReader, takesTheDefaultsOfTheStructs)
{
    const Case c = readOne(withScene(""));
    const Case d;
    EXPECT_EQ(c.camera.worldFromView, d.camera.worldFromView);
    EXPECT_EQ(c.camera.fovYDegrees, d.camera.fovYDegrees);
    EXPECT_EQ(c.camera.orthographicHeight, d.camera.orthographicHeight);
    EXPECT_EQ(c.camera.nearDistance, d.camera.nearDistance);
    EXPECT_EQ(c.camera.farDistance, d.camera.farDistance);
    EXPECT_EQ(c.camera.width, d.camera.width);
    EXPECT_EQ(c.camera.height, d.camera.height);
    EXPECT_EQ(c.camera.projection, d.camera.projection);
    EXPECT_EQ(c.camera.depthConvention, d.camera.depthConvention);
    EXPECT_EQ(c.camera.ndcDepthRange, d.camera.ndcDepthRange);
    EXPECT_EQ(c.scene.upWS, d.scene.upWS);
    EXPECT_EQ(c.scene.sky.zenith, d.scene.sky.zenith);
    EXPECT_EQ(c.scene.sky.horizon, d.scene.sky.horizon);
    EXPECT_EQ(c.scene.sky.nadir, d.scene.sky.nadir);
    EXPECT_EQ(c.material.ior, d.material.ior);
    EXPECT_EQ(c.material.thickness, d.material.thickness);
    EXPECT_EQ(c.material.thicknessMultiplier, d.material.thicknessMultiplier);
    EXPECT_EQ(c.material.roughness, d.material.roughness);
    EXPECT_EQ(c.material.refractionModel, d.material.refractionModel);
    EXPECT_EQ(c.projection.model, d.projection.model);
    EXPECT_EQ(c.projection.hiz.minLevel, d.projection.hiz.minLevel);
    EXPECT_EQ(c.projection.hiz.maxLevel, d.projection.hiz.maxLevel);
    EXPECT_EQ(c.projection.hiz.maxIterations, d.projection.hiz.maxIterations);
    EXPECT_EQ(c.projection.hiz.depthBias, d.projection.hiz.depthBias);
    EXPECT_EQ(c.projection.screenWeightDistance, d.projection.screenWeightDistance);
    EXPECT_EQ(c.projection.screenWeightForm, d.projection.screenWeightForm);
    EXPECT_EQ(c.projection.proxy.center, d.projection.proxy.center);
    EXPECT_EQ(c.effect, d.effect);
    EXPECT_EQ(c.timeoutSeconds, d.timeoutSeconds);
    EXPECT_EQ(c.mustFail, d.mustFail);
    EXPECT_EQ(c.expectations[0].where, Expectation{}.where);

    const Primitive p = readOne(withScene("primitives = [{ shape = \"plane\" }]\n")).scene.primitives.at(0);
    const Primitive q;
    EXPECT_EQ(p.halfExtents, q.halfExtents);
    EXPECT_EQ(p.worldFromLocal, q.worldFromLocal);
    EXPECT_EQ(p.radiance.pattern, q.radiance.pattern);
    EXPECT_EQ(p.radiance.colorA, q.radiance.colorA);
    EXPECT_EQ(p.radiance.colorB, q.radiance.colorB);
    EXPECT_EQ(p.radiance.cellSize, q.radiance.cellSize);
    EXPECT_EQ(p.radiance.axis, q.radiance.axis);
    EXPECT_EQ(p.material, q.material);
    EXPECT_EQ(p.ior, q.ior);
    EXPECT_EQ(p.objectIndex, q.objectIndex);
}

// Each name of a choice stands for its enumerator: a case per name, by number.
TEST_F(CaseReader, choicesAreTheEnumsInOrder)
{
    const auto projection = [&](const std::string& name) {
        return readOne(complete("[projection]\nmodel = \"" + name +
                                "\"\nproxy = { half_extents = [1, 2, 3], radius = 4 }\n[scene]\n"))
            .projection;
    };
    EXPECT_EQ(projection("none").model, ProjectionModel::kNone);
    EXPECT_EQ(projection("proxy_infinite").model, ProjectionModel::kProxyInfinite);
    EXPECT_EQ(projection("proxy_box").model, ProjectionModel::kProxyBox);
    EXPECT_EQ(projection("proxy_sphere").model, ProjectionModel::kProxySphere);
    EXPECT_EQ(projection("hiz").model, ProjectionModel::kHiz);
    EXPECT_EQ(projection("proxy_box").proxy.halfExtents, glm::dvec3(1, 2, 3));
    EXPECT_EQ(projection("proxy_box").proxy.radius, 4);

    const auto set = [&](const std::string& path, const std::string& name) {
        return readCaseFile(write("a.toml", withScene("primitives = [{ shape = \"plane\" }]\n")), {{path, name}}).at(0);
    };
    EXPECT_EQ(set("camera.projection", "orthographic").camera.projection, ProjectionKind::kOrthographic);
    EXPECT_EQ(set("camera.depth", "standard").camera.depthConvention, DepthConvention::kStandard);
    EXPECT_EQ(set("camera.depth", "infinite_reversed").camera.depthConvention, DepthConvention::kInfiniteReversed);
    EXPECT_EQ(set("camera.ndc_depth", "minus_one_to_one").camera.ndcDepthRange, NdcDepthRange::kMinusOneToOne);
    EXPECT_EQ(set("projection.screen_weight_form", "linear").projection.screenWeightForm, ScreenWeightForm::kLinear);
    EXPECT_EQ(set("projection.screen_weight_form", "smooth_today").projection.screenWeightForm,
              ScreenWeightForm::kSmoothToday);
    EXPECT_EQ(set("material.refraction_model", "sphere").material.refractionModel, RefractionModel::kSphere);
    EXPECT_EQ(set("material.refraction_model", "box").material.refractionModel, RefractionModel::kBox);
    EXPECT_EQ(set("material.refraction_model", "thin").material.refractionModel, RefractionModel::kThin);
    EXPECT_EQ(set("trace", "refraction").effect, TraceEffect::kRefraction);
    EXPECT_EQ(set("scene.primitives.0.pattern", "gradient").scene.primitives[0].radiance.pattern,
              RadiancePattern::kGradient);
    EXPECT_EQ(set("scene.primitives.0.axis", "z").scene.primitives[0].radiance.axis, 2);
    EXPECT_EQ(set("expect.0.where", "all").expectations[0].where, Where::kAll);
    EXPECT_EQ(set("expect.0.where", "answerable").expectations[0].where, Where::kAnswerable);
    EXPECT_EQ(set("expect.0.where", "answerable_hits").expectations[0].where, Where::kAnswerableHits);
    EXPECT_EQ(set("expect.0.where", "hits").expectations[0].where, Where::kHits);
}

TEST_F(CaseReader, rotationsGoAboutFixedAxesXFirst)
{
    const auto rotation = [&](const std::string& keys) {
        return readOne(withScene("primitives = [{ shape = \"plane\", " + keys + " }]\n"))
            .scene.primitives.at(0)
            .worldFromLocal;
    };
    const auto near = [](const glm::dvec3& a, const glm::dvec3& b) { return glm::length(a - b) < 1e-12; };
    EXPECT_TRUE(near(rotation("rotation = [90, 0, 0]") * glm::dvec3(0, 1, 0), {0, 0, 1}));
    // y -> z by x, then z -> x by y, then x -> y by z.
    EXPECT_TRUE(near(rotation("rotation = [90, 90, 90]") * glm::dvec3(0, 1, 0), {0, 1, 0}));
    EXPECT_TRUE(near(rotation("rotation = { axis = [0, 0, 5], degrees = 90 }") * glm::dvec3(1, 0, 0), {0, 1, 0}));
    EXPECT_TRUE(near(rotation("normal = [0, 3, 0]") * glm::dvec3(0, 0, 1), {0, 1, 0}));
    EXPECT_TRUE(near(rotation("normal = [0, 0, -1]") * glm::dvec3(0, 0, 1), {0, 0, -1}));
    EXPECT_TRUE(near(rotation("normal = [1, 2, -2]") * glm::dvec3(0, 0, 3), {1, 2, -2}));
    for (const char* keys : {"normal = [1, 2, -2]", "rotation = [10, 20, 30]"}) {
        EXPECT_NEAR(glm::determinant(rotation(keys)), 1.0, 1e-12);
    }
}

TEST_F(CaseReader, primitivesOfBothSpellingsFollowEachOther)
{
    const Case c = readOne(withScene("primitives = [{ shape = \"sphere\", radius = 3 }]\n"
                                     "[[scene.primitive]]\nshape = \"box\"\nhalf_extents = [1, 2, 3]\n"
                                     "[[scene.primitive]]\nshape = \"plane\"\nhalf_extents = [4, 5]\n"));
    ASSERT_EQ(c.scene.primitives.size(), 3u);
    EXPECT_EQ(c.scene.primitives[0].radius, 3);
    EXPECT_EQ(c.scene.primitives[1].halfExtents, glm::dvec3(1, 2, 3));
    EXPECT_EQ(c.scene.primitives[2].halfExtents.y, 5);
    EXPECT_TRUE(std::isinf(c.scene.primitives[2].halfExtents.z));
}

TEST_F(CaseReader, writesWhatMasksAndBudgetsRead)
{
    const Case c =
        readOne("schema = 1\nname = \"a\"\nsummary = \"b\"\nscene = {}\noutputs = [\"IterationCount\", \"Color\"]\n"
                "[[expect]]\noutput = \"HitDepth\"\ntruth = \"x\"\ntolerance = { relative = 1 }\nwhere = \"hits\"\n"
                "[[expect]]\noutput = \"HitSuccess\"\ntruth = \"hit\"\nbudget = { recall = 0.5 }\n");
    std::vector<std::string_view> names;
    for (const OutputInfo& output : c.outputs)
        names.push_back(output.name);
    EXPECT_EQ(names,
              (std::vector<std::string_view>{"Color", "HitDepth", "HitSuccess", "IterationCount", "HitPositionSS"}));
    ASSERT_TRUE(c.expectations[1].budget);
    EXPECT_EQ(c.expectations[1].budget->recall, 0.5);
    EXPECT_FALSE(c.expectations[1].budget->precision);
    EXPECT_EQ(c.expectations[1].budget->positionPx, HitBudget{}.positionPx);
}

TEST_F(CaseReader, constantsBecomeValues)
{
    const auto value = [&](const std::string& keys) {
        const Case c = readOne("schema = 1\nname = \"a\"\nsummary = \"b\"\nscene = {}\n[[expect]]\n" + keys);
        return std::get<ConstantSource>(c.expectations.at(0).source).value;
    };
    EXPECT_EQ(value("output = \"HitSuccess\"\nconstant = \"no_raycast\"\n"), std::vector<double>{0});
    EXPECT_EQ(value("output = \"HitSuccess\"\nconstant = \"hit\"\n"), std::vector<double>{1});
    EXPECT_EQ(value("output = \"HitSuccess\"\nconstant = \"miss\"\n"), std::vector<double>{2});
    EXPECT_EQ(value("output = \"HitSuccess\"\nconstant = \"unknown\"\n"), std::vector<double>{3});
    EXPECT_EQ(value("output = \"HitDepth\"\nconstant = 2\ntolerance = { ulps = 1 }\n"), std::vector<double>{2});
    EXPECT_EQ(value("output = \"Color\"\nconstant = [1, 0.5, 0]\ntolerance = { absolute = 0 }\n"),
              (std::vector<double>{1, 0.5, 0}));
}

TEST_F(CaseReader, goldenPathsAreResolved)
{
    const Case c =
        readOne("schema = 1\nname = \"a\"\nsummary = \"b\"\nscene = {}\n[[expect]]\noutput = \"HitSuccess\"\n"
                "golden = \"golden/a.exr\"\n");
    EXPECT_EQ(std::get<GoldenSource>(c.expectations[0].source).file,
              std::filesystem::canonical(folder_) / "golden/a.exr");
}

TEST_F(CaseReader, findsCaseFilesInOrder)
{
    for (const char* name : {"b.toml", "a/z.toml", "presets.toml", "a/presets.toml", "a/b.txt", "a/a.toml"})
        write(name, "");
    EXPECT_EQ(findCaseFiles(folder_),
              (std::vector<std::filesystem::path>{folder_ / "a/a.toml", folder_ / "a/z.toml", folder_ / "b.toml"}));
    EXPECT_EQ(findCaseFiles(folder_ / "b.toml"), std::vector<std::filesystem::path>{folder_ / "b.toml"});
    EXPECT_EQ(messageOf([&] { findCaseFiles(folder_ / "none"); }),
              "none: the folder cannot be read: No such file or directory");
}
