#include "tests/unit/judge/planes.h"

#include "harness/base/error.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cfloat>

using namespace crossray;
using namespace crossray::test;

namespace {

Tolerance relative(double bound)
{
    Tolerance tolerance;
    tolerance.relative = bound;
    return tolerance;
}

Tolerance ulps(double bound)
{
    Tolerance tolerance;
    tolerance.ulps = bound;
    return tolerance;
}

Comparison depth(double e, double a, const Tolerance& t)
{
    return compareDepths(row(1, {e}), row(1, {a}), {}, t);
}
Comparison scalar(double e, double a, const Tolerance& t)
{
    return compareScalars(row(1, {e}), row(1, {a}), {}, t);
}

} // namespace

TEST(CompareDepths, relativeErrorPassesWithinAndFailsBeyond)
{
    EXPECT_TRUE(depth(2.0, 2.0199, relative(0.01)).passed);
    EXPECT_TRUE(depth(-2.0, -2.0199, relative(0.01)).passed);
    EXPECT_FALSE(depth(2.0, 2.0201, relative(0.01)).passed);
    EXPECT_FALSE(depth(2.0, -2.0, relative(1.0)).passed);
    const Comparison failed = depth(2.0, 2.5, relative(0.01));
    EXPECT_EQ(failed.unit, "relative");
    EXPECT_DOUBLE_EQ(failed.worst->error, 0.25);
    EXPECT_EQ(failed.reason,
              "worst 0.25 relative at (0, 0): expected 2, actual 2.5; 1 of 1 px (100.00 %): 1 beyond tolerance");
}

TEST(CompareDepths, anyBoundThatIsSetLetsAPixelPass)
{
    Tolerance tolerance = relative(1e-9);
    EXPECT_FALSE(depth(100.0, 100.5, tolerance).passed);
    tolerance.absolute = 1.0;
    EXPECT_TRUE(depth(100.0, 100.5, tolerance).passed);
    tolerance.absolute = 0.1;
    EXPECT_FALSE(depth(100.0, 100.5, tolerance).passed);
    tolerance.ulps = 65536; // a float near 100 is 2^-17 from the next
    EXPECT_TRUE(depth(100.0, 100.5, tolerance).passed);
    tolerance.ulps = 65535;
    EXPECT_FALSE(depth(100.0, 100.5, tolerance).passed);
}

TEST(CompareDepths, ulpsAloneAreTheUnit)
{
    const float next = std::nextafterf(std::nextafterf(3.0F, 4.0F), 4.0F);
    EXPECT_TRUE(depth(3.0, next, ulps(2)).passed);
    const Comparison failed = depth(3.0, next, ulps(1));
    EXPECT_FALSE(failed.passed);
    EXPECT_EQ(failed.unit, "ulp");
    EXPECT_EQ(failed.worst->error, 2.0);
    Tolerance precise = ulps(2);
    precise.doublePrecision = true;
    EXPECT_FALSE(depth(3.0, next, precise).passed);
    EXPECT_TRUE(depth(3.0, std::nextafter(3.0, 4.0), precise).passed);
}

TEST(CompareDepths, belowTheFloorBothAreZero)
{
    Tolerance tolerance = relative(1e-6);
    EXPECT_FALSE(depth(1e-9, -1e-9, tolerance).passed);
    tolerance.floor = 1e-8;
    EXPECT_TRUE(depth(1e-9, -1e-9, tolerance).passed);
    EXPECT_TRUE(depth(0.0, 9e-9, tolerance).passed);
    EXPECT_FALSE(depth(0.0, 1e-8, tolerance).passed) << "the floor itself is no longer below it";
    EXPECT_FALSE(depth(1e-9, 1.0, tolerance).passed);
}

TEST(CompareDepths, zeroIsNoDepth)
{
    EXPECT_EQ(depth(0.0, 2.0, relative(0.1)).census.at("finite for zero"), 1U);
    EXPECT_EQ(depth(2.0, 0.0, relative(0.1)).census.at("zero for finite"), 1U);
    EXPECT_EQ(depth(0.0, 2.0, relative(0.1)).worst->error, kInf);
    EXPECT_TRUE(depth(0.0, -0.0, relative(0.0)).passed);
}

TEST(CompareNumbers, nonFiniteValuesMatchThemselvesAlone)
{
    struct {
        double expected, actual;
        const char* kind;
    } const cases[] = {
        {1.0, kNan, "NaN for finite"}, {kNan, 1.0, "finite for NaN"},   {kNan, kNan, nullptr},
        {1.0, kInf, "Inf for finite"}, {1.0, -kInf, "-Inf for finite"}, {kInf, 1.0, "finite for Inf"},
        {kInf, kInf, nullptr},         {-kInf, kInf, "Inf for -Inf"},   {kInf, kNan, "NaN for Inf"},
        {kNan, -kInf, "-Inf for NaN"}, {0.0, kNan, "NaN for finite"},
    };
    Tolerance everything = absolute(kInf);
    everything.relative = kInf;
    everything.ulps = kInf;
    everything.outlierShare = 1.0;
    everything.worst = kInf;
    everything.floor = kInf;
    for (const auto& test : cases) {
        for (const OutputType type : {OutputType::kDepth, OutputType::kScalar}) {
            const Comparison result = compare(type, row(1, {test.expected}), row(1, {test.actual}), {}, everything);
            EXPECT_EQ(result.passed, test.kind == nullptr) << test.expected << " " << test.actual;
            if (test.kind != nullptr) {
                EXPECT_EQ(result.census.count(test.kind), 1U) << result.reason;
            }
        }
    }
}

TEST(CompareNumbers, theExtremesOfTheRange)
{
    EXPECT_TRUE(scalar(DBL_TRUE_MIN, DBL_TRUE_MIN, relative(0.0)).passed);
    EXPECT_FALSE(scalar(DBL_TRUE_MIN, 2 * DBL_TRUE_MIN, relative(0.5)).passed);
    EXPECT_TRUE(scalar(DBL_TRUE_MIN, 2 * DBL_TRUE_MIN, relative(1.0)).passed);
    EXPECT_TRUE(scalar(0.0, DBL_TRUE_MIN, absolute(1e-300)).passed);
    // The difference overflows, its ratio does not.
    EXPECT_FALSE(scalar(1.7e308, -1.7e308, relative(1.5)).passed);
    EXPECT_TRUE(scalar(1.7e308, -1.7e308, relative(2.5)).passed);
    EXPECT_FALSE(scalar(1.7e308, -1.7e308, absolute(1e308)).passed);
    EXPECT_FALSE(scalar(1e300, 2e300, ulps(1e9)).passed) << "both overflow a float";
}

TEST(CompareColors, comparesEachChannel)
{
    const Plane expected = row(3, {0.1, 0.2, 0.3, 1.0, 1.0, 1.0});
    const Plane actual = row(3, {0.1, 0.25, 0.3, 1.0, 1.0, 1.2});
    const Comparison failed = compareColors(expected, actual, {}, absolute(0.1));
    EXPECT_EQ(failed.failed, 1U);
    EXPECT_EQ(failed.unit, "absolute");
    EXPECT_NEAR(failed.worst->error, 0.2, 1e-15);
    EXPECT_EQ(failed.worst->x, 1);
    EXPECT_EQ(failed.worst->expected, (std::vector<double>{1.0, 1.0, 1.0}));
    EXPECT_TRUE(compareColors(expected, actual, {}, absolute(0.21)).passed);
    EXPECT_TRUE(compareColors(expected, actual, {}, relative(0.2501)).passed);
    EXPECT_FALSE(compareColors(expected, actual, {}, relative(0.2499)).passed);
    // One channel within one bound and one within the other: each channel needs just one.
    Tolerance both = absolute(0.1);
    both.relative = 0.2;
    EXPECT_TRUE(compareColors(row(3, {0.001, 100, 0}), row(3, {0.002, 110, 0}), {}, both).passed);
    EXPECT_FALSE(compareColors(row(3, {0.001, 100, 0}), row(3, {0.002, 130, 0}), {}, both).passed);
    // A NaN in one channel is the pixel's kind, once.
    const Comparison spread = compareColors(row(3, {1, 1, 1}), row(3, {5, kNan, kNan}), {}, absolute(0.1));
    EXPECT_EQ(spread.census.at("NaN for finite"), 1U);
    EXPECT_EQ(sumOf(spread.census), 1U);
}

TEST(CompareScalars, takesAnyNumberOfChannels)
{
    EXPECT_TRUE(compareScalars(row(2, {1, 2}), row(2, {1, 2.01}), {}, absolute(0.02)).passed);
    EXPECT_FALSE(compareScalars(row(2, {1, 2}), row(2, {1.03, 2.01}), {}, absolute(0.02)).passed);
    EXPECT_TRUE(compareScalars(row(1, {1}), row(1, {1.01}), {}, absolute(0.02)).passed);
}

RC_GTEST_PROP(CompareNumbers, absoluteAndUlpsAreSymmetric, (double a, double b, double bound))
{
    const double limit = std::fabs(bound);
    RC_PRE(std::isfinite(limit));
    RC_ASSERT(scalar(a, b, absolute(limit)).passed == scalar(b, a, absolute(limit)).passed);
    RC_ASSERT(scalar(a, b, ulps(limit)).passed == scalar(b, a, ulps(limit)).passed);
}

RC_GTEST_PROP(CompareNumbers, aWiderToleranceNeverFailsWhatANarrowerPassed, (std::vector<double> values))
{
    std::vector<double> moved = values;
    for (double& value : moved)
        value += *rc::gen::inRange(-100, 101) * 1e-3;
    const double narrow = *rc::gen::inRange(0, 100) * 1e-3;
    const double wide = narrow + *rc::gen::inRange(0, 100) * 1e-3;
    const double floor = *rc::gen::inRange(0, 100) * 1e-3;
    for (auto make : {relative, absolute, ulps}) {
        Tolerance loose = make(wide);
        loose.floor = floor;
        const Comparison strict = compareDepths(row(1, values), row(1, moved), {}, make(narrow));
        const Comparison lenient = compareDepths(row(1, values), row(1, moved), {}, loose);
        RC_ASSERT(lenient.failed <= strict.failed);
        RC_ASSERT(lenient.passed || !strict.passed);
    }
}

TEST(CompareWithBound, passesNumbersUpToTheBoundAndNothingElse)
{
    const Plane bound = row(1, {10, 10, 10, 10, 10, 10});
    const Plane actual = row(1, {10, -1e30, 10.5, kNan, kInf, -kInf});
    const Comparison below = compareWithBound(bound, actual, {}, false);
    EXPECT_EQ(below.compared, 6u);
    EXPECT_EQ(below.failed, 4u);
    EXPECT_EQ(below.census.at("beyond tolerance"), 1u);
    EXPECT_EQ(below.census.at("NaN for finite"), 1u);
    EXPECT_EQ(below.census.at("Inf for finite"), 1u);
    EXPECT_EQ(below.census.at("-Inf for finite"), 1u);
    EXPECT_EQ(compareWithBound(bound, actual, {}, true).failed, 5u);
    EXPECT_TRUE(compareWithBound(bound, actual, {1, 1, 0, 0, 0, 0}, false).passed);
    EXPECT_FALSE(compareWithBound(bound, actual, {0, 0, 0, 0, 0, 0}, false).passed); // nothing compared proves nothing
}

TEST(CompareWithBound, looksAtEveryChannel)
{
    const Comparison comparison = compareWithBound(row(3, {1, 1, 1}), row(3, {0.5, 3, 2}), {}, false);
    EXPECT_FALSE(comparison.passed);
    EXPECT_DOUBLE_EQ(comparison.worst->error, 2.0);
}
