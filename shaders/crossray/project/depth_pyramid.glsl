// The depth pyramid that screen-space tracers march: per cell the nearest and the farthest surface, as linear depth.
// Hooks (only for reduceDepthPyramidCell; a pass that reads the pyramid alone need not have them):
//     vec2 fetchFinerDepth(ivec2 cell)   (nearest, farthest) of a cell of the next finer level; the cell is inside it
//     ivec2 finerDepthSize()             cells of that level
//   They are asked for when CROSSRAY_REDUCE_DEPTH_PYRAMID is defined before the include.
// Source: Uludag 2014, "Hi-Z Screen-Space Cone-Traced Reflections"; the covering of odd sizes and the farthest depth
// are added here.
//
// Level 0 has the image's size, level l+1 half of level l, rounded down, at least 1. Where a size is odd, the last cell
// of the next level covers three texels, so that every texel is covered at every level: the cell of pixel p at level l
// is min(p >> l, size - 1), in whole numbers.
#ifndef CROSSRAY_PROJECT_DEPTH_PYRAMID_GLSL
#define CROSSRAY_PROJECT_DEPTH_PYRAMID_GLSL

#include "crossray/core/math.glsl"
#include "crossray/core/view.glsl"

// Metres: the depth of sky. As the nearest depth it stops no ray; as the farthest it keeps a cell that shows some sky
// from being passed behind in one step: a hidden ray is in sight again before the sky.
const float kSkyLinearDepth = 1e30;

// (nearest, farthest) of a pixel. Cleared, NaN and impossible values are sky.
vec2 makeDepthPyramidTexel(View view, float deviceDepth)
{
    float linearDepth = linearDepthFromDevice(view, deviceDepth);
    return choose(isClearedDepth(view, deviceDepth), vec2(kSkyLinearDepth), vec2(linearDepth));
}

// Cells of a level; sizes below 1 count as 1.
ivec2 computeDepthPyramidSize(ivec2 imageSize, int level)
{
    int shift = clamp(level, 0, 30);
    return max(ivec2(imageSize.x >> shift, imageSize.y >> shift), ivec2(1));
}

// Levels down to 1 x 1: floor(log2(larger side)) + 1.
int computeDepthPyramidLevelCount(ivec2 imageSize)
{
    int levels = 1;
    for (int side = max(imageSize.x, imageSize.y); side > 1; side = side >> 1) {
        levels = levels + 1;
    }
    return levels;
}

// The cell of a level that covers a pixel; pixels outside the image belong to the cell at its border.
ivec2 computeDepthPyramidCell(ivec2 pixel, int level, ivec2 levelSize)
{
    return clamp(ivec2(pixel.x >> level, pixel.y >> level), ivec2(0), levelSize - ivec2(1));
}

#ifdef CROSSRAY_REDUCE_DEPTH_PYRAMID
vec2 fetchFinerDepth(ivec2 cell);
ivec2 finerDepthSize();

// (nearest, farthest) of one cell from the 1 to 9 texels that it covers in the finer level.
vec2 reduceDepthPyramidCell(ivec2 cell)
{
    ivec2 finerSize = max(finerDepthSize(), ivec2(1));
    ivec2 size = max(ivec2(finerSize.x / 2, finerSize.y / 2), ivec2(1));
    ivec2 begin = ivec2(cell.x * 2, cell.y * 2);
    ivec2 end =
        ivec2(cell.x == size.x - 1 ? finerSize.x : begin.x + 2, cell.y == size.y - 1 ? finerSize.y : begin.y + 2);
    vec2 reduced = vec2(kSkyLinearDepth, 0.0);
    for (int y = begin.y; y < end.y; ++y) {
        for (int x = begin.x; x < end.x; ++x) {
            vec2 finer = fetchFinerDepth(ivec2(x, y));
            reduced = vec2(min(reduced.x, finer.x), max(reduced.y, finer.y));
        }
    }
    return reduced;
}
#endif

#endif
