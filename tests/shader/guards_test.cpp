// The input that each operation of the library has no answer to, and what is answered in its place. guards.toml says
// which operation each test speaks of.
#include "tests/shader/shader_test.h"

#include "harness/backend/cpu/glsl.h"

#include "crossray/core/ray_ndc.glsl"
#include "crossray/hierarchy/screen_weight.glsl"
#include "crossray/probe/cubemap.glsl"
#include "crossray/probe/hdrp_order.glsl"
#include "crossray/probe/influence.glsl"
#include "crossray/probe/parallax.glsl"
#include "crossray/probe/planar.glsl"
#include "crossray/probe/roughness.glsl"
#include "crossray/probe/urp.glsl"
#include "crossray/project/linear.glsl"
#include "crossray/project/patch_tracer.glsl"
#include "crossray/project/reprojection.glsl"
#include "crossray/refract/absorption.glsl"
#include "crossray/refract/fresnel.glsl"
#include "tests/shader/views.h"

float fetchLinearDepth(ivec2)
{
    return 1;
}
void recordLinearStep(LinearStep) {}
vec4 fetchSurfaceCell(ivec2, int)
{
    return vec4(0, 0, 0, -1);
}
ivec2 surfacePyramidSize(int)
{
    return ivec2(1);
}
int surfacePyramidLevelCount()
{
    return 1;
}
void recordPatchStep(PatchStep) {}

#include "harness/backend/cpu/glsl_end.h"

using namespace CROSSRAY_SHADER_NAMESPACE;

namespace {

const Real kTiny = std::numeric_limits<Real>::denorm_min();
const Real kSmall = std::numeric_limits<Real>::min(); // its square is 0
const Real kHuge = std::numeric_limits<Real>::max();

View plainView()
{
    return makeView(vec2(64, 32), Real(0.5), Real(0.1), 100, 1);
}

// A camera that the format refuses and an engine may hand over for a frame.
View viewWithoutField()
{
    View view = plainView();
    view.slope = vec2(0, 0);
    return view;
}

bool isNumber(Real x)
{
    return std::isfinite(x);
}

bool isNumber(vec2 v)
{
    return isNumber(v.x) && isNumber(v.y);
}

bool isNumber(vec3 v)
{
    return isNumber(vec2(v.x, v.y)) && isNumber(v.z);
}

} // namespace

TEST(ShaderGuards, RayDirNDCWithoutFieldOfView)
{
    for (const bool orthographic : {false, true}) {
        View view = viewWithoutField();
        view.orthographic = orthographic;
        const vec3 dir = computeRayDirNDC(view, vec3(0, 0, -1), vec3(1, 1, 0));
        EXPECT_TRUE(dir == vec3(0)) << dir.x << ' ' << dir.y << ' ' << dir.z;
    }
}

TEST(ShaderGuards, RayDirNDCAtTheEye)
{
    const View view = plainView();
    for (const Real depth : {Real(0), Real(-1), kNaN})
        EXPECT_TRUE(computeRayDirNDC(view, vec3(0, 0, -depth), vec3(1, 0, 0)) == vec3(0));
    // In front of it by nothing that a square is left of.
    for (const Real depth : {kTiny, kSmall, Real(1e-30), Real(1e-20)}) {
        EXPECT_TRUE(isNumber(computeRayDirNDC(view, vec3(0, 0, -depth), vec3(1, 0, -1)))) << depth;
        EXPECT_TRUE(isNumber(computeRayDirNDC(view, vec3(depth, 0, -depth), vec3(0, 0, -1)))) << depth;
    }
}

TEST(ShaderGuards, RayDirNDCOfARayWithoutLengthOnScreen)
{
    EXPECT_TRUE(computeRayDirNDC(plainView(), vec3(0, 0, -2), vec3(0, 0, 1)) == vec3(0));
    EXPECT_TRUE(computeRayDirNDC(plainView(), vec3(0, 0, -2), vec3(0)) == vec3(0));
    EXPECT_TRUE(computeRayDirNDC(plainView(), vec3(0, 0, -2), vec3(kNaN)) == vec3(0));
    EXPECT_TRUE(isNumber(computeRayDirNDC(plainView(), vec3(0, 0, -2), vec3(Real(1e30), 0, 0))));
}

TEST(ShaderGuards, DeviceDepthOfNothing)
{
    const View view = plainView();
    const Real atNear = deviceDepthFromLinear(view, view.nearDistance);
    EXPECT_NEAR(atNear, 1, kUlps);
    for (const Real depth : {Real(0), Real(-1), kNaN})
        EXPECT_EQ(deviceDepthFromLinear(view, depth), atNear);
    EXPECT_TRUE(isNumber(deviceDepthFromLinear(view, kTiny)));
    View flat = view;
    flat.nearDistance = 0;
    EXPECT_TRUE(isNumber(deviceDepthFromLinear(flat, 0)));
}

TEST(ShaderGuards, WithoutAFieldOfViewNothingIsInFront)
{
    for (const bool orthographic : {false, true}) {
        View view = viewWithoutField();
        view.orthographic = orthographic;
        for (const vec3 position : {vec3(0, 0, -1), vec3(1, 2, -3)}) {
            const ScreenPosition place = projectVSToSS(view, position);
            EXPECT_FALSE(place.inFront);
            EXPECT_TRUE(place.positionSS == vec2(0));
        }
        EXPECT_EQ(makeScreenRay(view, vec3(0, 0, -1), vec3(1, 0, -1)).status, kHitReasonDegenerateRay);
    }
}

TEST(ShaderGuards, ProjectionOnTheEyesPlane)
{
    const View view = plainView();
    for (const Real depth : {Real(0), Real(-1), kNaN, kTiny}) {
        const ScreenPosition place = projectVSToSS(view, vec3(1, 1, -depth));
        EXPECT_FALSE(place.inFront) << depth;
        EXPECT_TRUE(place.positionSS == vec2(0)) << depth;
    }
}

TEST(ShaderGuards, ACubesFaceWithoutDirection)
{
    for (const vec3 dir : {vec3(0), vec3(kNaN), vec3(kInfinity, 0, 0)}) {
        const CubePosition place = cubePositionFromDirection(dir);
        EXPECT_FALSE(place.valid);
        EXPECT_EQ(place.face, 0);
        EXPECT_TRUE(place.uv == vec2(Real(0.5)));
    }
}

TEST(ShaderGuards, VolumesWithoutAnEndHaveTheLargestKey)
{
    for (const vec3 extents : {vec3(kNaN), vec3(kInfinity), vec3(kHuge), vec3(Real(1e20))})
        EXPECT_EQ(computeHdrpProbeKey(extents), kLargestProbeKey);
    EXPECT_EQ(computeHdrpProbeKey(vec3(0)), 0);
    EXPECT_EQ(computeHdrpProbeKey(vec3(-1)), 0);
}

TEST(ShaderGuards, ACaptureOnWhatIsSeen)
{
    const ProbeProxy proxy(kProbeShapeInfinite, vec3(0), mat3(1), vec3(1), 0);
    const ParallaxRay seen = computeParallax(vec3(0), vec3(0, 0, 1), proxy, vec3(0, 0, kFarAway));
    EXPECT_TRUE(seen.dirWS == vec3(0, 0, 1));
    EXPECT_EQ(seen.distanceFromCapture, 0);
}

TEST(ShaderGuards, AnObliqueProjectionWithoutFarPlane)
{
    const MirrorPlane plane(vec3(0, 0, -2), vec3(0, 0, -1));
    for (const bool orthographic : {false, true}) {
        for (const Real far : {Real(0), kTiny, kFarAway, kHuge}) {
            View view = plainView();
            view.orthographic = orthographic;
            view.farDistance = far;
            const ObliqueProjection oblique = makeObliqueProjection(view, plane);
            for (int column = 0; column < 4; ++column) {
                const vec4 values = oblique.clipFromView[column];
                EXPECT_TRUE(isNumber(values.x) && isNumber(values.y) && isNumber(values.z) && isNumber(values.w))
                    << far << ' ' << orthographic;
            }
        }
    }
}

TEST(ShaderGuards, APlanarLookUpOnTheCapturesEye)
{
    View view = plainView();
    view.reversedDepth = false;
    const mat4 clip(vec4(1, 0, 0, 0), vec4(0, 1, 0, 0), vec4(0, 0, 0, -1), vec4(0));
    for (const Real depth : {Real(0), kTiny, -kTiny}) {
        const PlanarLookup found = lookUpPlanar(view, clip, vec3(1, 1, -depth), vec3(0, 0, -1));
        EXPECT_EQ(found.weight, 0);
        EXPECT_NE(found.status, kPlanarOk);
        EXPECT_TRUE(found.positionUV == vec2(0));
    }
}

TEST(ShaderGuards, ARayThatPassesASphere)
{
    const ProxyHit past = projectProxySphere(vec3(-3, 2, 0), vec3(1, 0, 0), vec3(0), 1);
    EXPECT_FALSE(past.hit);
    EXPECT_EQ(past.reason, kHitReasonNoProxyHit);
    EXPECT_TRUE(past.positionWS == vec3(-3, 2, 0));
    EXPECT_FALSE(projectProxySphere(vec3(1, 0, 0), vec3(0, 1, 0), vec3(0), 0).hit);
}

TEST(ShaderGuards, RoughnessBeyondItsEnds)
{
    for (const Real roughness : {Real(0), Real(-1), kNaN}) {
        EXPECT_EQ(computeReflectionMip(roughness, 7), 0);
        EXPECT_EQ(computeRefractionMip(roughness, 7), 0);
        EXPECT_NEAR(computeBuiltInMipExact(roughness), 0.158, 1e-3);
    }
    for (const Real roughness : {Real(1), Real(2), kInfinity}) {
        EXPECT_EQ(computeReflectionMip(roughness, 7), 6);
        EXPECT_NEAR(computeBuiltInMipExact(roughness), 6, 6 * kUlps);
        // All the way to the normal.
        EXPECT_TRUE(computeDominantDirection(vec3(0, 1, 0), vec3(1, 0, 0), vec3(0, 1, 0), roughness,
                                             kDominantSquared) == vec3(0, 1, 0));
    }
}

TEST(ShaderGuards, SharesOfProbesThatWeighNothing)
{
    for (const int profile : {kUrpDoc, kUrpUnity}) {
        for (const Real weight : {Real(0), Real(-1), kNaN}) {
            const UrpWeights shares = computeUrpShares(weight, weight, 0, profile);
            EXPECT_EQ(shares.first, 0);
            EXPECT_EQ(shares.second, 0);
            EXPECT_EQ(shares.sky, 1);
        }
    }
}

TEST(ShaderGuards, AMarchOfARayThatIsAPoint)
{
    const View view = plainView();
    for (const vec3 dir : {vec3(0), vec3(kNaN)}) {
        const ScreenRay ray = makeScreenRay(view, vec3(0, 0, -1), dir);
        EXPECT_EQ(ray.status, kHitReasonDegenerateRay);
        EXPECT_TRUE(isNumber(ray.pixelLength));
        EXPECT_TRUE(isNumber(computeLinearEnd(view, ray)));
        EXPECT_TRUE(isNumber(computeLinearStride(LinearSettings(0, 0, 1, 0, 0), ray, 1)));
    }
    // Straight away from the eye: no component of its way on screen is 0, and its border is never reached.
    const ScreenRay away = makeScreenRay(view, vec3(0, 0, -1), vec3(0, 0, -1));
    EXPECT_EQ(away.status, kHitReasonNone);
    EXPECT_NE(away.deltaSS.x, 0);
    EXPECT_NE(away.deltaSS.y, 0);
    EXPECT_EQ(computeLinearEnd(view, away), 1);
    EXPECT_EQ(borderTime(3, 0, 4), kNever);
}

TEST(ShaderGuards, AScreenRayFromWhereDepthsVanish)
{
    View view = plainView();
    view.nearDistance = kTiny;
    for (const Real depth : {kTiny, kSmall, Real(1e-30), Real(1e-20)}) {
        for (const vec3 dir : {vec3(0, 0, 1), vec3(1, 0, Real(0.5)), vec3(1, 0, -1)}) {
            const ScreenRay ray = makeScreenRay(view, vec3(0, 0, -depth), dir);
            EXPECT_TRUE(isNumber(ray.startSS) && isNumber(ray.deltaSS) && isNumber(ray.pixelLength)) << depth;
            EXPECT_TRUE(isNumber(ray.startAffineDepth) && isNumber(ray.deltaAffineDepth)) << depth;
        }
    }
}

TEST(ShaderGuards, AffineDepthOfZeroAndBelow)
{
    for (const Real depth : {Real(0), Real(-1), kTiny}) {
        EXPECT_TRUE(isNumber(affineDepthFromLinear(false, depth)));
        EXPECT_NEAR(linearDepthFromAffine(false, depth) / Real(1e30), 1, kUlps);
    }
    EXPECT_EQ(affineDepthFromLinear(true, 2), -2);
}

TEST(ShaderGuards, APlaneSeenEdgeOn)
{
    const View view = plainView();
    for (const vec3 normal : {vec3(0, 1, 0), vec3(0), vec3(1, 0, 0)}) {
        const vec2 gradient = computeNormalGradient(view, vec2(32, 16), Real(0.5), normal);
        EXPECT_TRUE(isNumber(gradient));
        const vec2 clamped = clampGradient(gradient, Real(0.5));
        EXPECT_LE(std::abs(clamped.x) + std::abs(clamped.y), 2 * kPatchExtent * Real(0.5) * (1 + kUlps));
    }
    EXPECT_TRUE(clampGradient(vec2(0), 0) == vec2(0));
    EXPECT_TRUE(clampGradient(vec2(1, -1), 0) == vec2(0));
}

TEST(ShaderGuards, ConfidenceOfNoClearanceAndOfAll)
{
    for (const Real clearance : {Real(0), Real(-1), kTiny})
        EXPECT_NEAR(computeConfidence(clearance), 0, 1e-6);
    EXPECT_EQ(computeConfidence(Real(1e29)), Real(0.995));
    EXPECT_EQ(computeConfidence(kNoClearance), Real(0.998));
    const Real lost = computeConfidence(kNaN);
    EXPECT_GE(lost, 0);
    EXPECT_LE(lost, 1);
}

TEST(ShaderGuards, ALevelForARayThatDoesNotMove)
{
    PatchWalk walk{};
    walk.ray.deltaSS = vec2(0, 0);
    PatchCell cell{};
    for (const Real slack : {Real(0), Real(1), Real(-1)}) {
        cell.surface.slack = slack;
        const int level = chooseFinerLevel(walk, cell, 6);
        EXPECT_GE(level, 0);
        EXPECT_LE(level, 5);
    }
}

TEST(ShaderGuards, AbsorptionByBlackAndWithinNoDistance)
{
    for (const Real distance : {Real(0), Real(-1), kNaN, kTiny, kHuge}) {
        for (const Real color : {Real(0), Real(-1), kNaN, Real(2), kInfinity}) {
            for (const Real path : {Real(0), Real(-1), kNaN, kTiny, kHuge, kInfinity}) {
                const vec3 share = computeTransmittance(vec3(color), distance, path);
                EXPECT_GE(share.x, 0) << color << ' ' << distance << ' ' << path;
                EXPECT_LE(share.x, 1) << color << ' ' << distance << ' ' << path;
            }
        }
    }
    EXPECT_EQ(computeTransmittance(vec3(0), 0, 1).x, 0);
    EXPECT_EQ(computeTransmittance(vec3(1), 0, 1).x, 1);
}

TEST(ShaderGuards, FresnelAtTheHorizonOfTheThinnestAndTheDensest)
{
    for (const Real cosine : {Real(0), Real(-1), kNaN, Real(2)}) {
        for (const Real index : {kTiny, Real(1e-3), Real(1), Real(1000), Real(1e29)}) {
            for (const Real share : {computeFresnelExact(cosine, index), computeFresnelSchlick(cosine, index)}) {
                EXPECT_GE(share, 0) << cosine << ' ' << index;
                EXPECT_LE(share, 1) << cosine << ' ' << index;
            }
        }
    }
    for (const Real index : {Real(0), Real(-1), kNaN, kInfinity}) {
        EXPECT_EQ(computeFresnelExact(1, index), 1);
        EXPECT_EQ(computeFresnelSchlick(1, index), 1);
    }
}

TEST(ShaderGuards, AFadeWithoutWidth)
{
    for (const int form : {kScreenWeightLinear, kScreenWeightSmooth2018, kScreenWeightSmoothToday}) {
        for (const Real distance : {Real(0), Real(-1), kNaN, kTiny})
            EXPECT_EQ(computeScreenRamp(Real(0.5), distance, form), 1);
        EXPECT_EQ(computeScreenRamp(0, kTiny, form), 0);
    }
}

TEST(ShaderGuards, ABlendWithoutWidth)
{
    for (const Real blend : {Real(0), Real(-1), kNaN, kTiny}) {
        EXPECT_EQ(computeSphereInfluence(vec3(0), 1, blend), 1);
        EXPECT_EQ(computeSphereInfluence(vec3(2, 0, 0), 1, blend), 0);
        EXPECT_EQ(computeBoxInfluence(vec3(0), vec3(1), vec3(blend), vec3(blend)), 1);
        EXPECT_EQ(computeBoxInfluence(vec3(1, 0, 0), vec3(1), vec3(blend), vec3(blend)), 0);
    }
}
