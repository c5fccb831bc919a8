#include "tests/shader/generators.h"

#include "harness/backend/cpu/glsl.h"

#include "crossray/core/view.glsl"
#include "tests/shader/views.h"

#include "harness/backend/cpu/glsl_end.h"

using namespace CROSSRAY_SHADER_NAMESPACE;

namespace {

View drawView()
{
    const bool orthographic = *rc::gen::inRange(0, 2) == 1;
    const int depth = *rc::gen::inRange(0, orthographic ? 2 : 3);
    const vec2 size(static_cast<Real>(*rc::gen::inRange(1, 4000)), static_cast<Real>(*rc::gen::inRange(1, 4000)));
    return makeView(size, orthographic ? drawReal(1, 20) : drawReal(Real(0.1), Real(1.4)), drawReal(Real(0.01), 1),
                    drawReal(10, 1000), depth, orthographic, drawPoint<vec3>(10), drawReal(-3, 3),
                    drawReal(Real(-1.5), Real(1.5)));
}

} // namespace

TEST(ShaderView, DepthOfThePlanes)
{
    for (int depth = 0; depth < 3; ++depth) {
        View view = makeView(vec2(64, 48), Real(0.5), Real(0.1), 100, depth);
        EXPECT_NEAR(deviceDepthFromLinear(view, Real(0.1)), depth == 0 ? 0 : 1, kUlps);
        EXPECT_NEAR(linearDepthFromDevice(view, depth == 0 ? 0 : 1), Real(0.1), kUlps);
        const Real cleared = depth == 0 ? 1 : 0;
        EXPECT_EQ(linearDepthFromDevice(view, cleared), view.farDistance);
        EXPECT_EQ(linearDepthFromDevice(view, kNaN), view.farDistance);
        EXPECT_TRUE(isClearedDepth(view, cleared));
        EXPECT_TRUE(isClearedDepth(view, kNaN));
        EXPECT_FALSE(isClearedDepth(view, Real(0.5)));
        // A rounding beyond the near plane is the near plane; more was never drawn.
        const Real beyondNear = depth == 0 ? -kUlps : 1 + kUlps;
        EXPECT_FALSE(isClearedDepth(view, beyondNear));
        EXPECT_NEAR(linearDepthFromDevice(view, beyondNear), Real(0.1), kUlps);
        for (const Real impossible : {Real(-1), Real(-3e38), Real(2), Real(3e38), kInfinity, -kInfinity}) {
            EXPECT_TRUE(isClearedDepth(view, impossible)) << impossible;
            EXPECT_EQ(linearDepthFromDevice(view, impossible), view.farDistance) << impossible;
        }
        EXPECT_TRUE(std::isfinite(deviceDepthFromLinear(view, 0)));
    }
    // Standard depth, near 1, far 3, at 1.5 m: f (z - n) / (z (f - n)) = 3 * 0.5 / (1.5 * 2) = 0.5.
    EXPECT_NEAR(deviceDepthFromLinear(makeView(vec2(2, 2), 1, 1, 3, 0), Real(1.5)), Real(0.5), kUlps);
    EXPECT_NEAR(deviceDepthFromLinear(makeView(vec2(2, 2), 1, 1, 3, 0, true), Real(1.5)), Real(0.25), kUlps);
}

RC_GTEST_PROP(ShaderView, DepthGoesThereAndBack, ())
{
    const View view = drawView();
    const Real z = view.nearDistance + drawReal(0, 1) * (min(view.farDistance, Real(1000)) - view.nearDistance);
    const Real device = deviceDepthFromLinear(view, z);
    RC_ASSERT(device >= -kUlps && device <= 1 + kUlps);
    const Real back = linearDepthFromDevice(view, device);
    // What one rounding of the stored value is worth in metres, for standard depth far away a lot.
    const Real slope = view.orthographic ? std::fabs(1 / view.depthB) : z * z / std::fabs(view.depthB);
    RC_ASSERT(std::fabs(back - z) <= kUlps * (z + slope * 2));
}

RC_GTEST_PROP(ShaderView, ScreenGoesThereAndBack, ())
{
    const View view = drawView();
    const vec2 positionSS(drawReal(0, view.imageSize.x), drawReal(0, view.imageSize.y));
    const Real z = drawReal(view.nearDistance, 50);
    const ScreenPosition again = projectWSToSS(view, positionWSFromSS(view, positionSS, z));
    RC_ASSERT(again.inFront);
    // World positions round at their distance from the origin, 10 to 20 m and more.
    const Real metres = kUlps * (40 + z * (1 + view.slope.x + view.slope.y));
    const Real pixels = metres * length(screenScale(view)) / (view.orthographic ? Real(1) : z);
    RC_ASSERT(std::fabs(again.linearDepth - z) <= metres);
    RC_ASSERT(length(again.positionSS - positionSS) <= pixels * (1 + view.slope.x + view.slope.y) + kUlps * 4000);
}

TEST(ShaderView, ScreenRunsDown)
{
    View view = makeView(vec2(200, 100), std::atan(Real(0.5)), Real(0.1), 100, 1);
    ScreenPosition p = projectVSToSS(view, vec3(1, Real(0.5), -2));
    EXPECT_NEAR(p.positionSS.x, 150, 1000 * kUlps);
    EXPECT_NEAR(p.positionSS.y, 25, 1000 * kUlps);
    EXPECT_EQ(p.linearDepth, 2);
    EXPECT_TRUE(isOnScreen(view, p.positionSS));
    EXPECT_TRUE(isOnScreen(view, vec2(200, 0)));
    EXPECT_FALSE(isOnScreen(view, vec2(Real(200.1), 0)));
    for (vec3 behind : {vec3(1, 1, 2), vec3(0), vec3(1, 1, kNaN), vec3(Real(3e38), 0, Real(-1e-30))}) {
        ScreenPosition q = projectVSToSS(view, behind);
        EXPECT_FALSE(q.inFront);
        EXPECT_TRUE(q.positionSS == vec2(0));
    }
}

TEST(ShaderView, LooksBackAtTheEye)
{
    View view = makeView(vec2(4, 4), Real(0.5), Real(0.1), 100, 1, false, vec3(1, 2, 3));
    EXPECT_TRUE(viewDirectionWS(view, vec3(1, 2, -7)) == vec3(0, 0, 1));
    EXPECT_TRUE(viewDirectionWS(view, vec3(1, 2, 3)) == vec3(0, 0, 1));
    EXPECT_TRUE(viewDirectionWS(view, vec3(11, 2, 3)) == vec3(-1, 0, 0));
    View flat = makeView(vec2(4, 4), 1, Real(0.1), 100, 1, true, vec3(1, 2, 3));
    EXPECT_TRUE(viewDirectionWS(flat, vec3(9, 9, -9)) == vec3(0, 0, 1));
}
