#include "tests/shader/generators.h"
#include "tests/shader/scene.h"

#include "harness/backend/cpu/glsl.h"

#define CROSSRAY_REDUCE_DEPTH_PYRAMID
#include "crossray/project/hiz.glsl"
#include "tests/shader/views.h"
#include "tests/shader/hiz_fixture.h"

#include "harness/backend/cpu/glsl_end.h"

using namespace CROSSRAY_SHADER_NAMESPACE;

// Every cell is the extreme of exactly the pixels that computeDepthPyramidCell gives it, and each pixel has one cell.
RC_GTEST_PROP(ShaderDepthPyramid, CoversEveryPixelAtEveryLevel, ())
{
    const ivec2 size(*rc::gen::inRange(1, 40), *rc::gen::inRange(1, 40));
    std::vector<vec2> texels;
    for (int i = 0; i < size.x * size.y; ++i) {
        texels.push_back(*rc::gen::inRange(0, 8) == 0 ? vec2(kSkyLinearDepth) : vec2(drawReal(1, 100)));
    }
    buildPyramid(size, texels);
    const int levels = depthPyramidLevelCount();
    RC_ASSERT(depthPyramidSize(levels - 1) == ivec2(1, 1));
    if (levels > 1) RC_ASSERT(!(depthPyramidSize(levels - 2) == ivec2(1, 1))); // RC_ASSERT evaluates both sides of ||
    for (int level = 0; level < levels; ++level) {
        const ivec2 cells = depthPyramidSize(level);
        std::vector<vec2> brute(static_cast<size_t>(cells.x * cells.y), vec2(kSkyLinearDepth, 0));
        for (int y = 0; y < size.y; ++y) {
            for (int x = 0; x < size.x; ++x) {
                const ivec2 cell = computeDepthPyramidCell(ivec2(x, y), level, cells);
                const CellSpan span = computeCellSpan(cell.x, level, cells.x, size.x);
                RC_ASSERT(span.begin <= x && x < span.end);
                vec2& b = brute[static_cast<size_t>(cell.y * cells.x + cell.x)];
                const vec2 texel = texels[static_cast<size_t>(y * size.x + x)];
                b = vec2(std::min(b.x, texel.x), std::max(b.y, texel.y));
            }
        }
        for (int y = 0; y < cells.y; ++y) {
            for (int x = 0; x < cells.x; ++x) {
                RC_ASSERT(fetchDepthPyramid(ivec2(x, y), level) == brute[static_cast<size_t>(y * cells.x + x)]);
            }
        }
    }
    RC_ASSERT(gBadReads == 0);
}

TEST(ShaderDepthPyramid, SkyIsFartherThanAnySurface)
{
    for (int depth = 0; depth < 3; ++depth) {
        View view = makeView(vec2(4, 4), Real(0.5), Real(0.1), 100, depth);
        const Real cleared = depth == 0 ? 1 : 0;
        EXPECT_TRUE(makeDepthPyramidTexel(view, cleared) == vec2(kSkyLinearDepth));
        EXPECT_TRUE(makeDepthPyramidTexel(view, kNaN) == vec2(kSkyLinearDepth));
        const vec2 texel = makeDepthPyramidTexel(view, deviceDepthFromLinear(view, 5));
        EXPECT_NEAR(texel.x, 5, 1000 * kUlps);
        EXPECT_EQ(texel.x, texel.y);
    }
    EXPECT_EQ(computeDepthPyramidLevelCount(ivec2(0, -3)), 1);
    EXPECT_EQ(computeDepthPyramidLevelCount(ivec2(1920, 1080)), 11);
    EXPECT_TRUE(computeDepthPyramidSize(ivec2(1920, 3), 40) == ivec2(1, 1));
}

// On a plane the patch of any cell of any level is the plane: its affine depth agrees everywhere on screen.
RC_GTEST_PROP(ShaderDepthPatch, IsExactOnPlanes, ())
{
    const ivec2 size(*rc::gen::inRange(3, 50), *rc::gen::inRange(3, 50));
    const bool orthographic = *rc::gen::inRange(0, 2) == 1;
    const View view = makeView(vec2(size), Real(0.5), Real(0.1), 1000, 1, orthographic);
    // Affine depth a + b.x*x + b.y*y that stays positive (perspective) or negative (orthographic).
    const Real start = drawReal(Real(0.1), 1);
    const vec2 slope =
        vec2(drawReal(0, 1) / static_cast<Real>(size.x), drawReal(0, 1) / static_cast<Real>(size.y)) * Real(5);
    const bool flipX = *rc::gen::inRange(0, 2) == 1;
    const auto affineAt = [&](vec2 p) {
        const Real a = start + slope.x * (flipX ? static_cast<Real>(size.x) - p.x : p.x) + slope.y * p.y;
        return orthographic ? a - 20 : a;
    };
    std::vector<vec2> texels;
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) {
            texels.push_back(
                vec2(linearDepthFromAffine(view.orthographic, affineAt(vec2(ivec2(x, y)) + vec2(Real(0.5))))));
        }
    }
    buildPyramid(size, texels);
    const int level = *rc::gen::inRange(0, depthPyramidLevelCount());
    const ivec2 cells = depthPyramidSize(level);
    RC_PRE(cells.x > 2 && cells.y > 2); // two cells cannot tell a steep plane from an edge
    const ivec2 cell(*rc::gen::inRange(0, cells.x), *rc::gen::inRange(0, cells.y));
    const DepthPatch patch =
        fitDepthPatch(makeScreenFrame(view), cell, level, fetchDepthPyramid(cell, level).x, vec2(0));
    const vec2 probe(drawReal(0, static_cast<Real>(size.x)), drawReal(0, static_cast<Real>(size.y)));
    RC_ASSERT(std::fabs(patchAffineDepth(patch, probe) - affineAt(probe)) < 60 * kUlps * 50);
    RC_ASSERT(gBadReads == 0);
}
