#include "tests/unit/expect/cases.h"

#include "harness/base/temporary_folder.h"
#include "harness/scene/exr.h"

#include <filesystem>

using namespace crossray;
using namespace crossray::test;

namespace {

// Both sources' planes over the pixels of which the second can speak.
Comparison compareSources(const CaseData& data, const Expectation& first, const Expectation& second, double bound)
{
    Tolerance tolerance;
    tolerance.absolute = bound;
    tolerance.degrees = bound * 57.3;
    const auto a = makeExpected(data, first);
    const auto b = makeExpected(data, second);
    return compare(first.output.type, *b, *a, makeMask(data, second, nullptr), tolerance);
}

void expectSame(const CaseData& data, const Expectation& first, const Expectation& second, double bound,
                uint64_t leastPixels)
{
    const Comparison result = compareSources(data, first, second, bound);
    EXPECT_TRUE(result.passed) << first.output.name << ": " << result.reason;
    EXPECT_GE(result.compared, leastPixels) << first.output.name;
}

} // namespace

TEST(Expected, onATrueSphereTheSphereFormIsTheTruth)
{
    for (const double ior : {1.0, 1.33, 1.5, 2.4}) {
        const CaseData data(glassSphere(ior));
        expectSame(data, analytic("RayDirWS", "refraction_sphere"), truth("RayDirWS", "ray_direction"), 1e-12, 30);
        expectSame(data, analytic("RayDirWS", "refraction_sphere"), truth("RayDirWS", "refracted_exit_direction"),
                   1e-12, 30);
        expectSame(data, analytic("RayOriginWS", "refraction_sphere"), truth("RayOriginWS", "ray_origin"), 1e-12, 30);
        expectSame(data, analytic("PathLength", "refraction_sphere"), truth("PathLength", "path_length"), 1e-12, 30);
        expectSame(data, analytic("SampledColor", "surface_radiance"), truth("SampledColor", "hit_radiance"), 1e-12,
                   30);
        expectSame(data, analytic("Color", "surface_radiance"), truth("Color", "hit_radiance"), 1e-9, 30);
    }
}

TEST(Expected, withAnotherThicknessTheSphereFormIsNot)
{
    Case testCase = glassSphere();
    testCase.material.thickness = 1.9;
    const CaseData data(testCase);
    EXPECT_FALSE(
        compareSources(data, analytic("RayOriginWS", "refraction_sphere"), truth("RayOriginWS", "ray_origin"), 1e-3)
            .passed);
    EXPECT_FALSE(
        compareSources(data, analytic("RayDirWS", "refraction_box"), truth("RayDirWS", "ray_direction"), 1e-3).passed);
    testCase.material.thicknessMultiplier = 2.0 / 1.9;
    const CaseData scaled(testCase);
    expectSame(scaled, analytic("RayOriginWS", "refraction_sphere"), truth("RayOriginWS", "ray_origin"), 1e-12, 30);
}

TEST(Expected, onATrueSlabTheBoxFormIsTheTruth)
{
    Case testCase = makeCase({box({0, 0, -4}, {90, 90, 0.25}, "glass"), wall(-9.0)}, TraceEffect::kRefraction);
    testCase.material = {RefractionModel::kBox, 1.5, 0.5, 1.0, 0.0};
    const CaseData data(testCase);
    expectSame(data, analytic("RayDirWS", "refraction_box"), truth("RayDirWS", "ray_direction"), 1e-12, 384);
    expectSame(data, analytic("RayOriginWS", "refraction_box"), truth("RayOriginWS", "ray_origin"), 1e-12, 384);
    expectSame(data, analytic("PathLength", "refraction_box"), truth("PathLength", "path_length"), 1e-12, 384);
    expectSame(data, analytic("SampledColor", "surface_radiance"), truth("SampledColor", "hit_radiance"), 1e-12, 384);
}

TEST(Expected, onA5MillimetrePaneTheThinFormIsTheTruth)
{
    Case testCase = makeCase({box({0, 0, -4}, {90, 90, 0.0025}, "glass"), wall(-9.0)}, TraceEffect::kRefraction);
    testCase.material = {RefractionModel::kThin, 1.5, 0.7, 3.0, 0.0};
    const CaseData data(testCase);
    expectSame(data, analytic("RayOriginWS", "refraction_thin"), truth("RayOriginWS", "ray_origin"), 1e-12, 384);
    EXPECT_FALSE(
        compareSources(data, analytic("RayOriginWS", "refraction_none"), truth("RayOriginWS", "ray_origin"), 1e-3)
            .passed);
}

TEST(Expected, theMirrorImageIsTheTruth)
{
    const CaseData data(
        makeCase({sphere({0, 0, -4}, 1.5, "mirror"), box({3, 0, -5}, {0.5, 1, 1}, "mirror"), wall(-9.0, "mirror")},
                 TraceEffect::kReflection));
    expectSame(data, analytic("RayDirWS", "reflection_direction"), truth("RayDirWS", "ray_direction"), 1e-12, 384);
    expectSame(data, analytic("RayOriginWS", "reflection_direction"), truth("RayOriginWS", "ray_origin"), 1e-12, 384);
}

TEST(Expected, insideARoomTheBoxProxyOfItsSizeIsTheTruth)
{
    Case testCase = makeCase({sphere({0.3, 0.2, -3}, 1.0, "mirror"), box({0, 0, -2}, {4, 3, 6}, "diffuse")},
                             TraceEffect::kReflection);
    testCase.projection.model = ProjectionModel::kProxyBox;
    testCase.projection.proxy.center = {0, 0, -2};
    testCase.projection.proxy.halfExtents = {4, 3, 6};
    const CaseData data(testCase);
    const auto success = makeExpected(data, analytic("HitSuccess", "proxy_box"));
    const auto depth = makeExpected(data, analytic("HitDepth", "proxy_box"));
    const auto position = makeExpected(data, analytic("HitPositionSS", "proxy_box"));
    const auto ndc = makeExpected(data, analytic("PositionNDC", "proxy_box"));
    const auto weight = makeExpected(data, analytic("HitWeight", "screen_weight"));
    const auto reason = makeExpected(data, analytic("HitReason", "proxy_box"));
    int hits = 0, misses = 0;
    for (int y = 0; y < 16; ++y) {
        for (int x = 0; x < 24; ++x) {
            const size_t pixel = static_cast<size_t>(y * 24 + x);
            if (!data.tracedPixels()[pixel]) {
                EXPECT_EQ(success->at(x, y), 0.0);
                continue;
            }
            const TruthPixel& known = data.truth().at(x, y);
            const bool inFront = known.hitLinearDepth > 0.0;
            (inFront ? hits : misses) += 1;
            EXPECT_EQ(success->at(x, y), inFront ? 1.0 : 2.0);
            EXPECT_EQ(reason->at(x, y), inFront ? 0.0 : 5.0);
            EXPECT_NEAR(depth->at(x, y), inFront ? known.hitLinearDepth : 0.0, 1e-11);
            EXPECT_NEAR(position->at(x, y, 0), known.hitPositionSS.x, 1e-8 * (1.0 + std::abs(known.hitPositionSS.x)));
            EXPECT_NEAR(position->at(x, y, 1), known.hitPositionSS.y, 1e-8 * (1.0 + std::abs(known.hitPositionSS.y)));
            if (!inFront) continue;
            EXPECT_NEAR(ndc->at(x, y, 0), known.hitPositionSS.x / 12.0 - 1.0,
                        1e-8 * (1.0 + std::abs(known.hitPositionSS.x)));
            EXPECT_NEAR(ndc->at(x, y, 1), 1.0 - known.hitPositionSS.y / 8.0,
                        1e-8 * (1.0 + std::abs(known.hitPositionSS.y)));
            const glm::dvec2 uv = known.hitPositionSS / glm::dvec2(24, 16);
            EXPECT_NEAR(weight->at(x, y), screenWeightAt(uv, 0.1, ScreenWeightForm::kSmooth2018), 1e-9);
        }
    }
    EXPECT_GT(hits, 5);
    EXPECT_GT(misses, 5);
    // The truth's own planes hold the depth and place also of what is behind the camera or off the screen.
    const auto trueDepth = makeExpected(data, truth("HitDepth", "hit_depth"));
    const auto truePosition = makeExpected(data, truth("HitPositionSS", "hit_position_ss"));
    for (size_t pixel = 0; pixel < trueDepth->values.size(); ++pixel) {
        EXPECT_EQ(trueDepth->values[pixel], data.truth().pixels[pixel].hitLinearDepth);
        EXPECT_EQ(truePosition->values[2 * pixel + 1], data.truth().pixels[pixel].hitPositionSS.y);
    }
}

TEST(Expected, colourIsTheRadianceTimesTheScreenWeight)
{
    Case testCase = glassSphere();
    testCase.projection.screenWeightDistance = 0.5;
    testCase.projection.screenWeightForm = ScreenWeightForm::kLinear;
    const CaseData data(testCase);
    for (const bool closed : {false, true}) {
        const auto source = [&](const char* output) {
            return closed ? analytic(output, "surface_radiance") : truth(output, "hit_radiance");
        };
        const auto color = makeExpected(data, source("Color"));
        const auto sampled = makeExpected(data, source("SampledColor"));
        int compared = 0;
        for (size_t pixel = 0; pixel < data.tracedPixels().size(); ++pixel) {
            const TruthPixel& known = data.truth().pixels[pixel];
            if (known.screen != ScreenKnowledge::kVisible) continue;
            const glm::dvec2 uv = known.hitPositionSS / glm::dvec2(24, 16);
            const double weight = 4.0 * std::min(uv.x, 1.0 - uv.x) * std::min(uv.y, 1.0 - uv.y);
            EXPECT_EQ(sampled->values[pixel * 3], known.radiance.x);
            EXPECT_NEAR(color->values[pixel * 3], known.radiance.x * weight, 1e-12);
            ++compared;
        }
        EXPECT_GT(compared, 5);
    }
}

TEST(Expected, theBackOfABoxIsUnknownAndWeighsNothing)
{
    // A mirror wall behind a box that stands aside: what it shows on screen is the box's back, which the screen does
    // not know.
    Case testCase =
        makeCase({wall(-8.0, "mirror"), box({2.5, 0, -4}, {1, 2, 0.5}, "diffuse")}, TraceEffect::kReflection);
    testCase.projection.model = ProjectionModel::kHiz;
    const CaseData data(testCase);
    const auto hit = makeExpected(data, truth("HitSuccess", "hit"));
    const auto weight = makeExpected(data, analytic("HitWeight", "screen_weight"));
    int hidden = 0;
    for (size_t pixel = 0; pixel < hit->values.size(); ++pixel) {
        if (data.truth().pixels[pixel].screen != ScreenKnowledge::kHidden) continue;
        EXPECT_EQ(hit->values[pixel], 3.0);
        EXPECT_EQ(weight->values[pixel], 0.0);
        ++hidden;
    }
    EXPECT_GT(hidden, 3);
}

TEST(Expected, aMarchsWeightIsThatOfTheVisibleTruth)
{
    // A mirror floor below a wall: rays hit the wall, higher up off screen.
    Primitive floor = wall(0.0, "mirror");
    floor.worldFromLocal = glm::dmat3(glm::dvec3(1, 0, 0), glm::dvec3(0, 0, -1), glm::dvec3(0, 1, 0));
    floor.center = {0, -1, 0};
    Case testCase = makeCase({floor, wall(-6.0)}, TraceEffect::kReflection);
    testCase.projection.model = ProjectionModel::kHiz;
    testCase.projection.screenWeightForm = ScreenWeightForm::kLinear;
    const CaseData data(testCase);
    const auto weight = makeExpected(data, analytic("HitWeight", "screen_weight"));
    const auto hit = makeExpected(data, truth("HitSuccess", "hit"));
    bool partial = false;
    for (int y = 0; y < 16; ++y) {
        for (int x = 0; x < 24; ++x) {
            if (hit->at(x, y) != 1.0) {
                EXPECT_EQ(weight->at(x, y), 0.0);
                continue;
            }
            const glm::dvec2 uv = data.truth().at(x, y).hitPositionSS / glm::dvec2(24, 16);
            const double ramp =
                std::min(1.0, std::min(uv.x, 1 - uv.x) / 0.1) * std::min(1.0, std::min(uv.y, 1 - uv.y) / 0.1);
            EXPECT_NEAR(weight->at(x, y), ramp, 1e-12);
            partial = partial || (ramp > 0.1 && ramp < 0.9);
        }
    }
    EXPECT_TRUE(partial);
}

TEST(Expected, totalReflectionIsNoRaycast)
{
    Case testCase = glassSphere(0.7);
    testCase.projection.model = ProjectionModel::kProxyInfinite;
    const CaseData data(testCase);
    const auto success = makeExpected(data, analytic("HitSuccess", "proxy_infinite"));
    const auto reason = makeExpected(data, analytic("HitReason", "proxy_infinite"));
    const auto known = makeExpected(data, truth("HitSuccess", "hit"));
    const Mask rays = makeMask(data, truth("RayDirWS", "ray_direction"), nullptr);
    const std::vector<HitTruth> hits = data.hitTruth();
    int totals = 0;
    for (size_t pixel = 0; pixel < rays.size(); ++pixel) {
        if (!data.truth().pixels[pixel].totalInternalReflection) continue;
        ++totals;
        EXPECT_EQ(success->values[pixel], 0.0);
        EXPECT_EQ(reason->values[pixel], 8.0);
        EXPECT_EQ(known->values[pixel], 0.0);
        EXPECT_EQ(rays[pixel], 0) << "the truth has no direction there";
        EXPECT_TRUE(hits[pixel].traced) << "and a claimed hit is a false one";
        EXPECT_FALSE(hits[pixel].answerable);
    }
    EXPECT_GT(totals, 3);
}

TEST(Expected, theClassOfTheTruthIsWhatTheScreenCouldKnow)
{
    // A mirror in the middle of a wall that is smaller than what it reflects; boxes behind and beside the camera.
    Primitive mirror = wall(-4.0, "mirror");
    mirror.halfExtents = {3, 3, kInf};
    const CaseData data(makeCase({mirror, box({0, 0, 3}, {1, 1, 1}, "diffuse"), wall(-6.0)}, TraceEffect::kReflection));
    const auto hit = makeExpected(data, truth("HitSuccess", "hit"));
    int unknown = 0, miss = 0;
    for (size_t pixel = 0; pixel < hit->values.size(); ++pixel) {
        const ScreenKnowledge screen = data.truth().pixels[pixel].screen;
        if (screen == ScreenKnowledge::kOffScreen) {
            EXPECT_EQ(hit->values[pixel], 3.0);
            ++unknown;
        }
        if (screen == ScreenKnowledge::kSky) {
            EXPECT_EQ(hit->values[pixel], 2.0);
            ++miss;
        }
    }
    EXPECT_GT(unknown, 0);
    EXPECT_GT(miss, 0);
}

TEST(Expected, refractionsReasonNeedsProjectionNone)
{
    Case testCase = glassSphere(0.7);
    EXPECT_TRUE(makeExpected(CaseData(testCase), analytic("HitReason", "refraction_sphere")));
    testCase.projection.model = ProjectionModel::kProxyInfinite;
    EXPECT_NE(errorOf([&] { makeExpected(CaseData(testCase), analytic("HitReason", "refraction_sphere")); }), "");
}

TEST(Expected, everyFormAnswersForEachOfItsOutputs)
{
    Case testCase = glassSphere();
    Probe probe;
    probe.influence.halfExtents = glm::dvec3(20.0);
    testCase.probes.push_back(probe);
    History still;
    still.camera = testCase.camera;
    for (const ClosedForm& form : closedForms()) {
        testCase.projection.model = form.name == "screen_weight" ? ProjectionModel::kHiz : ProjectionModel::kNone;
        testCase.history = form.name == "history" ? std::optional<History>(still) : std::nullopt;
        if (form.name == "linear_march") testCase.projection.model = ProjectionModel::kLinear;
        if (form.name == "pixel_walk") testCase.projection.model = ProjectionModel::kOwn;
        if (form.name == "proxy_probe") testCase.projection.model = ProjectionModel::kProxyProbe;
        testCase.hierarchy = form.name == "hierarchy" ? unsigned{kTierSky} : 0;
        testCase.probeProfile = form.name == "probe_profile" ? ProbeProfile::kBuiltIn : ProbeProfile::kHdrp;
        testCase.mustFail = form.name == "box_projection_published";
        const CaseData data(form.name.starts_with("planar_") ? planarMirror() : testCase);
        EXPECT_FALSE(form.summary.empty());
        ASSERT_FALSE(form.outputs.empty()) << form.name;
        for (const std::string& output : form.outputs) {
            const auto plane = makeExpected(data, analytic(output, form.name));
            ASSERT_TRUE(plane) << form.name << " " << output;
            EXPECT_EQ(plane->name, output);
            EXPECT_EQ(plane->channels, findOutput(output)->channels);
            for (const double value : plane->values)
                ASSERT_TRUE(std::isfinite(value)) << form.name << " " << output;
        }
    }
    const CaseData data(testCase);
    for (const ClosedForm& quantity : truthQuantities()) {
        for (const std::string& output : quantity.outputs)
            EXPECT_TRUE(makeExpected(data, truth(output, quantity.name)));
    }
}

TEST(Expected, anErrorNamesThePositionAndWhatIsAllowed)
{
    const CaseData data(glassSphere());
    const std::string unknown = errorOf([&] { makeExpected(data, analytic("RayDirWS", "refraction_cube")); });
    EXPECT_EQ(
        unknown.rfind("case.toml:7:1: unknown closed form \"refraction_cube\"; allowed are reflection_direction, ", 0),
        0U)
        << unknown;
    const std::string quantity = errorOf([&] { makeExpected(data, truth("RayDirWS", "direction")); });
    EXPECT_EQ(quantity.rfind("case.toml:7:1: unknown truth \"direction\"; allowed are ray_direction, ", 0), 0U)
        << quantity;
    EXPECT_EQ(errorOf([&] { makeExpected(data, analytic("HitDepth", "reflection_direction")); }),
              "case.toml:7:1: closed form \"reflection_direction\" says nothing about HitDepth; allowed are RayDirWS, "
              "RayOriginWS");
    EXPECT_NE(errorOf([&] { makeExpected(data, truth("HitDepth", "hit")); }), "");
    EXPECT_NE(errorOf([&] { makeExpected(data, analytic("HitWeight", "screen_weight")); }), "")
        << "nothing is projected";
    EXPECT_NE(errorOf([&] { makeExpected(data, expectation("HitDepth", AgreeSource{{"a", "b"}})); }), "");
    const CaseData mirror(makeCase({wall(-3, "mirror")}, TraceEffect::kReflection));
    EXPECT_NE(errorOf([&] { makeExpected(mirror, truth("RayDirWS", "refracted_exit_direction")); }), "");
    EXPECT_NE(errorOf([&] { makeExpected(mirror, truth("PathLength", "path_length")); }), "");
}

TEST(Expected, aConstantIsOneValueOrOneAChannel)
{
    const CaseData data(glassSphere());
    const auto one = makeExpected(data, expectation("Color", ConstantSource{{0.25}}));
    EXPECT_EQ(one->at(23, 15, 2), 0.25);
    const auto three = makeExpected(data, expectation("Color", ConstantSource{{0.1, 0.2, 0.3}}));
    EXPECT_EQ(three->at(0, 0, 0), 0.1);
    EXPECT_EQ(three->at(5, 7, 1), 0.2);
    EXPECT_EQ(three->at(23, 15, 2), 0.3);
    EXPECT_EQ(errorOf([&] {
                  makeExpected(data, expectation("Color", ConstantSource{{1, 2}}));
              }),
              "case.toml:7:1: the constant has 2 values, allowed for Color are 3 or 1");
    EXPECT_NE(errorOf([&] { makeExpected(data, expectation("HitDepth", ConstantSource{{}})); }), "");
}

TEST(Expected, aBoundIsTheSameEverywhere)
{
    const CaseData data(glassSphere());
    EXPECT_EQ(makeExpected(data, expectation("IterationCount", BoundSource{64.0}))->at(23, 15, 0), 64.0);
    EXPECT_EQ(makeExpected(data, expectation("Color", BoundSource{}))->at(3, 4, 2), std::numeric_limits<float>::max());
}

TEST(Expected, aGoldenIsReadByItsOutputsName)
{
    const CaseData data(glassSphere());
    const TemporaryFolder folder("golden-test");
    const std::filesystem::path file = folder.path() / "golden.exr";
    const Expectation depth = expectation("HitDepth", GoldenSource{file});
    EXPECT_FALSE(makeExpected(data, depth)) << "a missing golden is no error";
    const std::vector<Plane> planes{Plane("HitDepth", 24, 16, 1, 2.5), Plane("HitWeight", 8, 8, 1, 1.0)};
    writeExr(file, planes);
    EXPECT_EQ(makeExpected(data, depth)->at(3, 3), 2.5);
    EXPECT_NE(errorOf([&] { makeExpected(data, expectation("HitWeight", GoldenSource{file})); }).find("8x8"),
              std::string::npos);
    EXPECT_NE(errorOf([&] {
                  makeExpected(data, expectation("Color", GoldenSource{file}));
              }).find("it has HitDepth, HitWeight"),
              std::string::npos);
}
