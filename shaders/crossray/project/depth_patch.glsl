// The surface of one cell of the depth pyramid as a plane: its depth and slope from the cell and its neighbours.
// Hooks: vec2 fetchDepthPyramid(ivec2 cell, int level)   (nearest, farthest) linear depth, metres; see
// project/depth_pyramid.glsl
//        ivec2 depthPyramidSize(int level)               cells of a level
// Source: own. On a plane the affine depth (project/screen_ray.glsl) is affine over the screen, so that differences of
// neighbours give the plane exactly. At levels above 0 the nearest depths of a plane's cells lie in the same corner of
// each, and their differences give the slope just so.
#ifndef CROSSRAY_PROJECT_DEPTH_PATCH_GLSL
#define CROSSRAY_PROJECT_DEPTH_PATCH_GLSL

#include "crossray/project/depth_pyramid.glsl"
#include "crossray/project/screen_ray.glsl"

vec2 fetchDepthPyramid(ivec2 cell, int level);
ivec2 depthPyramidSize(int level);

// Pixels [begin, end) of a cell along one axis.
struct CellSpan {
    int begin;
    int end;
};

struct DepthPatch {
    vec2 centerSS;
    float affineDepth; // at the centre
    vec2 gradient;     // affine depth a pixel
};

// One step from a cell to a neighbour along an axis.
struct DepthDifference {
    float slope;  // affine depth a pixel, in the axis's direction
    bool isKnown; // both cells lie in the image and hold a surface
};

CellSpan computeCellSpan(int cell, int level, int cells, int pixels)
{
    return CellSpan(cell << level, cell >= cells - 1 ? pixels : (cell + 1) << level);
}

bool isSkyDepth(float nearestLinearDepth)
{
    return nearestLinearDepth < 0.5 * kSkyLinearDepth ? false : true;
}

// Nearest depth of the cell `offset` cells away along an axis (0 x, 1 y); sky outside the image.
float fetchNearestAlong(ivec2 cell, int axis, int offset, int level, ivec2 cells)
{
    ivec2 other = cell + (axis == 0 ? ivec2(offset, 0) : ivec2(0, offset));
    bool isInside = other.x >= 0 && other.y >= 0 && other.x < cells.x && other.y < cells.y;
    return isInside ? fetchDepthPyramid(other, level).x : kSkyLinearDepth;
}

// From the cell at `first` along the axis to the one after it. The nearest depth of a sloping cell lies at its border
// in the direction in which it comes nearer: so far apart are the two depths.
DepthDifference computeDepthDifference(View view, float firstDepth, float secondDepth, CellSpan first, CellSpan second)
{
    bool isKnown = !isSkyDepth(firstDepth) && !isSkyDepth(secondDepth);
    float rise = affineDepthFromLinear(view, secondDepth) - affineDepthFromLinear(view, firstDepth);
    int pixels = rise > 0.0 ? second.end - first.end : second.begin - first.begin;
    return DepthDifference(isKnown ? rise / float(max(pixels, 1)) : 0.0, isKnown);
}

// Slopes a pixel that differ by less than this are one surface that bends by less than about 45 degrees a pixel.
float computePatchBend(View view, float affineDepth)
{
    float footprint = 2.0 * view.slope.y / view.imageSize.y; // of a pixel: metres, or metres a metre of distance
    return footprint * (view.orthographic ? 1.0 : affineDepth);
}

bool agree(float a, float b, float bend)
{
    return abs(a - b) <= max(bend, a * b > 0.0 ? min(abs(a), abs(b)) : 0.0);
}

// Slope of the cell along one axis: the mean of both sides where they agree; else the flatter side, if it is no edge:
// flat enough, or going on beyond the neighbour. No side: 0.
float fitSlope(View view, ivec2 cell, int axis, int level, float depth, float bend)
{
    ivec2 cells = depthPyramidSize(level);
    ivec2 pixels = ivec2(view.imageSize);
    int place = axis == 0 ? cell.x : cell.y;
    int count = axis == 0 ? cells.x : cells.y;
    int side = axis == 0 ? pixels.x : pixels.y;
    float depthBefore = fetchNearestAlong(cell, axis, -1, level, cells);
    float depthAfter = fetchNearestAlong(cell, axis, 1, level, cells);
    CellSpan here = computeCellSpan(place, level, count, side);
    CellSpan spanBefore = computeCellSpan(place - 1, level, count, side);
    CellSpan spanAfter = computeCellSpan(place + 1, level, count, side);
    DepthDifference before = computeDepthDifference(view, depthBefore, depth, spanBefore, here);
    DepthDifference after = computeDepthDifference(view, depth, depthAfter, here, spanAfter);
    if (before.isKnown && after.isKnown && agree(before.slope, after.slope, bend)) {
        return 0.5 * (before.slope + after.slope);
    }
    if (!before.isKnown && !after.isKnown) return 0.0;

    bool takeBefore = before.isKnown && (!after.isKnown || abs(before.slope) < abs(after.slope));
    float slope = takeBefore ? before.slope : after.slope;
    if (abs(slope) <= 4.0 * bend) return slope;
    int direction = takeBefore ? -1 : 1;
    float depthBeyond = fetchNearestAlong(cell, axis, 2 * direction, level, cells);
    CellSpan spanBeyond = computeCellSpan(place + 2 * direction, level, count, side);
    DepthDifference beyond = computeDepthDifference(view, depthBeyond, depthBefore, spanBeyond, spanBefore);
    if (!takeBefore) beyond = computeDepthDifference(view, depthAfter, depthBeyond, spanAfter, spanBeyond);
    return beyond.isKnown && agree(beyond.slope, slope, bend) ? slope : 0.0;
}

// The plane of a cell whose nearest depth is given; it must hold a surface. 4 to 6 reads.
DepthPatch fitDepthPatch(View view, ivec2 cell, int level, float nearestLinearDepth)
{
    ivec2 cells = depthPyramidSize(level);
    CellSpan x = computeCellSpan(cell.x, level, cells.x, int(view.imageSize.x));
    CellSpan y = computeCellSpan(cell.y, level, cells.y, int(view.imageSize.y));
    float nearest = affineDepthFromLinear(view, nearestLinearDepth);
    float bend = computePatchBend(view, nearest);
    vec2 gradient = vec2(fitSlope(view, cell, 0, level, nearestLinearDepth, bend),
                         fitSlope(view, cell, 1, level, nearestLinearDepth, bend));
    // From the nearest pixel's centre, half a cell less half a pixel away, to the cell's.
    vec2 toCorner = 0.5 * vec2(float(x.end - x.begin - 1), float(y.end - y.begin - 1));
    vec2 centerSS = 0.5 * vec2(float(x.begin + x.end), float(y.begin + y.end));
    return DepthPatch(centerSS, nearest - dot(abs(gradient), toCorner), gradient);
}

float patchAffineDepth(DepthPatch patchOfCell, vec2 positionSS)
{
    return patchOfCell.affineDepth + dot(patchOfCell.gradient, positionSS - patchOfCell.centerSS);
}

#endif
