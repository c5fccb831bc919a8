#include "tests/shader/shader_test.h"

#include "harness/base/outputs.h"

#include "harness/backend/cpu/glsl.h"

#include "crossray/core/math.glsl"
#include "crossray/shared/outputs.glsl"

#include "harness/backend/cpu/glsl_end.h"

using namespace CROSSRAY_SHADER_NAMESPACE;

TEST(ShaderMath, NormalizesWhereSquaresLeaveTheRange)
{
    for (Real length : {Real(1e-25), Real(1e-3), Real(1), Real(1e25)}) {
        vec3 v = safeNormalize(vec3(3, -4, 12) * (length / Real(13)), vec3(0));
        EXPECT_NEAR(v.x, Real(3) / 13, kUlps);
        EXPECT_NEAR(v.y, Real(-4) / 13, kUlps);
        EXPECT_NEAR(v.z, Real(12) / 13, kUlps);
    }
}

TEST(ShaderMath, GivesTheFallbackForVectorsWithoutDirection)
{
    const vec3 fallback(0, 1, 0);
    for (vec3 v : {vec3(0), vec3(kNaN, 1, 0), vec3(1, kNaN, 0), vec3(0, 1, kNaN), vec3(kInfinity, 0, 0),
                   vec3(0, -kInfinity, 0), vec3(Real(1e-31), 0, 0)}) {
        EXPECT_TRUE(safeNormalize(v, fallback) == fallback);
        EXPECT_FALSE(hasDirection(v));
    }
    EXPECT_TRUE(hasDirection(vec3(0, Real(1e-20), 0)));
}

TEST(ShaderMath, SaturateAndDivideAnswerEverything)
{
    EXPECT_EQ(saturate(kNaN), 0);
    EXPECT_EQ(saturate(-kInfinity), 0);
    EXPECT_EQ(saturate(kInfinity), 1);
    EXPECT_EQ(saturate(Real(0.25)), Real(0.25));
    EXPECT_EQ(safeDivide(1, 0, 7), 7);
    EXPECT_EQ(safeDivide(0, 0, 7), 7);
    EXPECT_EQ(safeDivide(1, kNaN, 7), 7);
    EXPECT_EQ(safeDivide(kInfinity, 2, 7), 7);
    EXPECT_EQ(safeDivide(1, -4, 7), Real(-0.25));
    EXPECT_EQ(awayFromZero(Real(-0.0), 1), 1);
    EXPECT_EQ(awayFromZero(Real(-0.5), 1), -1);
    EXPECT_EQ(awayFromZero(Real(-2), 1), -2);
    EXPECT_EQ(smoothRamp(Real(0.5)), Real(0.5));
    EXPECT_EQ(smoothRamp(Real(0.25)), Real(0.15625));
    EXPECT_FALSE(isFinite(kNaN));
    EXPECT_FALSE(isFinite(vec3(0, kInfinity, 0)));
}

TEST(ShaderShim, FollowsGlslsDefinitions)
{
    // min(x, y) is y < x ? y : x, and so on: a NaN takes the branch that the formula takes.
    EXPECT_EQ(min(Real(1), kNaN), 1);
    EXPECT_TRUE(isnan(min(kNaN, Real(1))));
    EXPECT_EQ(max(Real(1), kNaN), 1);
    EXPECT_TRUE(isnan(max(kNaN, Real(1))));
    EXPECT_EQ(step(Real(0), kNaN), 1);
    EXPECT_EQ(step(kNaN, Real(0)), 1);
    EXPECT_EQ(fract(Real(-0.25)), Real(0.75));
    EXPECT_EQ(mod(Real(-1), Real(4)), 3);
    EXPECT_TRUE(refract(vec3(Real(0.8), Real(-0.6), 0), vec3(0, 1, 0), 2) == vec3(0));
}

TEST(ShaderShim, SwizzlesReadTheirComponents)
{
    vec4 v(1, 2, 3, 4);
    EXPECT_TRUE(v.wzy == vec3(4, 3, 2));
    EXPECT_TRUE(v.xx + v.zw == vec2(4, 5));
    EXPECT_TRUE(-v.rgb * 2.0 == vec3(-2, -4, -6));
    EXPECT_TRUE(v.wzyx == vec4(4, 3, 2, 1));
    EXPECT_EQ(dot(v.xyz, v.zzz), 18);
    vec4 w = v;
    v.y = 9;
    EXPECT_TRUE(w.xyz == vec3(1, 2, 3));
    EXPECT_TRUE(v.yx == vec2(9, 1));
    static_assert(std::is_trivially_copyable_v<vec3> && sizeof(vec3) == 3 * sizeof(Real));
    static_assert(std::is_trivially_copyable_v<mat4> && sizeof(mat4) == 16 * sizeof(Real));
}

TEST(ShaderShim, MatricesAreColumns)
{
    mat3 m(1, 2, 3, 4, 5, 6, 7, 8, 10);
    EXPECT_TRUE(m * vec3(1, 0, 0) == vec3(1, 2, 3));
    EXPECT_TRUE(vec3(1, 0, 0) * m == vec3(1, 4, 7));
    EXPECT_TRUE(transpose(m)[0] == vec3(1, 4, 7));
    EXPECT_NEAR(determinant(m), -3, 50 * kUlps);
    mat3 one = m * inverse(m);
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row)
            EXPECT_NEAR(one[column][row], column == row, 20 * kUlps);
    }
}

TEST(ShaderOutputs, AgreeWithTheHarness)
{
    const std::vector<std::pair<int, std::string_view>> ids{
        {kOutputColor, "Color"},
        {kOutputRayDirWS, "RayDirWS"},
        {kOutputHitDepth, "HitDepth"},
        {kOutputHitSuccess, "HitSuccess"},
        {kOutputHitReason, "HitReason"},
        {kOutputTracingModel, "TracingModel"},
        {kOutputPositionNDC, "PositionNDC"},
        {kOutputRayDirNDC, "RayDirNDC"},
        {kOutputIterationCount, "IterationCount"},
        {kOutputMaxUsedMipLevel, "MaxUsedMipLevel"},
        {kOutputIntersectionKind, "IntersectionKind"},
        {kOutputHitWeight, "HitWeight"},
        {kOutputSampledColor, "SampledColor"},
        {kOutputHitPositionSS, "HitPositionSS"},
        {kOutputPathLength, "PathLength"},
        {kOutputRayOriginWS, "RayOriginWS"},
        {kOutputTierWeights, "TierWeights"},
        {kOutputProbeWeights, "ProbeWeights"},
        {kOutputProbeDirWS, "ProbeDirWS"},
        {kOutputProbeMipLevel, "ProbeMipLevel"},
        {kOutputConfidence, "Confidence"},
        {kOutputPlanarUV, "PlanarUV"},
        {kOutputPlanarStatus, "PlanarStatus"},
        {kOutputTransmittance, "Transmittance"},
        {kOutputColorMipLevel, "ColorMipLevel"},
        {kOutputHistoryUV, "HistoryUV"},
        {kOutputFetchCount, "FetchCount"},
    };
    EXPECT_EQ(static_cast<size_t>(kOutputCount), ids.size());
    ASSERT_EQ(crossray::allOutputs().size(), ids.size());
    for (auto [id, name] : ids) {
        auto info = crossray::findOutput(name);
        ASSERT_TRUE(info) << name;
        EXPECT_EQ(info->id, id) << name;
    }
    EXPECT_EQ(kHitClassNoRaycast, static_cast<int>(crossray::HitClass::kNoRaycast));
    EXPECT_EQ(kHitClassHit, static_cast<int>(crossray::HitClass::kHit));
    EXPECT_EQ(kHitClassMiss, static_cast<int>(crossray::HitClass::kMiss));
    EXPECT_EQ(kHitClassUnknown, static_cast<int>(crossray::HitClass::kUnknown));
}
