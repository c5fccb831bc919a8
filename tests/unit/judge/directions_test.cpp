#include "tests/unit/judge/planes.h"

#include "harness/base/error.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

using namespace crossray;
using namespace crossray::test;

namespace {

Tolerance degrees(double bound)
{
    Tolerance tolerance;
    tolerance.degrees = bound;
    return tolerance;
}

double angleBetween(const std::vector<double>& e, const std::vector<double>& a)
{
    return compareDirections(row(3, e), row(3, a), {}, degrees(180.0)).worst->error;
}

// By angles: a loop that waits for a good draw would never end while a failure is shrunk.
std::vector<double> anyDirection()
{
    const double azimuth = *rc::gen::inRange(0, 6284) / 1000.0;
    const double height = *rc::gen::inRange(-1000, 1001) / 1000.0;
    const double across = std::sqrt(1.0 - height * height);
    return {across * std::cos(azimuth), across * std::sin(azimuth), height};
}

} // namespace

TEST(CompareDirections, measuresTheAngle)
{
    EXPECT_DOUBLE_EQ(angleBetween({0, 0, 1}, {1, 0, 0}), 90.0);
    EXPECT_DOUBLE_EQ(angleBetween({0, 0, 1}, {0, 0, -1}), 180.0);
    EXPECT_EQ(angleBetween({0.6, 0, 0.8}, {0.6, 0, 0.8}), 0.0);
    for (const double angle : {1e-14, 1e-9, 1e-6, 1e-3, 0.3, 0.57, 0.58, 1.0, 45.0, 135.0, 179.9}) {
        EXPECT_NEAR(angleBetween({0, 0, 1}, tilted(angle)) / angle, 1.0, 1e-13) << angle;
    }
}

TEST(CompareDirections, tinyAnglesKeepTheirDigitsOffTheAxes)
{
    // Moved at right angles, by a power of two so that the test's own numbers are exact.
    const double step = 0x1p-40;
    const double s = std::sqrt(1.0 / 3.0);
    const double angle = angleBetween({s, s, s}, {s + step, s - step, s});
    EXPECT_NEAR(angle / (std::sqrt(2.0) * step * 57.29577951308232), 1.0, 1e-12);
}

TEST(CompareDirections, passesWithinAndFailsBeyond)
{
    const Plane expected = row(3, {0, 0, 1});
    const Plane actual = row(3, tilted(0.01));
    EXPECT_TRUE(compareDirections(expected, actual, {}, degrees(0.0101)).passed);
    const Comparison failed = compareDirections(expected, actual, {}, degrees(0.0099));
    EXPECT_FALSE(failed.passed);
    EXPECT_EQ(failed.unit, "degrees");
    EXPECT_EQ(failed.failed, 1U);
    EXPECT_EQ(failed.census.at("beyond tolerance"), 1U);
    EXPECT_NE(failed.reason.find("worst 0.01 degrees at (0, 0)"), std::string::npos) << failed.reason;
    EXPECT_EQ(failed.reason.find('\n'), std::string::npos);
}

TEST(CompareDirections, aVectorThatIsNoDirectionIsADifferenceOfItsOwnKind)
{
    const double inside = 1.0 + 0.99 * kUnitLengthBound;
    const double outside = 1.0 + 1.01 * kUnitLengthBound;
    struct {
        std::vector<double> expected, actual;
        const char* kind; // nullptr: passes
    } const cases[] = {
        {{0, 0, 1}, {0, 0, 0}, "zero vector for direction"},
        {{0, 0, 0}, {0, 0, 1}, "direction for zero vector"},
        {{0, 0, 0}, {0, 0, 0}, nullptr},
        {{0, 0, 0}, {-0.0, 0, 0}, nullptr},
        {{0, 0, 1}, {0, 0, 0.66}, "non-unit vector for direction"},
        {{0, 0, 0.66}, {0, 0, 0.66}, "non-unit vector for non-unit vector"},
        {{0, 0, 0.66}, {0, 0, 1}, "direction for non-unit vector"},
        {{0, 0, 0}, {0, 0, 1e-200}, "non-unit vector for zero vector"},
        {{0, 0, 1}, {0, 0, 1e200}, "non-unit vector for direction"},
        {{0, 0, 1}, {0, 0, inside}, nullptr},
        {{0, 0, 1}, {0, 0, outside}, "non-unit vector for direction"},
        {{0, 0, 1}, {0, kNan, 1}, "NaN for finite"},
        {{kNan, 0, 0}, {0, 0, 1}, "finite for NaN"},
        {{kNan, 0, 0}, {0, 0, 0}, "finite for NaN"},
        {{kNan, kNan, kNan}, {kNan, kNan, kNan}, nullptr},
        {{0, 0, 1}, {0, kInf, 1}, "Inf for finite"},
        {{0, kInf, 1}, {0, kInf, 1}, "Inf for Inf"},
        {{0, kInf, 1}, {0, kNan, 1}, "NaN for Inf"},
    };
    for (const auto& test : cases) {
        const Comparison comparison = compareDirections(row(3, test.expected), row(3, test.actual), {}, degrees(180.0));
        EXPECT_EQ(comparison.passed, test.kind == nullptr) << (test.kind == nullptr ? "passes" : test.kind);
        if (test.kind == nullptr) continue;
        EXPECT_EQ(comparison.census.count(test.kind), 1U) << test.kind << ", but: " << comparison.reason;
        EXPECT_EQ(comparison.worst->error, kInf);
    }
}

TEST(CompareDirections, needsItsOwnBound)
{
    Tolerance tolerance;
    tolerance.relative = 1.0;
    const Plane plane = row(3, {0, 0, 1});
    EXPECT_THROW(compareDirections(plane, plane, {}, tolerance), InputError);
    EXPECT_THROW(compareDirections(plane, plane, {}, degrees(-1.0)), InputError);
    EXPECT_THROW(compareDirections(plane, plane, {}, degrees(kNan)), InputError);
    EXPECT_THROW(compareDirections(row(1, {1, 2, 3}), row(1, {1, 2, 3}), {}, degrees(1.0)), InputError);
}

RC_GTEST_PROP(CompareDirections, isSymmetric, ())
{
    const std::vector<double> a = anyDirection();
    const std::vector<double> b = anyDirection();
    RC_ASSERT(std::fabs(angleBetween(a, b) - angleBetween(b, a)) < 1e-12);
}

RC_GTEST_PROP(CompareDirections, agreesWithTheHalfAngleForm, ())
{
    // A second derivation: 2 atan2(|a - b|, |a + b|) (Kahan).
    const std::vector<double> a = anyDirection();
    const std::vector<double> b = anyDirection();
    const double minus = std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
    const double plus = std::hypot(a[0] + b[0], a[1] + b[1], a[2] + b[2]);
    RC_ASSERT(std::fabs(angleBetween(a, b) - 2.0 * std::atan2(minus, plus) * 57.29577951308232) < 1e-11);
}
