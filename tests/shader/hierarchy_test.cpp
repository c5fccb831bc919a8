#include "tests/shader/generators.h"

#include "harness/backend/cpu/glsl.h"

#include "crossray/debug/debug_modes.glsl"
#include "crossray/hierarchy/screen_weight.glsl"
#include "crossray/hierarchy/weights.glsl"

#include "harness/backend/cpu/glsl_end.h"

using namespace CROSSRAY_SHADER_NAMESPACE;

namespace {
const int kForms[] = {kScreenWeightLinear, kScreenWeightSmooth2018, kScreenWeightSmoothToday};
}

TEST(ShaderScreenWeight, FollowsTheText)
{
    // For a distance of 0.1: 0 at the border, 1 at 0.1 and 0.9, 0 at 1; linear between.
    const std::vector<std::pair<Real, Real>> ramp{{0, 0},         {Real(0.05), Real(0.5)}, {Real(0.1), 1},
                                                  {Real(0.5), 1}, {Real(0.9), 1},          {Real(0.975), Real(0.25)},
                                                  {1, 0}};
    for (auto [x, w] : ramp) {
        EXPECT_NEAR(computeScreenWeight(vec2(x, Real(0.5)), Real(0.1), kScreenWeightLinear), w, 20 * kUlps) << x;
        EXPECT_NEAR(computeScreenWeight(vec2(x, x), Real(0.1), kScreenWeightLinear), w * w, 20 * kUlps) << x;
        EXPECT_NEAR(computeScreenWeight(vec2(Real(0.5), x), Real(0.1), kScreenWeightSmooth2018), w * w * (3 - 2 * w),
                    20 * kUlps);
        // Today's form is as wide as the linear one at half the distance.
        const Real half = computeScreenWeight(vec2(x, Real(0.5)), Real(0.05), kScreenWeightLinear);
        EXPECT_NEAR(computeScreenWeight(vec2(x, Real(0.5)), Real(0.1), kScreenWeightSmoothToday),
                    half * half * (3 - 2 * half), 40 * kUlps);
    }
}

TEST(ShaderScreenWeight, BordersAndNoDistance)
{
    for (int form : kForms) {
        for (Real distance : {Real(0), Real(-1), kNaN}) {
            EXPECT_EQ(computeScreenWeight(vec2(0, 1), distance, form), 1);
            EXPECT_EQ(computeScreenWeight(vec2(Real(-0.001), Real(0.5)), distance, form), 0);
        }
        EXPECT_EQ(computeScreenWeight(vec2(Real(0.5), Real(1.001)), Real(0.1), form), 0);
        EXPECT_EQ(computeScreenWeight(vec2(kNaN, Real(0.5)), Real(0.1), form), 0);
        EXPECT_EQ(computeScreenWeight(vec2(0, Real(0.5)), Real(1e-38), form), 0);
    }
}

RC_GTEST_PROP(ShaderScreenWeight, AnswersAnything, ())
{
    const Real w =
        computeScreenWeight(vec2(drawHostile(), drawHostile()), drawHostile(), kForms[*rc::gen::inRange(0, 3)]);
    RC_ASSERT(w >= 0 && w <= 1);
}

TEST(ShaderWeights, TakeWhatIsLeft)
{
    TierWeight first = addTier(0, Real(0.75));
    EXPECT_EQ(first.hierarchyWeight, Real(0.75));
    EXPECT_EQ(first.weight, Real(0.75));
    TierWeight second = addTier(first.hierarchyWeight, Real(0.5));
    EXPECT_EQ(second.hierarchyWeight, 1);
    EXPECT_EQ(second.weight, Real(0.25));
    EXPECT_EQ(addSky(second.hierarchyWeight).weight, 0);
    EXPECT_EQ(addSky(Real(0.25)).weight, Real(0.75));
    EXPECT_EQ(addTier(kNaN, kNaN).weight, 0);
    EXPECT_EQ(addTier(0, kInfinity).weight, 1);
}

RC_GTEST_PROP(ShaderWeights, SumToOneWithTheSky, ())
{
    Real hierarchy = 0;
    Real sum = 0;
    const int tiers = *rc::gen::inRange(0, 6);
    for (int i = 0; i < tiers; ++i) {
        const TierWeight tier = addTier(hierarchy, drawHostile());
        RC_ASSERT(tier.weight >= 0 && tier.hierarchyWeight >= hierarchy && tier.hierarchyWeight <= 1);
        hierarchy = tier.hierarchyWeight;
        sum += tier.weight;
    }
    RC_ASSERT(std::fabs(sum + addSky(hierarchy).weight - 1) < kUlps);
}

TEST(ShaderDebug, EncodesAsDocumented)
{
    EXPECT_TRUE(encodeDirection(vec3(1, 0, -1)) == vec3(1, Real(0.5), 0));
    EXPECT_NEAR(encodeLinearDepth(Real(12.5)).y, Real(0.25), 20 * kUlps);
    EXPECT_TRUE(encodeHitClass(kHitClassHit) == vec3(Real(0.5), 1, Real(0.5)));
    EXPECT_TRUE(encodeHitClass(kHitClassMiss) == vec3(Real(0.5), Real(0.5), 1));
    EXPECT_TRUE(encodeHitClass(kHitClassUnknown) == vec3(Real(0.5), Real(0.5), 1));
    EXPECT_TRUE(encodeHitClass(kHitClassNoRaycast) == vec3(0));
    EXPECT_TRUE(encodePositionNDC(vec3(Real(0.25), Real(0.75), Real(0.5))) == vec3(Real(0.25), Real(0.75), 0));
    EXPECT_NEAR(encodeRayDirNDC(vec3(1, -1, Real(0.08))).z, Real(0.25), 20 * kUlps);
    EXPECT_TRUE(encodeRayDirNDC(vec3(0)) == vec3(Real(0.5), Real(0.5), 0));
    EXPECT_EQ(encodeCount(8, 32).x, Real(0.25));
    EXPECT_EQ(encodeCount(8, 0).x, 0);
    EXPECT_TRUE(encodeDirection(vec3(kNaN, 0, 0)) == kDebugNotANumber);
    for (int i = 0; i < 8; ++i) {
        for (int j = 0; j < i; ++j)
            EXPECT_FALSE(encodeIndex(i) == encodeIndex(j));
    }
}

RC_GTEST_PROP(ShaderDebug, ColoursAreColours, ())
{
    const vec3 v = drawHostileVector<vec3>();
    for (vec3 color :
         {encodeDirection(v), encodeLinearDepth(v.x), encodePositionNDC(v), encodeRayDirNDC(v),
          encodeIndex(static_cast<int>(*rc::gen::inRange(-9, 99))), encodeCount(*rc::gen::inRange(-9, 99), 7)}) {
        for (int c = 0; c < 3; ++c)
            RC_ASSERT(color[c] >= 0 && color[c] <= 1);
    }
}
