// What is excused where nothing can be decided: up to a share, never a pixel that can be decided, and never nonsense.
#include "tests/unit/judge/planes.h"

#include <gtest/gtest.h>

using namespace crossray;
using namespace crossray::test;

namespace {

Tolerance excusing(double share)
{
    Tolerance tolerance;
    tolerance.absolute = tolerance.degrees = 1e-3;
    tolerance.undecidableShare = share;
    return tolerance;
}

// Ten pixels, of which the first `count` are undecidable.
Mask undecidable(size_t count)
{
    Mask mask(10, 1);
    std::fill_n(mask.begin(), count, kUndecidablePixel);
    return mask;
}

Plane ramp(std::vector<double> changed)
{
    std::vector<double> values(10, 1.0);
    std::copy(changed.begin(), changed.end(), values.begin());
    return row(1, std::move(values));
}

} // namespace

TEST(Excuse, pixelsWithinTheShareAreNoFailures)
{
    const Comparison comparison = compareScalars(ramp({}), ramp({2, 3}), undecidable(3), excusing(0.2));
    EXPECT_TRUE(comparison.passed) << comparison.reason;
    EXPECT_EQ(comparison.compared, 10u);
    EXPECT_EQ(comparison.undecidable, 3u);
    EXPECT_EQ(comparison.excused, 2u);
    EXPECT_EQ(comparison.failed, 0u);
    EXPECT_EQ(sumOf(comparison.census), 0u);
    EXPECT_EQ(comparison.max, 0.0); // what is excused says nothing about the errors
}

TEST(Excuse, moreThanTheShareFailsAndSaysBoth)
{
    const Comparison comparison = compareScalars(ramp({}), ramp({2, 3}), undecidable(3), excusing(0.1));
    EXPECT_FALSE(comparison.passed);
    EXPECT_EQ(comparison.failed, 2u);
    EXPECT_EQ(comparison.excused, 0u);
    EXPECT_NE(comparison.reason.find("2 of 10 px (20.00 %)"), std::string::npos) << comparison.reason;
    EXPECT_NE(comparison.reason.find("2 of them (20.00 %) are undecidable, and the case excuses 10 %"),
              std::string::npos)
        << comparison.reason;
}

TEST(Excuse, aPixelThatCanBeDecidedFails)
{
    const Comparison comparison = compareScalars(ramp({}), ramp({2, 3}), undecidable(1), excusing(0.5));
    EXPECT_FALSE(comparison.passed);
    EXPECT_EQ(comparison.failed, 1u);
    EXPECT_EQ(comparison.excused, 1u);
    EXPECT_EQ(comparison.worst->x, 1);
    EXPECT_FALSE(compareScalars(ramp({}), ramp({2}), undecidable(0), excusing(0.5)).passed);
}

TEST(Excuse, withoutAShareNothingIs)
{
    EXPECT_FALSE(compareScalars(ramp({}), ramp({2}), undecidable(1), excusing(0)).passed);
}

TEST(Excuse, nonsenseIsNever)
{
    for (const double nonsense : {kNan, kInf, -kInf})
        EXPECT_FALSE(compareScalars(ramp({}), ramp({nonsense}), undecidable(1), excusing(0.5)).passed) << nonsense;
    EXPECT_TRUE(compareHitClasses(ramp({}), ramp({2}), undecidable(1), excusing(0.5)).passed);
    EXPECT_FALSE(compareHitClasses(ramp({}), ramp({7}), undecidable(1), excusing(0.5)).passed);
    EXPECT_TRUE(compareCounts(ramp({}), ramp({2}), undecidable(1), excusing(0.5)).passed);
    EXPECT_FALSE(compareCounts(ramp({}), ramp({2.5}), undecidable(1), excusing(0.5)).passed);
    const Plane expected = row(3, {0, 0, 1, 0, 0, 1});
    const Mask mask{kUndecidablePixel, 1};
    EXPECT_TRUE(compareDirections(expected, row(3, {0, 1, 0, 0, 0, 1}), mask, excusing(0.5)).passed);
    EXPECT_TRUE(compareDirections(expected, row(3, {0, 0, 0, 0, 0, 1}), mask, excusing(0.5)).passed);
    EXPECT_FALSE(compareDirections(expected, row(3, {0, 0.5, 0, 0, 0, 1}), mask, excusing(0.5)).passed);
}

TEST(Excuse, outliersAreCountedApart)
{
    Tolerance tolerance = excusing(0.1);
    tolerance.outlierShare = 0.1;
    tolerance.worst = 0.5;
    EXPECT_TRUE(compareScalars(ramp({}), ramp({9, 1.2}), undecidable(1), tolerance).passed);
    EXPECT_FALSE(compareScalars(ramp({}), ramp({9, 1.8}), undecidable(1), tolerance).passed);
}

TEST(Excuse, notAllThatIsCompared)
{
    Tolerance tolerance = excusing(1);
    const Comparison comparison = compareScalars(row(1, {1, 1}), row(1, {2, 2}), Mask(2, kUndecidablePixel), tolerance);
    EXPECT_FALSE(comparison.passed);
    EXPECT_NE(comparison.reason.find("all 2 pixels"), std::string::npos) << comparison.reason;
}
