#include "harness/bench/tracer_yardstick.h"

#include <gtest/gtest.h>

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
    EXPECT_NE(formatTracerTable(std::span(&row, 1)).find("| x | 0.750 (0.500) |"), std::string::npos);
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

// The tracer over planes at its worth: loosely, on four small rooms, so that a loss of quality or of speed shows.
TEST(TracerYardstick, TheLibrarysTracersKeepTheirWorth)
{
    const std::vector<TracerRow> rows = measureTracers(libraryTracers(0.1), 1, 4, 320, 180);
    ASSERT_EQ(rows.size(), 5u);
    for (size_t i = 0; i < 4; ++i) {
        EXPECT_GT(rows[i].mean.recall, 0.93) << rows[i].name;
        EXPECT_GT(rows[i].mean.precision, 0.975) << rows[i].name;
        EXPECT_LT(rows[i].mean.falseShare, 0.02) << rows[i].name;
        EXPECT_LT(rows[i].mean.p95Pixels, 0.02) << rows[i].name;
        EXPECT_LT(rows[i].mean.medianDepth, 1e-5) << rows[i].name;
        EXPECT_LT(rows[i].mean.fetches, 20) << rows[i].name;
        if (i > 0) {
            EXPECT_LE(rows[i].mean.recall, rows[i - 1].mean.recall);
            EXPECT_LE(rows[i].mean.falseShare, rows[i - 1].mean.falseShare);
        }
    }
    EXPECT_LT(rows[1].mean.falseShare, rows[4].mean.falseShare);
}
