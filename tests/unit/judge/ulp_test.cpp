#include "tests/unit/judge/planes.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cfloat>

using namespace crossray;
using namespace crossray::test;

TEST(UlpDistance, countsRepresentableFloats)
{
    EXPECT_EQ(ulpDistance(1.0, 1.0, false), 0.0);
    EXPECT_EQ(ulpDistance(1.0, std::nextafterf(1.0F, 2.0F), false), 1.0);
    EXPECT_EQ(ulpDistance(1.0, std::nextafterf(1.0F, 0.0F), false), 1.0);
    EXPECT_EQ(ulpDistance(1.0, 2.0, false), 8388608.0); // 2^23 floats in a binade
    EXPECT_EQ(ulpDistance(1.0, 2.0, true), 4503599627370496.0);
    EXPECT_EQ(ulpDistance(1.0, std::nextafter(1.0, 2.0), true), 1.0);
}

TEST(UlpDistance, zerosAreOneValueAndDenormalsCount)
{
    EXPECT_EQ(ulpDistance(-0.0, 0.0, false), 0.0);
    EXPECT_EQ(ulpDistance(-0.0, 0.0, true), 0.0);
    const double smallest = std::numeric_limits<float>::denorm_min();
    EXPECT_EQ(ulpDistance(0.0, smallest, false), 1.0);
    EXPECT_EQ(ulpDistance(-0.0, smallest, false), 1.0);
    EXPECT_EQ(ulpDistance(-smallest, smallest, false), 2.0);
    EXPECT_EQ(ulpDistance(-DBL_TRUE_MIN, DBL_TRUE_MIN, true), 2.0);
    EXPECT_EQ(ulpDistance(FLT_MIN, FLT_MIN - smallest, false), 1.0); // across the border of the denormals
}

TEST(UlpDistance, aFloatIsTheNearestOfTheDouble)
{
    // A tenth as a double and as a float are the same float.
    EXPECT_EQ(ulpDistance(0.1, static_cast<double>(0.1F), false), 0.0);
    EXPECT_GT(ulpDistance(0.1, static_cast<double>(0.1F), true), 1e6);
}

TEST(UlpDistance, theExtremes)
{
    EXPECT_EQ(ulpDistance(kNan, 1.0, false), kInf);
    EXPECT_EQ(ulpDistance(1.0, kNan, true), kInf);
    EXPECT_EQ(ulpDistance(kNan, kNan, true), kInf);
    EXPECT_EQ(ulpDistance(kInf, kInf, false), 0.0);
    EXPECT_EQ(ulpDistance(FLT_MAX, kInf, false), 1.0);
    EXPECT_EQ(ulpDistance(DBL_MAX, kInf, true), 1.0);
    EXPECT_EQ(ulpDistance(-kInf, kInf, true), 2.0 * 9218868437227405312.0); // 2 * 0x7FF0...
    // Both overflow a float and are still not the same.
    EXPECT_EQ(ulpDistance(1e300, 2e300, false), kInf);
    EXPECT_EQ(ulpDistance(1e300, kInf, false), kInf);
    EXPECT_EQ(ulpDistance(kInf, 1e300, false), kInf);
    EXPECT_GT(ulpDistance(1e300, 2e300, true), 1e15);
}

RC_GTEST_PROP(UlpDistance, isAMetric, (double a, double b, double c, bool precise))
{
    const double ab = ulpDistance(a, b, precise);
    RC_ASSERT(ab == ulpDistance(b, a, precise));
    RC_ASSERT(ab >= 0.0);
    RC_ASSERT(ulpDistance(a, a, precise) == 0.0);
    // Rounding to a double costs one part in 2^53.
    RC_ASSERT(ulpDistance(a, c, precise) <= (ab + ulpDistance(b, c, precise)) * (1.0 + 1e-15));
}

RC_GTEST_PROP(UlpDistance, stepsAreCounted, (float start))
{
    const int steps = *rc::gen::inRange(0, 50);
    float value = start;
    for (int i = 0; i < steps; ++i)
        value = std::nextafterf(value, std::numeric_limits<float>::infinity());
    RC_PRE(std::isfinite(value));
    RC_ASSERT(ulpDistance(start, value, false) == steps);
}
