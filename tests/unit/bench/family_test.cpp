// The families that a case's key `bench` names: their methods, what these make of a case, and what is made of figures.
#include "harness/bench/family.h"

#include "harness/bench/bench_report.h"
#include "harness/scene/cubemap.h"
#include "tests/unit/bench/find_method.h"

#include <gtest/gtest.h>


using namespace crossray;

namespace {

Case readBenchCase(const std::string& name)
{
    return readCaseFile(std::string(CROSSRAY_SOURCE_DIR) + "/cases/bench/" + name + ".toml").at(0);
}

// The cubemap that a method with a baked probe reads.
Cubemap bakedBy(const Case& testCase, const std::string& method)
{
    const auto methods = makeBenchMethods(testCase);
    Case varied = testCase;
    findMethod(methods, method).apply(varied);
    return readCubemap(std::get<CubemapFile>(varied.probes.front().environment.content).file);
}

BenchScene makeTechniques()
{
    BenchScene scene;
    scene.name = "bench/refraction_techniques/room";
    scene.effect = "refraction_techniques";
    const std::tuple<const char*, const char*, double, double> points[] = {
        {"baked probe, 64", "baked", 0.2, 10},
        {"real-time probe, 64", "realtime", 0.05, 12},
        {"screen", "screen", 0.03, 32}};
    for (const auto& [name, kind, error, cost] : points) {
        BenchPoint point{name, kind, {{"Color", error}, {"ColorP95", 2 * error}}, {}, {cost, cost, cost, cost}};
        point.counters = {{"Reads", 10}, {"Rendered", cost - 10}, {"Cost", cost}, {"FrameShare", 1 + 0.01 * cost}};
        scene.points.push_back(point);
    }
    return scene;
}

} // namespace

TEST(BenchFamily, IsFoundByTheKeyOfACase)
{
    ASSERT_NE(findBenchFamily("refraction_techniques"), nullptr);
    EXPECT_EQ(findBenchFamily("refraction_models"), nullptr) << "the effect's own";
    EXPECT_EQ(findBenchFamily(""), nullptr);
    const auto models = makeBenchMethods(readBenchCase("refraction_models/lens"));
    EXPECT_EQ(models.size(), 4U);
    EXPECT_EQ(shortNameOf("bench/refraction_models/lens"), "lens");
    EXPECT_EQ(chartIdOf("a[b=0.5]"), "a_b_0_5_");
}

TEST(BenchFamily, TechniquesAreScreenBakedAndFiveCaptureSizes)
{
    const Case testCase = readBenchCase("refraction_techniques/moved");
    const auto methods = makeBenchMethods(testCase);
    std::map<std::string, int> kinds;
    std::vector<int> sizes;
    for (const BenchMethod& method : methods) {
        ++kinds[method.kind];
        Case varied = testCase;
        method.apply(varied);
        EXPECT_FALSE(varied.history) << method.name << ": it says what was baked, and no more";
        EXPECT_EQ(method.kind == "realtime", method.captureSize > 0);
        if (method.captureSize > 0) {
            sizes.push_back(method.captureSize);
            EXPECT_EQ(varied.probes.front().environment.size, method.captureSize);
        }
        EXPECT_EQ((varied.hierarchy & kTierScreen) != 0, method.kind == "screen") << method.name;
    }
    EXPECT_EQ(sizes, (std::vector<int>{16, 32, 64, 128, 256}));
    EXPECT_EQ(kinds["baked"], 2);
    EXPECT_EQ(kinds["screen"], 3);
    Case bare = testCase;
    bare.probes.clear();
    EXPECT_THROW(makeBenchMethods(bare), InputError);
}

TEST(BenchFamily, ABakedProbeShowsTheSceneAsItWasBaked)
{
    const Case moved = readBenchCase("refraction_techniques/moved"),
               still = readBenchCase("refraction_techniques/still");
    const Cubemap before = bakedBy(moved, "baked probe, 64"), now = bakedBy(still, "baked probe, 64");
    EXPECT_EQ(before.size, 64);
    // From the capture position to the ball's middle, where it is and where it was.
    const glm::dvec3 from = moved.probes.front().capturePosition;
    const glm::dvec3 ball = moved.scene.primitives[3].center, color = moved.scene.primitives[3].radiance.colorA;
    const glm::dvec3 was = ball - moved.history->moved[1].by;
    EXPECT_LT(glm::length(nearestTexel(now, ball - from) - color), 1e-6);
    EXPECT_GT(glm::length(nearestTexel(before, ball - from) - color), 0.1);
    EXPECT_LT(glm::length(nearestTexel(before, was - from) - color), 1e-6);
}

TEST(BenchFamily, AdviceGoesByTheFamilysCost)
{
    const BenchScene scene = makeTechniques();
    EXPECT_EQ(chooseMethod(scene, parseBudget("Color<=0.5"))->kind, "baked");
    EXPECT_EQ(chooseMethod(scene, parseBudget("Color<=0.1"))->kind, "realtime");
    EXPECT_EQ(chooseMethod(scene, parseBudget("Color<=0.04"))->kind, "screen");
    EXPECT_THROW(chooseMethod(scene, parseBudget("HitDepth<=1")), InputError);
}

TEST(BenchFamily, TablesAndChartsNameTheFamilysFigures)
{
    BenchResult result;
    result.fingerprint.device = "device";
    result.scenes = {makeTechniques()};
    const std::string table = formatBenchTable(result.scenes[0]);
    for (const char* column : {"Color", "ColorP95", "Reads", "Rendered", "Cost", "FrameShare"})
        EXPECT_NE(table.find(column), std::string::npos) << column;
    const std::vector<Chart> charts = makeBenchCharts(result);
    ASSERT_EQ(charts.size(), 3U);
    EXPECT_EQ(charts[0].id, "refraction_techniques_room_cost");
    EXPECT_EQ(charts[0].points.size(), 3U);
    EXPECT_DOUBLE_EQ(charts[0].points[1].cost, 12);
    EXPECT_NE(charts[2].costLabel.find("device"), std::string::npos);
}

TEST(BenchFamily, GlossyMethodsAreTwoMappingsOfEachChain)
{
    const Case testCase = readBenchCase("glossy/room");
    const auto methods = makeBenchMethods(testCase);
    EXPECT_EQ(methods.size(), 12U);
    Case varied = testCase;
    findMethod(methods, "exact, means, 32").apply(varied);
    EXPECT_TRUE(varied.profile.exactMip);
    const Cubemap means = readCubemap(std::get<CubemapFile>(varied.probes.front().environment.content).file);
    EXPECT_EQ(means.size, 32);
    // Straight up from the capture position is the ceiling; the mirror ball around it is not seen.
    const glm::dvec3 up = nearestTexel(means, {0.1, 1, 0.1});
    EXPECT_TRUE(glm::length(up - testCase.scene.primitives[1].radiance.colorA) < 1e-6 ||
                glm::length(up - testCase.scene.primitives[1].radiance.colorB) < 1e-6);
    Case hdrp = testCase;
    hdrp.probeProfile = ProbeProfile::kHdrp;
    EXPECT_THROW(makeBenchMethods(hdrp), InputError);
}

TEST(BenchFamily, DepthFormatsAreSixUnderTwoTracers)
{
    const Case testCase = readBenchCase("depth_formats/room");
    const auto methods = makeBenchMethods(testCase);
    ASSERT_EQ(methods.size(), 12U);
    Case varied = testCase;
    findMethod(methods, "standard 16, patches").apply(varied);
    EXPECT_EQ(varied.camera.depthConvention, DepthConvention::kStandard);
    EXPECT_EQ(varied.camera.depthFormat, DepthFormat::kUnorm16);
    // Half a step of 16 bits, between 0.1 m and 100 m: 0.5 / 65535 * (1/0.1 - 1/100).
    EXPECT_NEAR(varied.projection.patches.depthError, 0.5 / 65535 * 9.99, 1e-9);
    findMethod(methods, "reversed 32, patches").apply(varied);
    EXPECT_EQ(varied.projection.patches.depthError, 0.0);
    EXPECT_EQ(findMethod(methods, "reversed 24, HiZ").kind, "depth24");
}

TEST(BenchFamily, RefractionModelsAreChartedByInstructionsAndTime)
{
    BenchScene scene;
    scene.name = "bench/refraction_models/lens";
    scene.effect = "refraction";
    scene.points = {{"Box",
                     "box",
                     {{"RayDirWS", 20}, {"RayOriginWS", 0.3}, {"PathLength", 0.2}},
                     {{"Instructions", 573}},
                     {1, 1, 1, 1.5}}};
    BenchResult result;
    result.scenes = {scene};
    const std::vector<Chart> charts = makeBenchCharts(result);
    ASSERT_EQ(charts.size(), 4U);
    EXPECT_EQ(charts[2].id, "refraction_models_lens_PathLength");
    EXPECT_DOUBLE_EQ(charts[2].points[0].cost, 573);
    EXPECT_DOUBLE_EQ(charts[2].points[0].error, 0.2);
    EXPECT_DOUBLE_EQ(charts[3].points[0].cost, 1.5);
}
