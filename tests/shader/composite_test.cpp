#include "tests/shader/generators.h"

#include "harness/backend/cpu/glsl.h"

#include "crossray/refract/absorption.glsl"
#include "crossray/refract/fresnel.glsl"

#include "harness/backend/cpu/glsl_end.h"

using namespace CROSSRAY_SHADER_NAMESPACE;

TEST(ShaderFresnel, KnownNumbers)
{
    // Glass from the front: ((1.5 - 1) / (1.5 + 1))^2. At Brewster's angle, tan = n, one polarisation is not reflected:
    // half of
    // ((n^2 - 1) / (n^2 + 1))^2 is left.
    EXPECT_NEAR(computeFresnelExact(1, Real(1.5)), Real(0.04), kUlps);
    EXPECT_NEAR(computeFresnelSchlick(1, Real(1.5)), Real(0.04), kUlps);
    const Real brewster = std::cos(std::atan(Real(1.5)));
    EXPECT_NEAR(computeFresnelExact(brewster, Real(1.5)), Real(0.5) * std::pow(Real(1.25) / Real(3.25), Real(2)),
                kUlps);
    // Nothing where the index is the air's, all at the horizon of glass, all beyond the critical angle.
    EXPECT_EQ(computeFresnelExact(Real(0.3), 1), 0);
    EXPECT_GT(computeFresnelExact(0, Real(1.5)), Real(0.999));
    EXPECT_EQ(computeFresnelExact(Real(0.5), Real(0.7)), 1);
    EXPECT_EQ(computeFresnelSchlick(Real(0.5), Real(0.7)), 1);
    // Light that enters from the dense side at one angle reflects as much as the light that leaves at the other does.
    const Real inside = std::sqrt(1 - Real(0.75) / Real(2.25));
    EXPECT_NEAR(computeFresnelExact(Real(0.5), Real(1.5)), computeFresnelExact(inside, 1 / Real(1.5)), kUlps);
    EXPECT_NEAR(computeFresnelSchlick(Real(0.5), Real(1.5)), computeFresnelSchlick(inside, 1 / Real(1.5)), kUlps);
}

TEST(ShaderFresnel, DegenerateInputIsAnswered)
{
    for (Real index : {Real(0), Real(-1), kNaN, kInfinity}) {
        EXPECT_EQ(computeFresnelExact(Real(0.5), index), 1);
        EXPECT_EQ(computeFresnelSchlick(Real(0.5), index), 1);
    }
    EXPECT_EQ(computeFresnelExact(kNaN, Real(1.5)), computeFresnelExact(0, Real(1.5)));
    EXPECT_EQ(computeFresnelExact(2, Real(1.5)), computeFresnelExact(1, Real(1.5)));
    EXPECT_EQ(computeFresnel(kFresnelNone, Real(0.1), Real(1.5)), 0);
    EXPECT_EQ(computeFresnel(99, Real(0.1), Real(1.5)), 0);
    EXPECT_EQ(computeFresnel(kFresnelExact, Real(0.1), Real(1.5)), computeFresnelExact(Real(0.1), Real(1.5)));
    EXPECT_EQ(computeFresnel(kFresnelSchlick, Real(0.1), Real(1.5)), computeFresnelSchlick(Real(0.1), Real(1.5)));
}

RC_GTEST_PROP(ShaderFresnel, StaysInItsRangeAndRisesTowardsTheHorizon, ())
{
    const Real cosine = drawHostile(), index = drawHostile();
    for (Real share : {computeFresnelExact(cosine, index), computeFresnelSchlick(cosine, index)})
        RC_ASSERT(share >= 0 && share <= 1);
    const Real n = drawReal(Real(1.01), 3), steep = drawReal(0, 1), flat = steep * drawReal(0, 1);
    RC_ASSERT(computeFresnelSchlick(flat, n) >= computeFresnelSchlick(steep, n) - kUlps);
    // Schlick stays within 0.07 of the exact share for indices of glass.
    const Real glass = drawReal(Real(1.3), Real(1.8));
    RC_ASSERT(std::fabs(computeFresnelSchlick(steep, glass) - computeFresnelExact(steep, glass)) < Real(0.07));
}

// What is let through is never more than there was.
RC_GTEST_PROP(ShaderComposite, LosesEnergyOnly, ())
{
    const vec3 left = computeTransmittance(drawHostileVector<vec3>(), drawHostile(), drawHostile());
    const Real through = 1 - computeFresnelExact(drawHostile(), drawHostile());
    for (int channel = 0; channel < 3; ++channel)
        RC_ASSERT(left[channel] * through >= 0 && left[channel] * through <= 1);
}

TEST(ShaderAbsorption, EachChannelByItself)
{
    // Brown glass: after half the distance the root of the colour.
    const vec3 half = computeTransmittance(vec3(Real(0.64), Real(0.25), 0), 3, Real(1.5));
    EXPECT_NEAR(half.x, Real(0.8), kUlps);
    EXPECT_NEAR(half.y, Real(0.5), kUlps);
    EXPECT_NEAR(half.z, Real(0.01), kUlps); // 0 counts as 1e-4
    // Distance 0 and below: as 1e-5 m, where any way at all takes everything.
    for (Real distance : {Real(0), Real(-1), kNaN}) {
        const vec3 none = computeTransmittance(vec3(Real(0.9)), distance, 1);
        EXPECT_LT(none.x, Real(1e-30));
        EXPECT_GE(none.x, 0);
    }
}
