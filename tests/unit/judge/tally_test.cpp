// What all comparators share: masks, outliers, percentiles, the worst pixel, and broken input.
#include "tests/unit/judge/planes.h"

#include "harness/base/error.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <chrono>
#include <random>

using namespace crossray;
using namespace crossray::test;

namespace {

constexpr OutputType kAllTypes[] = {OutputType::kDirection, OutputType::kDepth,  OutputType::kHitClass,
                                    OutputType::kColor,     OutputType::kScalar, OutputType::kCount};

int channelsOf(OutputType type)
{
    return type == OutputType::kDirection || type == OutputType::kColor ? 3 : 1;
}

Tolerance toleranceOfAll(double bound)
{
    Tolerance tolerance = absolute(bound);
    tolerance.degrees = bound;
    tolerance.relative = bound;
    return tolerance;
}

} // namespace

TEST(Compare, everyTypePassesTheSameAndFailsTheOther)
{
    for (const OutputType type : kAllTypes) {
        Plane expected("e", 4, 3, channelsOf(type), 0.0);
        for (size_t i = 0; i < expected.values.size(); i += static_cast<size_t>(channelsOf(type)))
            expected.values[i] = 1.0;
        EXPECT_TRUE(compare(type, expected, expected, {}, toleranceOfAll(0.01)).passed);
        Plane actual = expected;
        actual.at(2, 1) = 3.0;
        const Comparison failed = compare(type, expected, actual, {}, toleranceOfAll(0.01));
        EXPECT_FALSE(failed.passed) << static_cast<int>(type);
        EXPECT_EQ(failed.failed, 1U);
        EXPECT_EQ(failed.compared, 12U);
        EXPECT_EQ(failed.worst->x, 2);
        EXPECT_EQ(failed.worst->y, 1);
        EXPECT_FALSE(failed.reason.empty());
    }
}

TEST(Compare, aShapeThatDiffersIsABrokenCase)
{
    for (const OutputType type : kAllTypes) {
        const int channels = channelsOf(type);
        const Plane plane("e", 4, 3, channels, 0.0);
        EXPECT_THROW(compare(type, plane, Plane("a", 3, 4, channels), {}, toleranceOfAll(1)), InputError);
        EXPECT_THROW(compare(type, plane, Plane("a", 4, 3, channels + 1), {}, toleranceOfAll(1)), InputError);
        EXPECT_THROW(compare(type, plane, plane, Mask(11, 1), toleranceOfAll(1)), InputError);
        Plane cut = plane;
        cut.values.pop_back();
        EXPECT_THROW(compare(type, plane, cut, {}, toleranceOfAll(1)), InputError);
    }
}

TEST(Compare, aBoundThatIsNoBoundIsABrokenCase)
{
    const Plane plane = row(1, {1});
    EXPECT_THROW(compareDepths(plane, plane, {}, {}), InputError);
    Tolerance degreesOnly;
    degreesOnly.degrees = 1.0;
    EXPECT_THROW(compareScalars(plane, plane, {}, degreesOnly), InputError);
    EXPECT_THROW(compareScalars(plane, plane, {}, absolute(-1e-9)), InputError);
    EXPECT_THROW(compareScalars(plane, plane, {}, absolute(kNan)), InputError);
    Tolerance share = absolute(1.0);
    share.outlierShare = 0.1;
    EXPECT_THROW(compareScalars(plane, plane, {}, share), InputError) << "a share never stands alone";
    share.worst = 1.0;
    EXPECT_NO_THROW(compareScalars(plane, plane, {}, share));
    share.outlierShare = 1.1;
    EXPECT_THROW(compareScalars(plane, plane, {}, share), InputError);
}

TEST(Compare, theMaskLeavesPixelsOut)
{
    const Plane expected = row(1, {1, 1, 1, 1});
    const Plane actual = row(1, {9, 1, kNan, 1});
    EXPECT_TRUE(compareScalars(expected, actual, {0, 1, 0, 1}, absolute(0.1)).passed);
    EXPECT_EQ(compareScalars(expected, actual, {0, 1, 0, 1}, absolute(0.1)).compared, 2U);
    EXPECT_EQ(compareScalars(expected, actual, {0, 1, 1, 1}, absolute(0.1)).worst->x, 2);
}

TEST(Compare, nothingToCompareFails)
{
    const Plane plane = row(1, {1, 1});
    const Comparison result = compareScalars(plane, plane, {0, 0}, absolute(0.1));
    EXPECT_FALSE(result.passed);
    EXPECT_EQ(result.compared, 0U);
    EXPECT_EQ(result.reason, "no pixel to compare");
}

TEST(Compare, outliersAreAcceptedUpToTheShareAndTheWorst)
{
    std::vector<double> values(100, 0.0);
    const Plane expected = row(1, values);
    values[10] = 0.5;
    values[20] = 0.25;
    const Plane actual = row(1, values);
    Tolerance tolerance = absolute(0.1);
    EXPECT_FALSE(compareScalars(expected, actual, {}, tolerance).passed);
    tolerance.outlierShare = 0.02;
    tolerance.worst = 0.5;
    const Comparison accepted = compareScalars(expected, actual, {}, tolerance);
    EXPECT_TRUE(accepted.passed);
    EXPECT_EQ(accepted.failed, 2U) << "accepted outliers are still counted";
    EXPECT_EQ(accepted.census.at("beyond tolerance"), 2U);
    EXPECT_TRUE(accepted.reason.empty());
    tolerance.worst = 0.49;
    EXPECT_FALSE(compareScalars(expected, actual, {}, tolerance).passed);
    tolerance.worst = 0.5;
    tolerance.outlierShare = 0.0199;
    EXPECT_FALSE(compareScalars(expected, actual, {}, tolerance).passed);
}

TEST(Compare, noOutlierShareAcceptsANan)
{
    Tolerance tolerance = absolute(0.1);
    tolerance.outlierShare = 1.0;
    tolerance.worst = kInf;
    EXPECT_FALSE(compareScalars(row(1, {1, 1}), row(1, {1, kNan}), {}, tolerance).passed);
    EXPECT_TRUE(compareScalars(row(1, {1, 1}), row(1, {1, 2}), {}, tolerance).passed);
    tolerance.degrees = 1.0;
    EXPECT_FALSE(compareDirections(row(3, {0, 0, 1}), row(3, {0, 0, 0}), {}, tolerance).passed);
    EXPECT_FALSE(compareHitClasses(row(1, {1}), row(1, {kNan}), {}, tolerance).passed);
}

TEST(Compare, theWorstIsAFailedPixelAndTheFirstOfEquals)
{
    // The first pixel is the farthest by the unit, but within a bound: the worst is among those that failed.
    Tolerance tolerance = absolute(0.0);
    tolerance.relative = 0.01;
    const Comparison result = compareScalars(row(1, {1000, 1, 1, 1}), row(1, {1001, 1.1, 1.5, 1.5}), {}, tolerance);
    EXPECT_EQ(result.failed, 3U);
    EXPECT_EQ(result.worst->x, 2);
    EXPECT_EQ(result.max, 1.0);
    // Row order across rows.
    Plane expected("e", 3, 3, 1);
    Plane actual = expected;
    actual.at(0, 2) = actual.at(2, 1) = 1.0;
    const Comparison tie = compareScalars(expected, actual, {}, absolute(0.1));
    EXPECT_EQ(tie.worst->x, 2);
    EXPECT_EQ(tie.worst->y, 1);
    // NaN outranks every number.
    const Comparison nan = compareScalars(row(1, {0, 0, 0}), row(1, {1e300, kNan, kInf}), {}, absolute(0.1));
    EXPECT_EQ(nan.worst->x, 1);
    EXPECT_NE(nan.reason.find("expected 0, actual nan"), std::string::npos) << nan.reason;
}

TEST(Compare, percentilesAreByNearestRank)
{
    std::vector<double> values;
    for (int i = 100; i >= 1; --i)
        values.push_back(i);
    const Comparison result = compareScalars(row(1, std::vector<double>(100, 0.0)), row(1, values), {}, absolute(1000));
    EXPECT_EQ(result.median, 50.0);
    EXPECT_EQ(result.p95, 95.0);
    EXPECT_EQ(result.p99, 99.0);
    EXPECT_EQ(result.max, 100.0);
    EXPECT_DOUBLE_EQ(result.mean, 50.5);
    // Not finite: left out.
    const Comparison some = compareScalars(row(1, {0, 0, 0}), row(1, {kNan, 3, kInf}), {}, absolute(1000));
    EXPECT_EQ(some.median, 3.0);
    EXPECT_EQ(some.p99, 3.0);
    EXPECT_EQ(some.max, 3.0);
}

RC_GTEST_PROP(Compare, statisticsMatchASortedList, (std::vector<uint16_t> seeds))
{
    RC_PRE(!seeds.empty());
    std::vector<double> values(seeds.begin(), seeds.end());
    const Comparison result =
        compareScalars(row(1, std::vector<double>(values.size(), 0.0)), row(1, values), {}, absolute(1e9));
    std::sort(values.begin(), values.end());
    const auto rank = [&](size_t percent) { return values[(values.size() * percent + 99) / 100 - 1]; };
    RC_ASSERT(result.median == rank(50));
    RC_ASSERT(result.p95 == rank(95));
    RC_ASSERT(result.p99 == rank(99));
    RC_ASSERT(result.max == values.back());
}

RC_GTEST_PROP(Compare, theOrderOfPixelsDoesNotChangeTheCounts, (std::vector<uint8_t> seeds, uint32_t shuffle))
{
    constexpr double kValues[] = {0.0, 1.0, 2.0, 3.0, 0.5, 1e-30, kNan, kInf, -kInf, -1.0};
    std::vector<std::pair<double, double>> pairs;
    for (const uint8_t seed : seeds)
        pairs.emplace_back(kValues[seed % 10], kValues[seed / 10 % 10]);
    const auto judge = [&](OutputType type) {
        std::vector<double> e, a;
        for (const auto& [first, second] : pairs) {
            e.push_back(first);
            a.push_back(second);
        }
        return compare(type, row(1, e), row(1, a), {}, absolute(0.6));
    };
    std::vector<Comparison> before;
    const auto types = {OutputType::kDepth, OutputType::kScalar, OutputType::kHitClass, OutputType::kCount};
    for (const OutputType type : types)
        before.push_back(judge(type));
    std::shuffle(pairs.begin(), pairs.end(), std::mt19937(shuffle));
    size_t i = 0;
    for (const OutputType type : types) {
        const Comparison after = judge(type);
        RC_ASSERT(after.census == before[i].census);
        RC_ASSERT(after.failed == before[i].failed);
        RC_ASSERT(after.median == before[i].median);
        RC_ASSERT(after.max == before[i].max);
        RC_ASSERT(sumOf(after.census) == after.failed);
        RC_ASSERT(after.passed == (after.failed == 0 && after.compared > 0));
        ++i;
    }
}

TEST(Compare, aPlaneOf64By64TakesNoTime)
{
    // Far above the real time, for slow and shared machines: it catches an accidental square or an allocation per
    // pixel.
    for (const OutputType type : kAllTypes) {
        const int channels = channelsOf(type);
        Plane expected("e", 64, 64, channels);
        Plane actual("a", 64, 64, channels);
        for (size_t pixel = 0; pixel < 4096; ++pixel) {
            const size_t value = pixel * static_cast<size_t>(channels);
            expected.values[value] = 1.0;
            const double angle = 1e-3 * static_cast<double>(pixel % 7);
            actual.values[value] = channels == 3 ? std::cos(angle) : 1.0 + static_cast<double>(pixel % 2);
            if (channels == 3) actual.values[value + 1] = std::sin(angle);
        }
        double best = 1e9;
        for (int repeat = 0; repeat < 20; ++repeat) {
            const auto start = std::chrono::steady_clock::now();
            compare(type, expected, actual, {}, toleranceOfAll(1e-6));
            const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
            best = std::min(best, took.count());
        }
        RecordProperty("ms_type_" + std::to_string(static_cast<int>(type)), std::to_string(best));
        EXPECT_LT(best, 2.0) << static_cast<int>(type);
    }
}
