#include "tests/unit/expect/cases.h"

#include <algorithm>
#include <filesystem>
#include <thread>

using namespace crossray;
using namespace crossray::test;

namespace {

size_t countOf(const std::vector<bool>& pixels)
{
    return static_cast<size_t>(std::count(pixels.begin(), pixels.end(), true));
}
size_t countOf(const Mask& mask)
{
    return static_cast<size_t>(std::count(mask.begin(), mask.end(), 1));
}

// A mirror floor that reflects a low wall, and the sky above it.
Case mirrorFloor()
{
    Primitive low = wall(-6.0);
    low.halfExtents = {kInf, 1.0, kInf};
    Primitive floor = wall(0.0, "mirror");
    floor.worldFromLocal = glm::dmat3(glm::dvec3(1, 0, 0), glm::dvec3(0, 0, -1), glm::dvec3(0, 1, 0));
    floor.center = {0, -1, 0};
    return makeCase({floor, low}, TraceEffect::kReflection);
}

// The data set lies with the cases that use it.
std::filesystem::path recordedFolder(const char* name)
{
    return std::filesystem::path(CROSSRAY_SOURCE_DIR) / "cases/real/data" / name;
}

Case recordedCase(const char* name, TraceEffect effect, int object)
{
    const std::filesystem::path folder = recordedFolder(name);
    Case testCase;
    testCase.name = name;
    testCase.effect = effect;
    testCase.camera = readCameraJson(folder / "camera.json");
    testCase.recorded = RecordedGBuffer{folder / "gbuffer.exr", folder / "camera.json", folder / "truth.exr",
                                        blenderChannelMap(), object};
    return testCase;
}

} // namespace

TEST(CaseData, mirrorsTraceReflectionsAndGlassRefraction)
{
    Case testCase = makeCase({sphere({-2, 0, -5}, 1, "mirror"), sphere({2, 0, -5}, 1, "glass"), wall(-9)},
                             TraceEffect::kReflection);
    const std::vector<bool> mirrors = CaseData(testCase).tracedPixels();
    testCase.effect = TraceEffect::kRefraction;
    const std::vector<bool> glass = CaseData(testCase).tracedPixels();
    EXPECT_GT(countOf(mirrors), 5U);
    EXPECT_GT(countOf(glass), 5U);
    for (size_t y = 0; y < 16; ++y) {
        for (size_t x = 0; x < 24; ++x) {
            EXPECT_FALSE(mirrors[y * 24 + x] && x >= 12);
            EXPECT_FALSE(glass[y * 24 + x] && x < 12);
        }
    }
}

TEST(CaseData, primitivesThatShareAnIndexKeepTheirMaterials)
{
    Case testCase = makeCase({sphere({-2, 0, -5}, 1, "mirror"), sphere({2, 0, -5}, 1, "glass"), wall(-9)},
                             TraceEffect::kReflection);
    const std::vector<bool> apart = CaseData(testCase).tracedPixels();
    for (Primitive& primitive : testCase.scene.primitives)
        primitive.objectIndex = 5;
    EXPECT_EQ(CaseData(testCase).tracedPixels(), apart);
}

TEST(CaseData, surfacesAreExact)
{
    const CaseData data(glassSphere());
    size_t traced = 0;
    for (size_t pixel = 0; pixel < data.surfaces().size(); ++pixel) {
        const SurfacePoint& surface = data.surfaces()[pixel];
        if (!data.tracedPixels()[pixel]) {
            EXPECT_EQ(surface.normalWS, glm::dvec3(0.0));
            continue;
        }
        ++traced;
        const glm::dvec3 center(0.1, -0.05, -4.0);
        EXPECT_NEAR(glm::length(surface.positionWS - center), 1.0, 1e-14);
        EXPECT_LT(glm::length(surface.normalWS - (surface.positionWS - center)), 1e-14);
        EXPECT_LT(glm::length(surface.toEyeWS - glm::normalize(-surface.positionWS)), 1e-14);
        EXPECT_EQ(surface.primitive, 0);
    }
    EXPECT_EQ(traced, countOf(data.tracedPixels()));
    EXPECT_GT(traced, 30U);
}

TEST(CaseData, aPlaneSeenFromBehindFacesTheViewer)
{
    Primitive back = wall(-3.0, "mirror");
    back.worldFromLocal = glm::dmat3(glm::dvec3(-1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, -1));
    const CaseData data(makeCase({back}, TraceEffect::kReflection));
    EXPECT_EQ(data.surfaces()[0].normalWS, glm::dvec3(0, 0, 1));
}

TEST(CaseData, asksOnlyForTheChannelsThatAreRead)
{
    Case testCase = mirrorFloor();
    testCase.outputs = {*findOutput("RayDirWS")};
    EXPECT_FALSE(CaseData(testCase).gbuffer().planes.contains(GBufferChannel::kColor));
    testCase.outputs.push_back(*findOutput("SampledColor"));
    EXPECT_TRUE(CaseData(testCase).gbuffer().planes.contains(GBufferChannel::kColor));
    EXPECT_TRUE(CaseData(testCase).gbuffer().planes.contains(GBufferChannel::kDeviceDepth));
    EXPECT_TRUE(CaseData(testCase).gbuffer().planes.contains(GBufferChannel::kNormalWS));
}

// What the shaders read is broken, and what they are held to is not.
TEST(CaseData, poisonIsInTheGBufferAlone)
{
    using enum GBufferChannel;
    const Case whole = mirrorFloor();
    Case broken = whole;
    broken.poison = {TexelPoison::kNan, PoisonedChannel::kDepth, 4};
    const CaseData wholeData(whole), brokenData(broken, wholeData);
    const Plane& before = wholeData.gbuffer().plane(kDeviceDepth);
    const Plane& after = brokenData.gbuffer().plane(kDeviceDepth);
    for (int y = 0; y < after.height; ++y) {
        for (int x = 0; x < after.width; ++x) {
            if (x % 4 == 2 && y % 4 == 2)
                EXPECT_TRUE(std::isnan(after.at(x, y)));
            else
                EXPECT_EQ(after.at(x, y), before.at(x, y));
        }
    }
    EXPECT_EQ(brokenData.gbuffer().plane(kNormalWS).values, wholeData.gbuffer().plane(kNormalWS).values);
    EXPECT_EQ(brokenData.tracedPixels(), wholeData.tracedPixels());
    EXPECT_EQ(brokenData.surfaces()[0].normalWS, wholeData.surfaces()[0].normalWS);

    broken.poison = {TexelPoison::kMinusInfinity, PoisonedChannel::kNormal, 1};
    broken.screenLayer = ScreenLayer::kOpaque;
    const CaseData layered(broken);
    for (const GBuffer* gbuffer : {&layered.gbuffer(), &layered.screen()}) {
        for (const double value : gbuffer->plane(kNormalWS).values)
            EXPECT_EQ(value, -kInf);
        EXPECT_TRUE(std::isfinite(gbuffer->plane(kDeviceDepth).at(2, 2)));
    }
}

TEST(CaseData, isMadeOnceForAllThreads)
{
    const CaseData data(mirrorFloor());
    std::vector<const Truth*> truths(2);
    std::vector<const std::vector<SurfacePoint>*> surfaces(2);
    {
        std::vector<std::jthread> threads;
        for (size_t i = 0; i < 2; ++i) {
            threads.emplace_back([&, i] {
                truths[i] = &data.truth();
                surfaces[i] = &data.surfaces();
            });
        }
    }
    EXPECT_EQ(truths[0], truths[1]);
    EXPECT_EQ(surfaces[0], surfaces[1]);
}

TEST(CaseData, hitTruthIsTheTruthOfTheTracedPixels)
{
    const CaseData data(mirrorFloor());
    const std::vector<HitTruth> hits = data.hitTruth();
    size_t traced = 0, answerable = 0;
    for (size_t pixel = 0; pixel < hits.size(); ++pixel) {
        const TruthPixel& known = data.truth().pixels[pixel];
        EXPECT_EQ(hits[pixel].traced, data.tracedPixels()[pixel]);
        EXPECT_EQ(hits[pixel].answerable, known.screen == ScreenKnowledge::kVisible);
        if (hits[pixel].answerable) {
            EXPECT_EQ(hits[pixel].hitX, known.hitPositionSS.x);
            EXPECT_EQ(hits[pixel].hitY, known.hitPositionSS.y);
        }
        traced += hits[pixel].traced ? 1U : 0U;
        answerable += hits[pixel].answerable ? 1U : 0U;
    }
    EXPECT_GT(answerable, 20U);
    EXPECT_GT(traced, answerable);
}

TEST(Mask, followsWhere)
{
    const CaseData data(mirrorFloor());
    Plane success("HitSuccess", 24, 16, 1, 2.0);
    success.values.back() = 1.0;  // the last pixel, on the floor
    success.values.front() = 1.0; // the first, on the wall: no ray
    Expectation depth = truth("HitDepth", "hit_depth");
    const auto count = [&](Where where) {
        depth.where = where;
        return countOf(makeMask(data, depth, &success));
    };
    EXPECT_EQ(count(Where::kAll), 384U);
    EXPECT_EQ(count(Where::kTraced), countOf(data.tracedPixels()));
    const std::vector<HitTruth> hits = data.hitTruth();
    const auto answerable = std::count_if(hits.begin(), hits.end(), [](const HitTruth& hit) { return hit.answerable; });
    EXPECT_EQ(count(Where::kAnswerable), static_cast<size_t>(answerable));
    EXPECT_EQ(count(Where::kHits), 1U);
    EXPECT_EQ(count(Where::kAnswerableHits), hits.back().answerable ? 1U : 0U);
    for (double& value : success.values)
        value = 1.0;
    EXPECT_EQ(count(Where::kHits), countOf(data.tracedPixels()));
    EXPECT_EQ(count(Where::kAnswerableHits), static_cast<size_t>(answerable));
    depth.where = Where::kHits;
    EXPECT_EQ(
        errorOf([&] { makeMask(data, depth, nullptr); }).rfind("case.toml:7:1: HitDepth is judged where HitSuccess", 0),
        0U);
}

TEST(Recorded, theMirrorRoomsDirectionsAreTheMirrorImages)
{
    const CaseData data(recordedCase("mirror_room", TraceEffect::kReflection, 1));
    EXPECT_GT(countOf(data.tracedPixels()), 1000U);
    const Expectation known = truth("RayDirWS", "ray_direction");
    const auto formed = makeExpected(data, analytic("RayDirWS", "reflection_direction"));
    Tolerance tolerance;
    tolerance.degrees = 0.2;
    const Comparison result =
        compareDirections(*makeExpected(data, known), *formed, makeMask(data, known, nullptr), tolerance);
    EXPECT_TRUE(result.passed) << result.reason;
    EXPECT_LT(result.p99, 2e-3);
    EXPECT_GT(result.compared, 1000U);
}

TEST(Recorded, theGlassSpheresExitDirectionsAreTheSpheres)
{
    Case testCase = recordedCase("glass_sphere", TraceEffect::kRefraction, 7);
    testCase.material = {RefractionModel::kSphere, 1.5, 1.8, 1.0, 0.0};
    const CaseData data(testCase);
    const Expectation known = truth("RayDirWS", "refracted_exit_direction");
    const auto formed = makeExpected(data, analytic("RayDirWS", "refraction_sphere"));
    Tolerance tolerance;
    tolerance.degrees = 0.15; // near the rim, where the G-buffer's rounding weighs most
    const Comparison result =
        compareDirections(*makeExpected(data, known), *formed, makeMask(data, known, nullptr), tolerance);
    EXPECT_TRUE(result.passed) << result.reason;
    EXPECT_LT(result.p99, 0.05);
    EXPECT_GT(result.compared, 1000U);
}

TEST(Recorded, withoutATruthFileThereIsNoTruth)
{
    Case testCase = recordedCase("mirror_room", TraceEffect::kReflection, 1);
    testCase.recorded->truthFile.clear();
    const CaseData data(testCase);
    EXPECT_NE(errorOf([&] { data.truth(); }).find("without a truth file"), std::string::npos);
    EXPECT_NE(errorOf([&] { makeExpected(data, analytic("Color", "surface_radiance")); }), "");
}

TEST(Recorded, object0TracesEverySurface)
{
    const CaseData data(recordedCase("mirror_room", TraceEffect::kReflection, 0));
    const CaseData floor(recordedCase("mirror_room", TraceEffect::kReflection, 1));
    EXPECT_GT(countOf(data.tracedPixels()), countOf(floor.tracedPixels()));
    const Plane& indices = data.gbuffer().plane(GBufferChannel::kObjectIndex);
    EXPECT_EQ(countOf(data.tracedPixels()),
              indices.pixelCount() -
                  static_cast<size_t>(std::count(indices.values.begin(), indices.values.end(), 0.0)));
}
