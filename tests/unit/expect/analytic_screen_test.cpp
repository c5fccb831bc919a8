#include "tests/unit/expect/cases.h"

#include <rapidcheck/gtest.h>

using namespace crossray;
using namespace crossray::test;

namespace {

double atX(double x, double distance, ScreenWeightForm form)
{
    return screenWeightAt({x, 0.5}, distance, form);
}

} // namespace

TEST(ScreenWeight, theTextsRamp)
{
    // "For 0.1: 0 at x = 0, 1 at 0.1, 1 at 0.9, 0 at 1.0."
    const auto weight = [](double x) { return atX(x, 0.1, ScreenWeightForm::kLinear); };
    EXPECT_EQ(weight(0.0), 0.0);
    EXPECT_DOUBLE_EQ(weight(0.025), 0.25);
    EXPECT_DOUBLE_EQ(weight(0.05), 0.5);
    EXPECT_EQ(weight(0.1), 1.0);
    EXPECT_EQ(weight(0.5), 1.0);
    EXPECT_NEAR(weight(0.9), 1.0, 1e-15);
    EXPECT_NEAR(weight(0.975), 0.25, 1e-14);
    EXPECT_EQ(weight(1.0), 0.0);
}

TEST(ScreenWeight, theSmoothedRamps)
{
    // S(1/4) = 1/16 * (3 - 1/2) = 0.15625.
    EXPECT_DOUBLE_EQ(atX(0.025, 0.1, ScreenWeightForm::kSmooth2018), 0.15625);
    EXPECT_DOUBLE_EQ(atX(0.05, 0.1, ScreenWeightForm::kSmooth2018), 0.5);
    EXPECT_EQ(atX(0.1, 0.1, ScreenWeightForm::kSmooth2018), 1.0);
    // Today's is half as wide.
    EXPECT_DOUBLE_EQ(atX(0.0125, 0.1, ScreenWeightForm::kSmoothToday), 0.15625);
    EXPECT_DOUBLE_EQ(atX(0.025, 0.1, ScreenWeightForm::kSmoothToday), 0.5);
    EXPECT_EQ(atX(0.05, 0.1, ScreenWeightForm::kSmoothToday), 1.0);
}

TEST(ScreenWeight, isTheProductOfBothAxes)
{
    EXPECT_DOUBLE_EQ(screenWeightAt({0.05, 0.025}, 0.1, ScreenWeightForm::kLinear), 0.125);
    EXPECT_DOUBLE_EQ(screenWeightAt({0.5, 0.025}, 0.1, ScreenWeightForm::kLinear), 0.25);
}

TEST(ScreenWeight, distance0IsNoFade)
{
    for (const auto form : {ScreenWeightForm::kLinear, ScreenWeightForm::kSmooth2018, ScreenWeightForm::kSmoothToday}) {
        EXPECT_EQ(atX(0.0, 0.0, form), 1.0);
        EXPECT_EQ(atX(1.0, 0.0, form), 1.0);
        EXPECT_EQ(atX(1e-300, 0.0, form), 1.0);
        EXPECT_EQ(atX(-1e-300, 0.0, form), 0.0);
        EXPECT_EQ(atX(0.5, -1.0, form), 1.0);
        EXPECT_EQ(atX(kNan, 0.1, form), 0.0);
        EXPECT_EQ(atX(kInf, 0.0, form), 0.0);
    }
}

RC_GTEST_PROP(ScreenWeight, risesFromTheBorderAndIsSymmetric, ())
{
    const auto form = static_cast<ScreenWeightForm>(*rc::gen::inRange(0, 3));
    const double distance = *rc::gen::inRange(1, 1000) / 1000.0;
    const double x = *rc::gen::inRange(0, 501) / 1000.0;
    const double weight = atX(x, distance, form);
    RC_ASSERT(weight >= 0.0 && weight <= 1.0);
    RC_ASSERT(std::fabs(weight - atX(1.0 - x, distance, form)) < 1e-12);
    RC_ASSERT(atX(std::min(0.5, x + 0.001), distance, form) >= weight - 1e-15);
    RC_ASSERT(atX(x, distance + 0.001, form) <= weight + 1e-15);
}
