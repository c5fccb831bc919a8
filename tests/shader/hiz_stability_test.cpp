// Where screen-space tracers are known to fail: scales, sizes, borders, coarse depth.
#include "tests/shader/generators.h"
#include "tests/shader/scene.h"

#include "harness/backend/cpu/glsl.h"

#define CROSSRAY_REDUCE_DEPTH_PYRAMID
#include "crossray/project/hiz.glsl"
#include "tests/shader/views.h"
#include "tests/shader/hiz_fixture.h"

#include "harness/backend/cpu/glsl_end.h"

using namespace CROSSRAY_SHADER_NAMESPACE;
using shaderTest::box;
using shaderTest::plane;
using shaderTest::sphere;
using Shapes = std::vector<shaderTest::Shape>;

namespace {

const Real kHalfFov = Real(0.5235987755982988); // 30 degrees

Shapes scaledRoom(double s)
{
    return {plane({0, -1 * s, 0}, {0, 1, 0}), plane({0, 0, -8 * s}, {0, 0, 1}), plane({-4 * s, 0, 0}, {1, 0, 0}),
            box({1 * s, -0.5 * s, -5 * s}, {0.5 * s, 0.5 * s, 0.5 * s}), sphere({-1 * s, 0, -4 * s}, 0.6 * s)};
}
View scaledView(double s, int width, int height, Real yaw = Real(0.1))
{
    const Real scale = static_cast<Real>(s);
    return makeView(vec2(ivec2(width, height)), kHalfFov, Real(0.1) * scale, 100 * scale, 1, false,
                    vec3(0, Real(0.3), 1) * scale, yaw, Real(-0.15));
}
HizSettings fine(Real bias = Real(0.2))
{
    return HizSettings(0, 99, 4096, bias);
}

} // namespace

TEST(ShaderHizStability, TheWorldsScaleChangesNothing)
{
    const TraceCensus one = traceScene(scaledView(1, 113, 64), scaledRoom(1), fine());
    EXPECT_GT(one.recall(), 0.96);
    for (double scale : {0.01, 100.0}) {
        const TraceCensus c =
            traceScene(scaledView(scale, 113, 64), scaledRoom(scale), fine(Real(0.2) * static_cast<Real>(scale)));
        EXPECT_NEAR(c.recall(), one.recall(), 0.003) << scale;
        EXPECT_NEAR(c.precision(), one.precision(), 0.003) << scale;
        EXPECT_NEAR(c.falseShare(), one.falseShare(), 0.003) << scale;
    }
}

TEST(ShaderHizStability, OddAndThinImages)
{
    for (const ivec2 size : {ivec2(1, 1), ivec2(1, 64), ivec2(64, 1), ivec2(3, 77), ivec2(101, 63), ivec2(127, 65)}) {
        const TraceCensus c = traceScene(scaledView(1, size.x, size.y), scaledRoom(1), fine());
        EXPECT_EQ(gBadReads, 0);
        EXPECT_EQ(c.capped, 0);
        // One column or row has no slope across it.
        if (std::min(size.x, size.y) > 50) {
            EXPECT_GT(c.recall(), 0.96) << size.x;
        }
        EXPECT_LT(c.falseShare(), 0.05) << size.x << "x" << size.y;
    }
}

TEST(ShaderHizStability, BeyondEightThousandPixels)
{
    // A wall that recedes to the right, 3 pixels high; a ray along the row from the left edge meets it where geometry
    // says.
    const View view = makeView(vec2(16384, 3), Real(1e-4), Real(0.1), 1000, 1);
    const Shapes wall{plane({0, 0, -10}, {-0.3, 0, 1})};
    renderScene(view, wall);
    int found = 0;
    for (int i = 0; i < 40; ++i) {
        const Real x = Real(100.5) + static_cast<Real>(i) * 37;
        const vec3 origin = positionWSFromSS(view, vec2(x, Real(1.5)), 4);
        const vec3 dir = normalize(vec3(1, 0, Real(-0.4) - Real(0.2) * static_cast<Real>(i)));
        const auto truth = shaderTest::cast(wall, toVec(origin), toVec(dir));
        ASSERT_TRUE(truth);
        const ScreenPosition expected = projectWSToSS(view, fromVec(truth->position));
        if (!isOnScreen(view, expected.positionSS)) continue;
        const TraceResult r = traceHiz(view, origin, dir, fine());
        ASSERT_EQ(r.hitClass, kHitClassHit) << i;
        EXPECT_NEAR(r.positionSS.x, expected.positionSS.x, 1) << i;
        EXPECT_LT(r.iterations, 200);
        ++found;
    }
    EXPECT_GT(found, 20);
}

// The steps that a ray may need: each pixel of its way once, and the way up and down the pyramid.
RC_GTEST_PROP(ShaderHizStability, IterationsAreBounded, ())
{
    const ivec2 size(*rc::gen::inRange(1, 60), *rc::gen::inRange(1, 60));
    const View view = makeView(vec2(size), kHalfFov, Real(0.1), 100, 1);
    std::vector<vec2> texels;
    for (int i = 0; i < size.x * size.y; ++i)
        texels.push_back(vec2(drawReal(1, 9)));
    buildPyramid(size, texels);
    // On edges and corners of cells as often as not, and along diagonals.
    const bool onEdge = *rc::gen::inRange(0, 2) == 1;
    vec2 startSS(drawReal(0, view.imageSize.x), drawReal(0, view.imageSize.y));
    if (onEdge) startSS = floor(startSS);
    const Real z = drawReal(Real(0.5), 10);
    const vec3 origin = positionWSFromSS(view, startSS, z);
    vec3 dir = drawUnitVector<vec3>();
    if (*rc::gen::inRange(0, 2) == 1) {
        const Real side = *rc::gen::inRange(0, 2) == 1 ? Real(1) : Real(-1);
        dir = positionWSFromSS(view, startSS + vec2(9, 9 * side), z + drawReal(-1, 1) * z / 2) - origin;
    }
    const TraceResult r = traceHiz(view, origin, dir, HizSettings(0, 99, 60000, drawReal(0, 1)));
    RC_ASSERT(r.reason != kHitReasonIterationCap);
    RC_ASSERT(r.iterations <= 4 * (size.x + size.y) + 40);
    RC_ASSERT(gBadReads == 0);
}

TEST(ShaderHizStability, ACameraMovedByAHundredthOfAPixelFlipsFewRays)
{
    const int width = 113, height = 64;
    const Shapes shapes = scaledRoom(1);
    std::vector<std::vector<int>> classes;
    for (Real yaw : {Real(0.1), Real(0.1) + Real(0.01) * 2 * kHalfFov / height}) {
        const View view = scaledView(1, width, height, yaw);
        const auto image = renderScene(view, shapes);
        std::vector<int>& row = classes.emplace_back();
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                const auto& seen = image[static_cast<size_t>(y * width + x)];
                if (!seen) {
                    row.push_back(0);
                    continue;
                }
                const MirrorRay ray = makeMirrorRay(view, shapes, *seen, x, y);
                row.push_back(traceHiz(view, ray.origin, ray.dir, fine()).hitClass);
            }
        }
    }
    int flips = 0;
    for (size_t i = 0; i < classes[0].size(); ++i)
        flips += classes[0][i] != classes[1][i];
    EXPECT_LT(flips, static_cast<int>(classes[0].size() / 100)) << "of " << classes[0].size();
}

TEST(ShaderHizStability, SixteenBitDepth)
{
    // Reversed 16-bit depth, near 0.1: steps of 0.2 mm at 1 m and 1.5 cm at 10 m, so that neighbours are noisy far
    // away.
    const View view = scaledView(1, 113, 64);
    const Shapes shapes = scaledRoom(1);
    const auto image = renderScene(view, shapes);
    std::vector<vec2> texels;
    for (const vec2& texel : gPyramid.levels[0].cells) {
        const Real device = deviceDepthFromLinear(view, texel.x);
        texels.push_back(makeDepthPyramidTexel(view, std::round(device * 65535) / 65535));
    }
    buildPyramid(ivec2(view.imageSize), texels);
    int answerable = 0, found = 0, falseHits = 0, rays = 0;
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 113; ++x) {
            const auto& seen = image[static_cast<size_t>(y * 113 + x)];
            if (!seen) continue;
            const MirrorRay ray = makeMirrorRay(view, shapes, *seen, x, y);
            const TraceResult r = traceHiz(view, ray.origin, ray.dir, fine());
            const bool hit = r.hitClass == kHitClassHit;
            ++rays;
            answerable += ray.answerable;
            found += hit && ray.answerable && length(r.positionSS - ray.truthSS) <= 2;
            falseHits += hit && !ray.answerable;
        }
    }
    EXPECT_GT(found, answerable * 94 / 100);
    EXPECT_LT(falseHits, (rays - answerable) * 4 / 100);
}
