#include "tests/shader/generators.h"
#include "tests/shader/shader_test.h"

#include "harness/backend/cpu/glsl.h"

#define CROSSRAY_BUILD_SURFACE_PYRAMID
#include "crossray/project/patch_tracer.glsl"
#include "tests/shader/views.h"
#include "tests/shader/patch_fixture.h"

#include "harness/backend/cpu/glsl_end.h"

using namespace CROSSRAY_SHADER_NAMESPACE;

namespace {

const Real kHalfFov = Real(0.5235987755982988); // 30 degrees
const PatchTracerSettings kBalanced(99, 1 << 20, Real(0.4), 0);

vec3 makeDirection(Real x, Real y, Real z)
{
    return normalize(vec3(x, y, z));
}

Real clearedDepth(const View& view)
{
    return view.reversedDepth ? 0 : 1;
}

// Depth in [near, far] from a function of the pixel; a negative one is sky.
template <typename Depth>
void fillImage(const View& view, Depth linearDepth)
{
    const ivec2 size(view.imageSize);
    gImage = DepthImage{size, {}, {}};
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) {
            const Real depth = linearDepth(x, y);
            gImage.deviceDepths.push_back(depth < 0 ? clearedDepth(view) : deviceDepthFromLinear(view, depth));
            gImage.normalsWS.push_back(vec3(0, 0, 0));
        }
    }
}

// Metres of depth at which the view ray of a pixel's centre meets a plane in view space; -1 where it does not.
Real depthOfPlane(const View& view, int x, int y, vec3 pointVS, vec3 normalVS)
{
    const vec2 centre = vec2(ivec2(x, y)) + vec2(0.5);
    const vec3 a = positionVSFromSS(view, centre, 1);
    const vec3 b = positionVSFromSS(view, centre, 2);
    const Real rate = dot(b - a, normalVS);
    const Real depth = 1 + dot(pointVS - a, normalVS) / (rate == 0 ? Real(1e-9) : rate);
    return depth > view.nearDistance && depth < view.farDistance ? depth : -1;
}

// A floor, a wall, and boxes and poles that face the eye, some of them in noise.
void drawImage(const View& view)
{
    struct Block {
        int x, y, w, h;
        Real depth;
    };
    std::vector<Block> blocks;
    const ivec2 size(view.imageSize);
    const int count = *rc::gen::inRange(0, 7);
    for (int i = 0; i < count; ++i) {
        const int w = *rc::gen::inRange(1, std::max(2, size.x / 3));
        const int h = *rc::gen::inRange(1, std::max(2, size.y));
        blocks.push_back({*rc::gen::inRange(0, size.x), *rc::gen::inRange(0, size.y), w, h, drawReal(1, 12)});
    }
    const Real noise = *rc::gen::element(Real(0), Real(0), Real(0.001), Real(0.3));
    const Real holes = *rc::gen::element(Real(0), Real(0.05));
    const bool onlyNoise = *rc::gen::inRange(0, 4) == 0;
    const Real tilt = drawReal(-1, 1);
    unsigned random = *rc::gen::inRange(1u, 1u << 30);
    auto next = [&random] {
        random = random * 1664525u + 1013904223u;
        return static_cast<Real>(random >> 8) / static_cast<Real>(1 << 24);
    };
    fillImage(view, [&](int x, int y) {
        if (next() < holes) return Real(-1);
        if (onlyNoise) return Real(0.5) + 20 * next();
        Real depth = depthOfPlane(view, x, y, vec3(0, 0, -10), vec3(tilt, 0, 1));
        const Real floorDepth = depthOfPlane(view, x, y, vec3(0, -1, 0), vec3(0, 1, 0));
        if (floorDepth > 0 && (depth < 0 || floorDepth < depth)) depth = floorDepth;
        for (const Block& b : blocks) {
            if (x >= b.x && x < b.x + b.w && y >= b.y && y < b.y + b.h && (depth < 0 || b.depth < depth))
                depth = b.depth;
        }
        return depth < 0 ? depth : std::max(view.nearDistance * Real(1.01), depth * (1 + noise * (next() - Real(0.5))));
    });
    const bool hasNormals = *rc::gen::inRange(0, 2) == 0;
    if (!hasNormals) return;
    for (vec3& normal : gImage.normalsWS)
        normal = vec3(next() - Real(0.5), next() - Real(0.5), next());
}

View drawView(int width, int height)
{
    const bool orthographic = *rc::gen::inRange(0, 3) == 0;
    const int depth = *rc::gen::inRange(0, orthographic ? 2 : 3);
    return makeView(vec2(ivec2(width, height)), orthographic ? Real(3) : kHalfFov, Real(0.1), 100, depth, orthographic);
}

// From a pixel that shows a surface, or from anywhere in the view.
vec3 drawOrigin(const View& view)
{
    const ivec2 size(view.imageSize);
    const ivec2 pixel(*rc::gen::inRange(0, size.x), *rc::gen::inRange(0, size.y));
    const Real device = fetchDeviceDepth(pixel);
    const bool free = *rc::gen::inRange(0, 5) == 0 || isClearedDepth(view, device);
    const Real depth = free ? drawReal(Real(0.2), 20) : linearDepthFromDevice(view, device);
    const vec2 offset = free ? vec2(drawReal(0, 1), drawReal(0, 1)) : vec2(0.5);
    return positionWSFromSS(view, vec2(pixel) + offset, depth);
}

vec3 drawDirection()
{
    vec3 dir = drawUnitVector<vec3>();
    const int kind = *rc::gen::inRange(0, 6); // some lie in an axis or a diagonal
    if (kind == 0) dir.x = 0;
    if (kind == 1) dir.y = 0;
    if (kind == 2) dir.z = 0;
    if (kind == 3) dir = vec3(dir.x, dir.x, dir.z);
    return dir;
}

void compareWalks(const View& view)
{
    PatchTracerSettings settings = kBalanced;
    settings.caution = *rc::gen::element(Real(0), Real(0.4), Real(2));
    settings.maxLevel = *rc::gen::inRange(0, 14);
    const vec3 origin = drawOrigin(view);
    const vec3 dir = drawDirection();
    const PatchTraceResult expected = traceEveryPixel(view, origin, dir, settings);
    const PatchTraceResult actual = tracePatches(view, origin, dir, settings);
    RC_ASSERT(actual.hitClass == expected.hitClass);
    RC_ASSERT(actual.reason == expected.reason);
    RC_ASSERT(actual.positionSS == expected.positionSS);
    RC_ASSERT(actual.linearDepth == expected.linearDepth);
    RC_ASSERT(actual.confidence == expected.confidence);
    RC_ASSERT(gBadSurfaceReads == 0);
}

} // namespace

// The levels only save reads: over any image each ray ends in the same pixel, at the same place, in the same class.
RC_GTEST_PROP(ShaderPatchTracer, FindsWhatTheWalkOverEveryPixelFinds, ())
{
    const View view = drawView(*rc::gen::inRange(1, 90), *rc::gen::inRange(1, 70));
    drawImage(view);
    buildSurfacePyramid(view);
    for (int ray = 0; ray < 30; ++ray)
        compareWalks(view);
}

RC_GTEST_PROP(ShaderPatchTracer, FindsItInImagesOneToThreePixelsWide, ())
{
    const int thin = *rc::gen::inRange(1, 4);
    const int length = *rc::gen::inRange(1, 200);
    const bool isWide = *rc::gen::inRange(0, 2) == 0;
    const View view = drawView(isWide ? length : thin, isWide ? thin : length);
    drawImage(view);
    buildSurfacePyramid(view);
    for (int ray = 0; ray < 30; ++ray)
        compareWalks(view);
}

TEST(ShaderPatchTracer, FindsItAt8192Pixels)
{
    rc::check([] {
        const View view = drawView(8192 - *rc::gen::inRange(0, 3), *rc::gen::inRange(3, 8));
        drawImage(view);
        buildSurfacePyramid(view);
        for (int ray = 0; ray < 40; ++ray)
            compareWalks(view);
    });
}

// A mirror floor before a wall: the reflected ray meets the wall where optics says, to rounding.
TEST(ShaderPatchTracer, IsExactOnPlanes)
{
    for (int depth : {0, 1}) {
        const View view = makeView(vec2(161, 91), kHalfFov, Real(0.1), 100, depth);
        fillImage(view, [&](int x, int y) {
            const Real floorDepth = depthOfPlane(view, x, y, vec3(0, -1, 0), vec3(0, 1, 0));
            return floorDepth > 0 && floorDepth < 8 ? floorDepth : Real(8);
        });
        buildSurfacePyramid(view);
        int compared = 0;
        for (int x = 3; x < 158; x += 7) {
            const ivec2 pixel(x, 80);
            const Real seen = linearDepthFromDevice(view, fetchDeviceDepth(pixel));
            const vec3 origin = positionWSFromSS(view, vec2(pixel) + vec2(0.5), seen);
            const vec3 dir = makeDirection(origin.x, -origin.y, origin.z);
            const vec3 truth = origin + dir * ((-8 - origin.z) / dir.z);
            const ScreenPosition expected = projectWSToSS(view, truth);
            if (!expected.inFront || !isOnScreen(view, expected.positionSS)) continue;
            const PatchTraceResult result = tracePatches(view, origin, dir, kBalanced);
            ASSERT_EQ(result.hitClass, kHitClassHit) << x << " depth " << depth;
            // Standard depth in float keeps a step of 1e-4 m at 8 m.
            EXPECT_NEAR(result.linearDepth / 8, 1, depth == 0 ? Real(2e-4) : Real(2e-6)) << x;
            EXPECT_LT(length(result.positionSS - expected.positionSS), depth == 0 ? Real(0.05) : Real(2e-3)) << x;
            EXPECT_GT(result.confidence, Real(0.99));
            ++compared;
        }
        EXPECT_GT(compared, 15);
    }
}

// A ray along an orthographic floor and up a step: the step is met at its foot.
TEST(ShaderPatchTracer, MeetsAWallInOrthographicViews)
{
    for (int depth : {0, 1}) {
        const View view = makeView(vec2(64, 64), Real(2), Real(0.1), 100, depth, true);
        // A ramp that comes nearer to the right, x in [-2, 2], z = -6 + x; and a wall at depth 3 from x = 1.5.
        fillImage(view, [&](int x, int) {
            const Real metres = (static_cast<Real>(x) + Real(0.5)) / 16 - 2;
            return metres < Real(1.5) ? 6 - metres : Real(3);
        });
        buildSurfacePyramid(view);
        const vec3 origin =
            positionWSFromSS(view, vec2(8.5, 32.5), linearDepthFromDevice(view, fetchDeviceDepth(ivec2(8, 32))));
        // In front of the ramp it goes on to the silhouette of the wall, behind which it cannot be seen.
        const PatchTraceResult hidden = tracePatches(view, origin, makeDirection(1, 0, Real(1.2)), kBalanced);
        EXPECT_EQ(hidden.hitClass, kHitClassUnknown);
        EXPECT_EQ(hidden.reason, kHitReasonBehindSurface);
        // Back into the ramp from a start well above it.
        const vec3 above = positionWSFromSS(view, vec2(8.5, 32.5), 5);
        const PatchTraceResult hit = tracePatches(view, above, makeDirection(1, 0, 0), kBalanced);
        ASSERT_EQ(hit.hitClass, kHitClassHit);
        EXPECT_NEAR(hit.positionSS.x, 48, Real(0.01)); // at x = 1, where the ramp is 5 m deep
        EXPECT_NEAR(hit.linearDepth, 5, Real(0.002));
    }
}

// Behind a pole, 0.1 m wide: from 1 m behind it the ray goes on; from a hand's breadth behind it nobody knows.
TEST(ShaderPatchTracer, PassesBehindWhatIsThinnerThanTheGap)
{
    const View view = makeView(vec2(320, 180), kHalfFov, Real(0.1), 100, 1);
    fillImage(view, [&](int x, int) { return x >= 200 && x < 206 ? Real(4) : Real(8); });
    buildSurfacePyramid(view);
    const vec3 target = positionWSFromSS(view, vec2(260, 90), 8);
    for (Real behind : {Real(1), Real(0.02)}) {
        const vec3 origin(0, 0, -4 - behind);
        const vec3 dir = behind > Real(0.1) ? normalize(target - origin) : vec3(1, 0, 0);
        const PatchTraceResult result = tracePatches(view, origin, dir, kBalanced);
        if (behind > Real(0.1)) {
            ASSERT_EQ(result.hitClass, kHitClassHit);
            EXPECT_NEAR(result.positionSS.x, 260, Real(0.05));
            EXPECT_LT(result.confidence, computeConfidence(kNoClearance));
        } else {
            EXPECT_EQ(result.hitClass, kHitClassUnknown);
            EXPECT_EQ(result.reason, kHitReasonBehindSurface);
        }
    }
}

// Wrong normals are overruled by depths that agree.
TEST(ShaderPatchTracer, TrustsDepthsMoreThanShadingNormals)
{
    const View view = makeView(vec2(64, 48), kHalfFov, Real(0.1), 100, 1);
    fillImage(view, [&](int x, int y) {
        return depthOfPlane(view, x, y, vec3(0, 0, -5), makeDirection(Real(0.3), Real(-0.2), 1));
    });
    buildSurfacePyramid(view);
    const std::vector<vec4> fromDepths = gSurfaces[0].cells;
    for (vec3 normal : {vec3(1, 1, 1), vec3(0, 0, -1), vec3(kNaN, 0, 0), vec3(Real(-0.3), Real(0.2), -1)}) {
        std::fill(gImage.normalsWS.begin(), gImage.normalsWS.end(), normal);
        buildSurfacePyramid(view);
        for (int y = 1; y < 47; ++y) {
            for (int x = 1; x < 63; ++x) {
                const vec4 expected = fromDepths[cellIndex(ivec2(x, y), ivec2(64, 48))];
                const vec4 actual = gSurfaces[0].cells[cellIndex(ivec2(x, y), ivec2(64, 48))];
                EXPECT_EQ(actual.x, expected.x);
                const Real size = computeFootprint(view, expected.x);
                EXPECT_NEAR(actual.y, expected.y, Real(0.06) * size) << x << " " << y;
                EXPECT_NEAR(actual.z, expected.z, Real(0.06) * size) << x << " " << y;
            }
        }
    }
}

// A large plane costs few reads, wherever the ray goes along it.
TEST(ShaderPatchTracer, PassesPlanesInAFewSteps)
{
    const View view = makeView(vec2(1024, 512), kHalfFov, Real(0.1), 1000, 1);
    fillImage(view, [&](int x, int y) {
        const Real floorDepth = depthOfPlane(view, x, y, vec3(0, -1, 0), vec3(0, 1, 0));
        return floorDepth > 0 && floorDepth < 40 ? floorDepth : Real(40);
    });
    buildSurfacePyramid(view);
    int rays = 0;
    double reads = 0;
    for (int y = 300; y < 500; y += 9) {
        for (int x = 5; x < 1020; x += 13) {
            const vec3 origin = positionWSFromSS(view, vec2(ivec2(x, y)) + vec2(0.5),
                                                 linearDepthFromDevice(view, fetchDeviceDepth(ivec2(x, y))));
            gSurfaceReads = 0;
            const PatchTraceResult r =
                tracePatches(view, origin, makeDirection(origin.x, -origin.y, origin.z), kBalanced);
            EXPECT_NE(r.reason, kHitReasonIterationCap);
            reads += gSurfaceReads;
            ++rays;
        }
    }
    EXPECT_LT(reads / rays, 16);
}

TEST(ShaderPatchTracer, SaysWhyThereIsNoHit)
{
    const View view = makeView(vec2(64, 64), kHalfFov, Real(0.1), 100, 1);
    fillImage(view, [](int, int) { return Real(-1); });
    buildSurfacePyramid(view);
    auto trace = [&](vec3 origin, vec3 dir, PatchTracerSettings settings = kBalanced) {
        return tracePatches(view, origin, dir, settings);
    };
    EXPECT_EQ(trace(vec3(0, 0, -5), vec3(0, 0, -1)).hitClass, kHitClassMiss);
    EXPECT_EQ(trace(vec3(0, 0, -5), vec3(0, 0, -1)).reason, kHitReasonSky);
    EXPECT_EQ(trace(vec3(0, 0, -5), vec3(1, 0, 0)).reason, kHitReasonOffScreen);
    EXPECT_EQ(trace(vec3(0, 0, -5), vec3(0, 0, 1)).reason, kHitReasonNearPlane);
    EXPECT_EQ(trace(vec3(0, 0, 5), vec3(0, 0, -1)).reason, kHitReasonNearPlane);
    EXPECT_EQ(trace(vec3(0, 0, -5), vec3(0, 0, 0)).hitClass, kHitClassNoRaycast);
    EXPECT_EQ(trace(vec3(9, 0, -5), vec3(0, 0, -1)).reason, kHitReasonOffScreen);
    EXPECT_EQ(trace(vec3(0, 0, -5), vec3(1, 0, 0), PatchTracerSettings(9, 0, 0, 0)).reason, kHitReasonIterationCap);
    for (const PatchTraceResult& r : {trace(vec3(0, 0, -5), vec3(0, 0, 1)), trace(vec3(kNaN, 0, 0), vec3(0, 0, 1))}) {
        EXPECT_EQ(r.confidence, 0);
        EXPECT_TRUE(std::isfinite(r.linearDepth) && std::isfinite(r.positionSS.x) && std::isfinite(r.positionSS.y));
    }
}

RC_GTEST_PROP(ShaderPatchTracer, IsFiniteWhateverTheInput, ())
{
    const View view = drawView(*rc::gen::inRange(1, 30), *rc::gen::inRange(1, 30));
    const ivec2 size(view.imageSize);
    gImage = DepthImage{size, {}, {}};
    for (int i = 0; i < size.x * size.y; ++i) {
        gImage.deviceDepths.push_back(drawHostile());
        gImage.normalsWS.push_back(drawHostileVector<vec3>());
    }
    buildSurfacePyramid(view);
    for (int ray = 0; ray < 20; ++ray) {
        const PatchTraceResult r = tracePatches(view, drawHostileVector<vec3>(), drawHostileVector<vec3>(),
                                                PatchTracerSettings(*rc::gen::inRange(-2, 9), 500, drawHostile(), 0));
        RC_ASSERT(std::isfinite(r.linearDepth));
        RC_ASSERT(std::isfinite(r.positionSS.x) && std::isfinite(r.positionSS.y));
        RC_ASSERT(r.confidence >= 0 && r.confidence <= 1);
        RC_ASSERT(gBadSurfaceReads == 0);
    }
}

// Each cell's plane and slack hold all surfaces below it, at every size.
RC_GTEST_PROP(ShaderSurfacePyramid, BoundsEveryPixelAtEveryLevel, ())
{
    const View view = drawView(*rc::gen::inRange(1, 40), *rc::gen::inRange(1, 40));
    drawImage(view);
    buildSurfacePyramid(view);
    const ivec2 size(view.imageSize);
    for (int level = 1; level < surfacePyramidLevelCount(); ++level) {
        for (int y = 0; y < size.y; ++y) {
            for (int x = 0; x < size.x; ++x) {
                const ivec2 cells = surfacePyramidSize(level);
                const ivec2 at = computeDepthPyramidCell(ivec2(x, y), level, cells);
                const SurfaceCell cell = unpackSurfaceCell(fetchSurfaceCell(at, level));
                const vec2 center = computeRectCenter(computeCellRect(at, level, cells, size));
                const SurfaceCell pixel = fetchPixelSurface(ivec2(x, y));
                for (vec2 corner : {vec2(0, 0), vec2(1, 0), vec2(0, 1), vec2(1, 1)}) {
                    const vec2 place = vec2(ivec2(x, y)) + corner;
                    const Real surface = pixelAffineDepth(pixel, ivec2(x, y), place);
                    const Real rounding = Real(1e-6) * (1 + std::fabs(surface));
                    RC_ASSERT(std::fabs(surface - surfaceAffineDepth(cell, center, place)) <= cell.slack + rounding);
                }
            }
        }
    }
}
