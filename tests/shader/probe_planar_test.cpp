#include "tests/shader/generators.h"

#include "harness/backend/cpu/glsl.h"

#include "crossray/probe/planar.glsl"
#include "tests/shader/views.h"

#include "harness/backend/cpu/glsl_end.h"

using namespace CROSSRAY_SHADER_NAMESPACE;

namespace {

const MirrorPlane kFloor{vec3(0), vec3(0, 3, 0)};

// An eye 2 m above the floor that looks down by 0.4.
View makeEye(int depth, bool orthographic = false)
{
    return makeView(vec2(64, 48), orthographic ? 4 : Real(0.5), Real(0.1), 50, depth, orthographic, vec3(0, 2, 5),
                    Real(0.3), Real(-0.4));
}

Real deviceDepth(mat4 clipFromView, vec3 positionVS)
{
    const vec4 clip = clipFromView * vec4(positionVS, 1);
    return clip.z / clip.w;
}

} // namespace

// The image of a point: half way to it lies the plane's foot, and the way is along the normal.
RC_GTEST_PROP(ShaderPlanar, ReflectionByTheFootOfThePerpendicular, ())
{
    const vec3 n = drawUnitVector<vec3>();
    const vec3 q = drawPoint<vec3>(4);
    const vec3 p = drawPoint<vec3>(4);
    const vec3 image = (makeReflectionMatrix({q, n * Real(7)}) * vec4(p, 1)).xyz;
    RC_ASSERT(std::fabs(dot((p + image) * Real(0.5) - q, n)) < 40 * kUlps);
    RC_ASSERT(length(cross(image - p, n)) < 60 * kUlps);
    const vec3 back = (makeReflectionMatrix({q, n}) * vec4(image, 1)).xyz;
    RC_ASSERT(length(back - p) < 100 * kUlps);
}

// What is seen in the mirror at a pixel is what the mirrored camera has at that pixel: points of the plane keep their
// place, and all points along the reflected ray fall on it.
RC_GTEST_PROP(ShaderPlanar, TheReflectedRayIsOnePixel, ())
{
    const View view = makeEye(1);
    const MirroredView mirrored = makeMirroredView(view, kFloor);
    RC_ASSERT(mirrored.status == kPlanarOk);
    const vec3 p(drawReal(-1, 1), 0, drawReal(-1, 1));
    const vec3 eye(0, 2, 5);
    vec3 r = normalize(p - eye);
    r.y = -r.y; // the floor's mirror
    const ScreenPosition direct = projectWSToSS(view, p);
    RC_ASSERT(direct.inFront);
    const Real t = drawReal(0, 30);
    const PlanarLookup at = lookUpPlanar(mirrored.view, view.clipFromView, p + r * t, r);
    RC_ASSERT(at.status == kPlanarOk && at.weight == Real(1));
    RC_ASSERT(length(at.positionUV * view.imageSize - direct.positionSS) < 3000 * kUlps);
    // The mirrored camera stands as deep below the floor as the eye above it.
    RC_ASSERT(length(mirrored.view.worldFromView[3].xyz - vec3(0, -2, 5)) < 20 * kUlps);
}

// The plane itself has the near plane's depth, what is behind the mirror is beyond it, and x, y, w stay.
RC_GTEST_PROP(ShaderPlanar, TheObliqueNearPlaneIsTheMirror, ())
{
    const int depth = *rc::gen::inRange(0, 3);
    const bool orthographic = depth < 2 && *rc::gen::inRange(0, 2) == 1;
    const View view = makeMirroredView(makeEye(depth, orthographic), kFloor).view;
    const ObliqueProjection oblique = makeObliqueProjection(view, kFloor);
    RC_ASSERT(oblique.status == kPlanarOk);
    const Real nearDepth = depth == 0 ? 0 : 1;
    const vec3 onPlane = positionVSFromWS(view, vec3(drawReal(-1, 1), 0, drawReal(-1, 1)));
    RC_ASSERT(std::fabs(deviceDepth(oblique.clipFromView, onPlane) - nearDepth) < 200 * kUlps);
    const Real height = drawReal(Real(0.01), 3);
    const vec3 above = positionVSFromWS(view, vec3(drawReal(-1, 1), height, drawReal(-1, 1)));
    const vec3 below = positionVSFromWS(view, vec3(drawReal(-1, 1), -height / 3, drawReal(-1, 1)));
    const Real sign = depth == 0 ? Real(1) : Real(-1); // away from the near plane
    RC_ASSERT((deviceDepth(oblique.clipFromView, above) - nearDepth) * sign > 0);
    RC_ASSERT((deviceDepth(oblique.clipFromView, below) - nearDepth) * sign < 0);
    // And back to metres.
    const vec4 clip = oblique.clipFromView * vec4(above, 1);
    const vec4 before = view.clipFromView * vec4(above, 1);
    RC_ASSERT(clip.x == before.x && clip.y == before.y && clip.w == before.w);
    const Real stored = clip.z / clip.w;
    const vec2 ndc = clip.xy / clip.w;
    // A rounding of the stored depth moves it by depth^2 / row.w.
    RC_ASSERT(std::fabs(linearDepthFromOblique(view, oblique.clipFromView, ndc, stored) + above.z) < 2000 * kUlps);
}

// The far plane passes through the far corner on the mirror's front: nothing of the view volume in front of the mirror
// is cut off.
TEST(ShaderPlanar, TheObliqueFarPlaneCutsNothing)
{
    for (int depth : {0, 1}) {
        for (bool orthographic : {false, true}) {
            const View view = makeMirroredView(makeEye(depth, orthographic), kFloor).view;
            const mat4 clipFromView = makeObliqueProjection(view, kFloor).clipFromView;
            const Real farDepth = depth == 0 ? 1 : 0;
            Real closest = 10;
            for (Real x : {Real(-1), Real(0), Real(1)}) {
                for (Real y : {Real(-1), Real(0), Real(1)}) {
                    for (Real z : {Real(1), Real(20), Real(50)}) {
                        const Real reach = orthographic ? Real(1) : z;
                        const vec3 p(x * view.slope.x * reach, y * view.slope.y * reach, -z);
                        if (positionWSFromVS(view, p).y < 0) continue; // behind the mirror
                        const Real left = (farDepth - deviceDepth(clipFromView, p)) * (depth == 0 ? Real(1) : Real(-1));
                        EXPECT_GT(left, -20 * kUlps);
                        closest = std::min(closest, left);
                    }
                }
            }
            EXPECT_NEAR(closest, 0, 20 * kUlps); // and one corner is on it
        }
    }
}

TEST(ShaderPlanar, ObliqueBackgroundIsFar)
{
    for (int depth : {0, 1, 2}) {
        const View view = makeMirroredView(makeEye(depth), kFloor).view;
        const mat4 clipFromView = makeObliqueProjection(view, kFloor).clipFromView;
        const Real cleared = depth == 0 ? 1 : 0;
        for (vec2 ndc : {vec2(0), vec2(1, 1), vec2(-1, 1), vec2(1, -1)}) {
            EXPECT_EQ(linearDepthFromOblique(view, clipFromView, ndc, cleared), view.farDistance);
            EXPECT_EQ(linearDepthFromOblique(view, clipFromView, ndc, kNaN), view.farDistance);
        }
    }
}

TEST(ShaderPlanar, ACameraOnOrBehindThePlaneCapturesNothing)
{
    for (Real height : {Real(0), Real(1e-5), Real(-2)}) {
        const View view = makeView(vec2(8, 8), Real(0.5), Real(0.1), 50, 1, false, vec3(0, height, 0));
        EXPECT_EQ(makeMirroredView(view, kFloor).status, kPlanarCameraNotInFront);
    }
    // A view that was not mirrored stands in front: its near plane cannot be the mirror.
    EXPECT_EQ(makeObliqueProjection(makeEye(1), kFloor).status, kPlanarCameraNotInFront);
}

TEST(ShaderPlanar, LookingAlongTheNormalIsLikeAnyOther)
{
    const Real down = -std::acos(Real(0)); // straight down onto the mirror
    const View view = makeView(vec2(8, 8), Real(0.5), Real(0.1), 50, 1, false, vec3(1, 3, 2), 0, down);
    const MirroredView mirrored = makeMirroredView(view, kFloor);
    ASSERT_EQ(mirrored.status, kPlanarOk);
    const ObliqueProjection oblique = makeObliqueProjection(mirrored.view, kFloor);
    ASSERT_EQ(oblique.status, kPlanarOk);
    // The eye sees itself in the middle of the image.
    const PlanarLookup eye = lookUpPlanar(mirrored.view, oblique.clipFromView, vec3(1, 3, 2), vec3(0, 1, 0));
    EXPECT_EQ(eye.weight, 1);
    EXPECT_NEAR(eye.positionUV.x, Real(0.5), 8 * kUlps);
    EXPECT_NEAR(eye.positionUV.y, Real(0.5), 8 * kUlps);
}

TEST(ShaderPlanar, WithoutFieldOfViewOrPlane)
{
    EXPECT_EQ(computeCaptureSlope(0, 1), vec2(0));
    EXPECT_EQ(computeCaptureSlope(Real(3.2), 1), vec2(0));
    EXPECT_EQ(computeCaptureSlope(kNaN, 1), vec2(0));
    EXPECT_EQ(computeCaptureSlope(1, kInfinity), vec2(0));
    EXPECT_NEAR(computeCaptureSlope(Real(1.5707963267948966), 2).x, 2, 8 * kUlps); // 90 degrees, twice as wide
    View view = makeEye(1);
    EXPECT_EQ(makeMirroredView(view, {vec3(0), vec3(0)}).status, kPlanarDegeneratePlane);
    EXPECT_EQ(makeMirroredView(view, {vec3(kNaN), vec3(0, 1, 0)}).status, kPlanarDegeneratePlane);
    EXPECT_EQ(makeObliqueProjection(view, {vec3(0), vec3(kInfinity)}).status, kPlanarDegeneratePlane);
    view.slope = computeCaptureSlope(0, 1);
    EXPECT_EQ(makeMirroredView(view, kFloor).status, kPlanarNoFieldOfView);
}

TEST(ShaderPlanar, APlaneOutOfViewLeavesTheProjection)
{
    // The mirrored eye stands behind the plane and looks away from it.
    const View away = makeView(vec2(8, 8), Real(0.3), Real(0.1), 50, 1, false, vec3(0, 0, -1));
    const ObliqueProjection oblique = makeObliqueProjection(away, {vec3(0), vec3(0, 0, 1)});
    EXPECT_EQ(oblique.status, kPlanarPlaneOutOfView);
    EXPECT_TRUE(oblique.clipFromView == away.clipFromView);
}

TEST(ShaderPlanar, LookUpWeightsAndTheirReasons)
{
    for (int depth : {0, 1, 2}) {
        // At the origin, looking along -z, 45 degrees to each side.
        const View view = makeView(vec2(8, 8), Real(0.7853981633974483), Real(0.5), 50, depth);
        const vec3 forward(0, 0, -1);
        const PlanarLookup hit = lookUpPlanar(view, view.clipFromView, vec3(1, 1, -4), forward);
        EXPECT_EQ(hit.weight, 1);
        EXPECT_NEAR(hit.positionUV.x, Real(0.625), 4 * kUlps);
        EXPECT_NEAR(hit.positionUV.y, Real(0.375), 4 * kUlps);
        const auto status = [&](vec3 p, vec3 r) {
            const PlanarLookup at = lookUpPlanar(view, view.clipFromView, p, r);
            EXPECT_EQ(at.weight, at.status == kPlanarOk ? 1 : 0);
            return at.status;
        };
        EXPECT_EQ(status(vec3(5, 0, -4), forward), kPlanarOutsideImage);
        EXPECT_EQ(status(vec3(0, -5, -4), forward), kPlanarOutsideImage);
        EXPECT_EQ(status(vec3(0, 0, Real(-0.4)), forward), kPlanarBehindNearPlane);
        EXPECT_EQ(status(vec3(0, 0, 4), forward), kPlanarBehindNearPlane);
        EXPECT_EQ(status(vec3(0, 0, 0), forward), kPlanarBehindNearPlane);
        EXPECT_EQ(status(vec3(0, 0, -4), vec3(0, Real(0.1), 1)), kPlanarOpposed);
        EXPECT_EQ(status(vec3(0, 0, -4), vec3(1, 0, Real(0.01))), kPlanarOpposed);
        EXPECT_EQ(status(vec3(0, 0, -4), vec3(1, 0, 0)), kPlanarOk); // a right angle
        EXPECT_EQ(status(vec3(0, 0, -4000), forward), kPlanarOk);    // the far plane is no bound
        EXPECT_EQ(status(vec3(0, 0, -4), vec3(0)), kPlanarDegenerateRay);
        EXPECT_EQ(status(vec3(0, kNaN, -4), forward), kPlanarDegenerateRay);
    }
}

// The second of the document's two questions about a probe that shows nothing.
TEST(ShaderPlanar, AlignmentOfMirrorAndSurface)
{
    EXPECT_NEAR(computeMirrorAlignment(kFloor, vec3(0, 9, 0)), 1, kUlps);
    EXPECT_NEAR(computeMirrorAlignment(kFloor, vec3(0, 1, 1)), std::sqrt(Real(0.5)), kUlps);
    EXPECT_EQ(computeMirrorAlignment(kFloor, vec3(1, 0, 0)), 0);
    EXPECT_EQ(computeMirrorAlignment(kFloor, vec3(kNaN)), 0);
}

RC_GTEST_PROP(ShaderPlanar, AnswersAnything, ())
{
    const View view = makeEye(*rc::gen::inRange(0, 3));
    const MirrorPlane plane{drawHostileVector<vec3>(), drawHostileVector<vec3>()};
    const PlanarLookup at = lookUpPlanar(view, view.clipFromView, drawHostileVector<vec3>(), drawHostileVector<vec3>());
    RC_ASSERT(isFinite(at.positionUV) && (at.weight == Real(1)) == (at.status == kPlanarOk));
    const Real z = linearDepthFromOblique(view, view.clipFromView, vec2(drawHostile(), drawHostile()), drawHostile());
    RC_ASSERT(z > 0 && z <= view.farDistance);
    RC_ASSERT(isFinite(computeMirrorAlignment(plane, drawHostileVector<vec3>())));
    RC_ASSERT(isFinite(computeCaptureSlope(drawHostile(), drawHostile())));
}
