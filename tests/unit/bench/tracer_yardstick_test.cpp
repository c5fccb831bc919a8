#include "harness/bench/tracer_report.h"
#include "harness/bench/tracer_yardstick.h"

#include <gtest/gtest.h>

#include <map>

using namespace crossray;

namespace {

// 4 answerable rays that hit at x = 10, 2 hidden ones, 2 that hit nothing.
YardstickScene makeScene()
{
    YardstickScene scene;
    for (int i = 0; i < 8; ++i) {
        YardstickRay ray;
        ray.x = i;
        ray.truth = i < 4 ? RayTruth::kAnswerable : (i < 6 ? RayTruth::kHidden : RayTruth::kNothing);
        ray.hitPositionSS = {10.0, 0.0};
        ray.hitLinearDepth = 5;
        scene.rays.push_back(ray);
    }
    return scene;
}

} // namespace

TEST(TracerYardstick, CountsWhatIsRightWrongAndFalse)
{
    // Right by 0, by 2 (the limit), wrong by 2.5, missed; a hidden one claimed, one not; one of the last two claimed.
    const TracerScore score = scoreTracer(makeScene(), [](const YardstickRay& ray) {
        TracerAnswer answer;
        const double x[8] = {10, 12, 12.5, 0, 10, 0, 3, 0};
        answer.isHit = ray.x != 3 && ray.x != 5 && ray.x != 7;
        answer.positionSS = {x[ray.x], 0};
        answer.linearDepth = 5.5;
        answer.fetches = 10 * (ray.x + 1);
        answer.iterations = ray.x;
        answer.isCapped = ray.x == 7;
        return answer;
    });
    EXPECT_DOUBLE_EQ(score.recall, 2.0 / 4);
    EXPECT_DOUBLE_EQ(score.precision, 2.0 / 5);
    EXPECT_DOUBLE_EQ(score.falseShare, 2.0 / 4);
    EXPECT_DOUBLE_EQ(score.p95Pixels, 2);
    EXPECT_NEAR(score.medianDepth, 0.1, 1e-12);
    EXPECT_DOUBLE_EQ(score.fetches, 45);
    EXPECT_DOUBLE_EQ(score.groupFetches, 80);
    EXPECT_DOUBLE_EQ(score.iterations, 3.5);
    EXPECT_DOUBLE_EQ(score.capped, 1.0 / 8);
}

TEST(TracerYardstick, NothingToFindIsNothingLost)
{
    YardstickScene scene = makeScene();
    scene.rays.resize(4);
    const TracerScore score = scoreTracer(scene, [](const YardstickRay&) { return TracerAnswer{}; });
    EXPECT_EQ(score.recall, 0);
    EXPECT_EQ(score.precision, 1); // claimed nothing
    EXPECT_EQ(score.falseShare, 0);
    EXPECT_EQ(scoreTracer(YardstickScene{}, [](const YardstickRay&) { return TracerAnswer{}; }).recall, 1);
}

TEST(TracerYardstick, ARowIsTheMeanAndTheWorst)
{
    TracerScore good, bad;
    good.recall = 1;
    bad.recall = 0.5;
    good.falseShare = 0.25;
    bad.falseShare = 0;
    const std::vector<TracerScore> scores{good, bad};
    const TracerRow row = summarize("x", scores);
    EXPECT_DOUBLE_EQ(row.mean.recall, 0.75);
    EXPECT_DOUBLE_EQ(row.worst.recall, 0.5);
    EXPECT_DOUBLE_EQ(row.worst.falseShare, 0.25);
    EXPECT_EQ(row.scenes, 2);
    const MeasuredTracer measured{row, {}};
    EXPECT_NE(formatTracerTable(std::span(&measured, 1)).find("| x | 0.750 (0.500) |"), std::string::npos);
    EXPECT_NE(formatTracerCsv(std::span(&measured, 1)).find("\n\"x\",0.75,"), std::string::npos);
    EXPECT_NE(formatTracerJson({}, std::span(&measured, 1)).find("\"recall\": 0.75"), std::string::npos);
}

TEST(TracerYardstick, RaysOfARoomStartAtSurfacesAndKnowTheirTruth)
{
    const YardstickScene scene = makeYardstickRoom(3, 160, 90);
    int answerable = 0;
    for (const YardstickRay& ray : scene.rays) {
        EXPECT_EQ(ray.x % 4 + ray.y % 4, 0);
        EXPECT_NEAR(glm::length(ray.dirWS), 1, 1e-12);
        if (ray.truth != RayTruth::kAnswerable) continue;
        ++answerable;
        EXPECT_GE(ray.hitPositionSS.x, 0);
        EXPECT_LE(ray.hitPositionSS.x, 160);
        EXPECT_GT(ray.hitLinearDepth, 0);
    }
    EXPECT_GT(answerable, 200);
    EXPECT_EQ(scene.rays.size(), makeYardstickRoom(3, 160, 90).rays.size());
}

// Each tracer at its worth: loosely, on four small rooms, so that a loss of quality or of speed shows.
TEST(TracerYardstick, TracersKeepTheirWorth)
{
    YardstickOptions options;
    options.lastSeed = 4;
    options.width = 320;
    options.height = 180;
    options.threads = 2;
    std::map<std::string, TracerScore> found;
    for (const auto& methods : {libraryTracers(0.1), referenceTracers(0.1)}) {
        for (const MeasuredTracer& tracer : measureTracers(methods, options))
            found[tracer.row.name] = tracer.row.mean;
    }
    const TracerScore* last = nullptr;
    for (const char* name :
         {"patches, caution 0.25", "patches, caution 0.4", "patches, caution 0.5", "patches, caution 1"}) {
        const TracerScore& score = found.at(name);
        EXPECT_GT(score.recall, 0.93) << name;
        EXPECT_GT(score.precision, 0.975) << name;
        EXPECT_LT(score.falseShare, 0.02) << name;
        EXPECT_LT(score.p95Pixels, 0.02) << name;
        EXPECT_LT(score.medianDepth, 1e-5) << name;
        EXPECT_LT(score.fetches, 20) << name;
        if (last != nullptr) {
            EXPECT_LE(score.recall, last->recall) << name;
            EXPECT_LE(score.falseShare, last->falseShare) << name;
        }
        last = &score;
    }
    EXPECT_LT(found.at("patches, caution 0.4").falseShare, found.at("HiZ, levels 0 to 6, 512 steps").falseShare);
    EXPECT_GT(found.at("every pixel, nearest depth").recall, 0.9);
    EXPECT_GT(found.at("every pixel, nearest depth").fetches, 3 * found.at("closest-depth pyramid, 256 steps").fetches);
    EXPECT_GT(found.at("256 strides, 5 bisections").recall, found.at("64 strides, 5 bisections").recall);
    const TracerScore& oracle = found.at("oracle: what the depth buffer shows");
    EXPECT_GT(oracle.recall, found.at("patches, caution 0.25").recall);
    EXPECT_EQ(oracle.precision, 1);
    EXPECT_EQ(oracle.falseShare, 0);
}

TEST(TracerYardstick, FiguresDoNotDependOnTheThreads)
{
    YardstickOptions options;
    options.lastSeed = 3;
    options.width = 160;
    options.height = 90;
    const auto methods = libraryTracers(0.1);
    const auto one = measureTracers(methods, options);
    options.threads = 3;
    const auto three = measureTracers(methods, options);
    EXPECT_EQ(formatTracerJson({}, one), formatTracerJson({}, three));
    ASSERT_FALSE(one.front().reliability.empty());
    for (const ReliabilityBin& bin : one.front().reliability) {
        EXPECT_GT(bin.count, 0);
        EXPECT_LE(bin.confidence, 1);
        EXPECT_LE(bin.right, 1);
    }
}

TEST(TracerYardstick, DisturbancesLeaveTheTruth)
{
    const YardstickScene plain = makeYardstickScene(SceneFamily::kRandomRoom, 3, 96, 54);
    for (const Disturbance disturbance : allDisturbances()) {
        const YardstickScene scene = makeYardstickScene(SceneFamily::kRandomRoom, 3, 96, 54, 4, disturbance);
        EXPECT_EQ(findDisturbance(nameOf(disturbance)), disturbance);
        ASSERT_EQ(scene.rays.size(), plain.rays.size());
        EXPECT_EQ(scene.rays.back().dirWS, plain.rays.back().dirWS);
        if (disturbance == Disturbance::kNone) continue;
        EXPECT_TRUE(scene.gbuffer.plane(GBufferChannel::kDeviceDepth).values !=
                        plain.gbuffer.plane(GBufferChannel::kDeviceDepth).values ||
                    scene.gbuffer.plane(GBufferChannel::kNormalWS).values !=
                        plain.gbuffer.plane(GBufferChannel::kNormalWS).values)
            << nameOf(disturbance);
    }
}
