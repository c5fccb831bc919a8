#include "tests/unit/judge/planes.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

using namespace crossray;
using namespace crossray::test;

TEST(CompareHitClasses, isExactAndFillsTheConfusionMatrix)
{
    const Plane expected = row(1, {1, 1, 1, 2, 2, 3, 0});
    EXPECT_TRUE(compareHitClasses(expected, expected, {}, {}).passed);
    const Comparison failed = compareHitClasses(expected, row(1, {1, 2, 2, 1, 2, 3, 0}), {}, {});
    EXPECT_FALSE(failed.passed);
    EXPECT_EQ(failed.failed, 3U);
    EXPECT_EQ(failed.unit, "class");
    ASSERT_TRUE(failed.confusion.has_value());
    EXPECT_EQ(failed.confusion->counts[1][1], 1U);
    EXPECT_EQ(failed.confusion->counts[1][2], 2U);
    EXPECT_EQ(failed.confusion->counts[2][1], 1U);
    EXPECT_EQ(failed.confusion->counts[2][2], 1U);
    EXPECT_EQ(failed.confusion->counts[3][3], 1U);
    EXPECT_EQ(failed.confusion->counts[0][0], 1U);
    EXPECT_EQ(failed.census.at("miss for hit"), 2U);
    EXPECT_EQ(failed.census.at("hit for miss"), 1U);
    EXPECT_EQ(failed.worst->x, 1) << "the first in row order";
}

TEST(CompareHitClasses, everyPairOfClassesDiffers)
{
    for (int e = 0; e < 4; ++e) {
        for (int a = 0; a < 4; ++a) {
            const Comparison result = compareHitClasses(row(1, {double(e)}), row(1, {double(a)}), {}, {});
            EXPECT_EQ(result.passed, e == a) << e << " " << a;
            EXPECT_EQ(result.confusion->counts[e][a], 1U);
        }
    }
}

TEST(CompareHitClasses, whatIsNoClassFails)
{
    EXPECT_EQ(compareHitClasses(row(1, {1}), row(1, {0.999}), {}, {}).census.at("no class for hit"), 1U);
    EXPECT_EQ(compareHitClasses(row(1, {1}), row(1, {4}), {}, {}).census.at("no class for hit"), 1U);
    EXPECT_EQ(compareHitClasses(row(1, {1}), row(1, {kInf}), {}, {}).census.at("no class for hit"), 1U);
    EXPECT_EQ(compareHitClasses(row(1, {3}), row(1, {kNan}), {}, {}).census.at("NaN for unknown"), 1U);
    EXPECT_EQ(compareHitClasses(row(1, {kNan}), row(1, {2}), {}, {}).census.at("miss for NaN"), 1U);
    EXPECT_FALSE(compareHitClasses(row(1, {5}), row(1, {5}), {}, {}).passed);
    EXPECT_TRUE(compareHitClasses(row(1, {kNan}), row(1, {kNan}), {}, {}).passed);
    EXPECT_TRUE(compareHitClasses(row(1, {0}), row(1, {-0.0}), {}, {}).passed);
}

TEST(CompareCounts, isExactHoweverWideTheTolerance)
{
    Tolerance wide;
    wide.absolute = 100.0;
    wide.relative = 100.0;
    EXPECT_TRUE(compareCounts(row(1, {7}), row(1, {7}), {}, {}).passed);
    EXPECT_FALSE(compareCounts(row(1, {7}), row(1, {8}), {}, wide).passed);
    EXPECT_EQ(compareCounts(row(1, {7}), row(1, {5}), {}, {}).worst->error, 2.0);
    EXPECT_EQ(compareCounts(row(1, {7}), row(1, {7.5}), {}, wide).census.at("fraction for whole number"), 1U);
    EXPECT_EQ(compareCounts(row(1, {7}), row(1, {kNan}), {}, wide).census.at("NaN for whole number"), 1U);
    EXPECT_FALSE(compareCounts(row(1, {7.5}), row(1, {7.5}), {}, wide).passed);
    EXPECT_TRUE(compareCounts(row(1, {kNan}), row(1, {kNan}), {}, {}).passed);
}

TEST(CompareCounts, outliersNeedAShareAndABound)
{
    Tolerance some;
    some.outlierShare = 0.5;
    some.worst = 1.0;
    EXPECT_TRUE(compareCounts(row(1, {7, 7}), row(1, {8, 7}), {}, some).passed);
    EXPECT_FALSE(compareCounts(row(1, {7, 7}), row(1, {9, 7}), {}, some).passed);
    EXPECT_FALSE(compareCounts(row(1, {7, 7}), row(1, {8, 8}), {}, some).passed);
}

RC_GTEST_PROP(CompareHitClasses, swappingTransposesTheMatrix, (std::vector<uint8_t> seeds))
{
    std::vector<double> a, b;
    for (const uint8_t seed : seeds) {
        a.push_back(seed % 4);
        b.push_back(seed / 4 % 4);
    }
    const Comparison ab = compareHitClasses(row(1, a), row(1, b), {}, {});
    const Comparison ba = compareHitClasses(row(1, b), row(1, a), {}, {});
    RC_ASSERT(ab.failed == ba.failed);
    uint64_t sum = 0;
    for (int e = 0; e < 4; ++e) {
        for (int c = 0; c < 4; ++c) {
            RC_ASSERT(ab.confusion->counts[e][c] == ba.confusion->counts[c][e]);
            sum += ab.confusion->counts[e][c];
        }
    }
    RC_ASSERT(sum == seeds.size());
}
