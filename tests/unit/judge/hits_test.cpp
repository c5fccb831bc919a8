#include "tests/unit/judge/planes.h"

#include "harness/base/error.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <random>

using namespace crossray;
using namespace crossray::test;

namespace {

constexpr double kHit = 1.0, kMiss = 2.0, kUnknown = 3.0;

HitTruth answerable(double x, double y)
{
    return {true, true, x, y};
}
HitTruth unanswerable()
{
    return {true, false, 0, 0};
}

HitBudget budget(std::optional<double> recall, std::optional<double> precision, std::optional<double> falseHits)
{
    return {recall, precision, falseHits, 2.0};
}

// Five answerable rays (two right, one 3 px off, two not found), three unanswerable (one claimed), one pixel without a
// ray: recall, precision and false hits all have another denominator.
struct Example {
    std::vector<HitTruth> truth{answerable(10, 10), answerable(20, 10), answerable(30, 10),
                                answerable(40, 10), answerable(50, 10), unanswerable(),
                                unanswerable(),     unanswerable(),     HitTruth{}};
    Plane success = row(1, {kHit, kHit, kHit, kUnknown, kMiss, kHit, kMiss, kUnknown, kHit});
    Plane positions = row(2, {10, 10, 21, 11, 30, 13, 0, 0, 0, 0, 5, 5, 0, 0, 0, 0, 7, 7});
};

} // namespace

TEST(JudgeHits, theDefinitionsOfTheYardstick)
{
    const Example example;
    const Comparison result = judgeHits(example.truth, example.success, &example.positions, budget(0.4, 0.5, 0.34));
    EXPECT_TRUE(result.passed) << result.reason;
    EXPECT_DOUBLE_EQ(result.metrics.at("recall"), 2.0 / 5.0);
    EXPECT_DOUBLE_EQ(result.metrics.at("precision"), 2.0 / 4.0);
    EXPECT_DOUBLE_EQ(result.metrics.at("false"), 1.0 / 3.0);
    EXPECT_EQ(result.metrics.at("answerable"), 5.0);
    EXPECT_EQ(result.metrics.at("unanswerable"), 3.0);
    EXPECT_EQ(result.metrics.at("claimed"), 4.0) << "a pixel without a ray claims nothing";
    EXPECT_EQ(result.compared, 8U);
    EXPECT_EQ(result.failed, 4U);
    EXPECT_EQ(result.census.at("hit at the wrong place"), 1U);
    EXPECT_EQ(result.census.at("unknown for hit"), 1U);
    EXPECT_EQ(result.census.at("miss for hit"), 1U);
    EXPECT_EQ(result.census.at("hit for unanswerable"), 1U);
    EXPECT_EQ(result.confusion->counts[1][1], 3U);
    EXPECT_EQ(result.confusion->counts[1][3], 1U);
    EXPECT_EQ(result.confusion->counts[3][1], 1U);
    EXPECT_DOUBLE_EQ(result.max, 3.0);
    EXPECT_DOUBLE_EQ(result.median, std::sqrt(2.0));
    EXPECT_EQ(result.unit, "px");
}

TEST(JudgeHits, eachBoundCanFail)
{
    const Example example;
    const auto judge = [&](const HitBudget& bounds) {
        return judgeHits(example.truth, example.success, &example.positions, bounds);
    };
    EXPECT_FALSE(judge(budget(0.41, {}, {})).passed);
    EXPECT_TRUE(judge(budget(0.40, {}, {})).passed);
    EXPECT_FALSE(judge(budget({}, 0.51, {})).passed);
    EXPECT_TRUE(judge(budget({}, 0.50, {})).passed);
    EXPECT_FALSE(judge(budget({}, {}, 0.33)).passed);
    EXPECT_TRUE(judge(budget({}, {}, 0.34)).passed);
}

TEST(JudgeHits, theReasonSaysTheWorstFirst)
{
    const Example example;
    const Comparison result = judgeHits(example.truth, example.success, &example.positions, budget(0.6, 0.9, 0.2));
    EXPECT_EQ(result.reason, "precision 0.5000 is below 0.9, recall 0.4000 is below 0.6, false 0.3333 is above 0.2; "
                             "3 px off at (2, 0): expected (30, 10), actual (30, 13)");
    const Comparison falseFirst = judgeHits(example.truth, example.success, &example.positions, budget({}, {}, 0.0));
    EXPECT_EQ(falseFirst.worst->x, 5);
}

TEST(JudgeHits, theDistanceIsInclusiveAndTheBudgetsOwn)
{
    const std::vector<HitTruth> truth{answerable(10, 10)};
    const Plane success = row(1, {kHit});
    const Plane twoOff = row(2, {12, 10});
    EXPECT_TRUE(judgeHits(truth, success, &twoOff, budget(1.0, {}, {})).passed);
    HitBudget narrow = budget(1.0, {}, {});
    narrow.positionPx = 1.9;
    EXPECT_FALSE(judgeHits(truth, success, &twoOff, narrow).passed);
}

TEST(JudgeHits, withoutPositionsAClaimedAnswerableHitIsRight)
{
    const Example example;
    const Comparison result = judgeHits(example.truth, example.success, nullptr, budget(0.6, 0.75, 0.34));
    EXPECT_TRUE(result.passed) << result.reason;
    EXPECT_DOUBLE_EQ(result.metrics.at("recall"), 0.6);
}

TEST(JudgeHits, aPositionThatIsNoNumberIsNeverRight)
{
    const std::vector<HitTruth> truth{answerable(10, 10), answerable(10, 10)};
    const Plane success = row(1, {kHit, kHit});
    HitBudget wide = budget(0.6, {}, {});
    wide.positionPx = kInf;
    const Plane positions = row(2, {kNan, 10, kInf, 10});
    const Comparison result = judgeHits(truth, success, &positions, wide);
    EXPECT_FALSE(result.passed);
    EXPECT_EQ(result.census.at("hit at no finite place"), 2U);
    EXPECT_EQ(result.metrics.at("right"), 0.0);
}

TEST(JudgeHits, whatIsNoClassIsNoHit)
{
    const std::vector<HitTruth> truth{answerable(1, 1), answerable(1, 1), unanswerable(), unanswerable()};
    const Plane success = row(1, {kNan, 1.5, kNan, 7});
    const Comparison result = judgeHits(truth, success, nullptr, budget(0.1, {}, 1.0));
    EXPECT_FALSE(result.passed);
    EXPECT_EQ(result.census.at("NaN for hit"), 1U);
    EXPECT_EQ(result.census.at("no class for hit"), 1U);
    EXPECT_EQ(result.census.at("NaN for unanswerable"), 1U);
    EXPECT_EQ(result.census.at("no class for unanswerable"), 1U);
}

TEST(JudgeHits, whatCannotFailProvesNothing)
{
    const std::vector<HitTruth> none{HitTruth{}};
    EXPECT_FALSE(judgeHits(none, row(1, {kHit}), nullptr, budget(0.0, 0.0, 1.0)).passed);
    const std::vector<HitTruth> sky{unanswerable()};
    EXPECT_FALSE(judgeHits(sky, row(1, {kMiss}), nullptr, budget(0.0, {}, {})).passed) << "no ray is answerable";
    EXPECT_FALSE(judgeHits(sky, row(1, {kMiss}), nullptr, budget({}, 0.0, {})).passed) << "no hit is claimed";
    EXPECT_TRUE(judgeHits(sky, row(1, {kMiss}), nullptr, budget({}, {}, 0.0)).passed);
    EXPECT_FALSE(judgeHits(sky, row(1, {kHit}), nullptr, budget({}, {}, 0.0)).passed);
}

TEST(JudgeHits, brokenInputIsABrokenCase)
{
    const std::vector<HitTruth> truth{answerable(1, 1)};
    const Plane success = row(1, {kHit});
    const Plane wide = row(1, {kHit, kHit});
    const Plane flat = row(1, {0});
    EXPECT_THROW(judgeHits(truth, success, nullptr, budget({}, {}, {})), InputError);
    EXPECT_THROW(judgeHits(truth, wide, nullptr, budget(0.5, {}, {})), InputError);
    EXPECT_THROW(judgeHits(truth, success, &flat, budget(0.5, {}, {})), InputError);
    EXPECT_THROW(judgeHits(truth, success, nullptr, budget(1.5, {}, {})), InputError);
    EXPECT_THROW(judgeHits(truth, success, nullptr, budget(kNan, {}, {})), InputError);
    HitBudget negative = budget(0.5, {}, {});
    negative.positionPx = -1.0;
    EXPECT_THROW(judgeHits(truth, success, nullptr, negative), InputError);
}

RC_GTEST_PROP(JudgeHits, countsDoNotDependOnTheOrder, (std::vector<uint8_t> seeds, uint32_t shuffle))
{
    const auto judge = [&] {
        std::vector<HitTruth> truth;
        std::vector<double> success, positions;
        for (const uint8_t seed : seeds) {
            truth.push_back({(seed & 1) != 0, (seed & 3) == 3, 10, 10});
            success.push_back(seed / 4 % 4);
            positions.push_back(10 + seed / 16 % 4);
            positions.push_back(10);
        }
        const Plane positionPlane = row(2, positions);
        return judgeHits(truth, row(1, success), &positionPlane, budget(0.5, 0.5, 0.5));
    };
    const Comparison before = judge();
    std::shuffle(seeds.begin(), seeds.end(), std::mt19937(shuffle));
    const Comparison after = judge();
    RC_ASSERT(before.metrics == after.metrics);
    RC_ASSERT(before.census == after.census);
    RC_ASSERT(before.passed == after.passed);
    RC_ASSERT(sumOf(after.census) == after.failed);
}
