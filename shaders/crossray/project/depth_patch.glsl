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
    float slope;  // affine depth a pixel, in the axis's direction; 0 where it is not known
    bool isKnown; // both cells lie in the image and hold a surface
};

CellSpan computeCellSpan(int cell, int level, int cells, int pixels)
{
    return CellSpan(cell << level, choose(cell >= cells - 1, pixels, (cell + 1) << level));
}

bool isSkyDepth(float nearestLinearDepth)
{
    bool isSurface = nearestLinearDepth < 0.5 * kSkyLinearDepth;
    return isSurface ? false : true;
}

// Nearest depth of a cell; sky outside the image.
float fetchNearest(ivec2 cell, int level, ivec2 cells)
{
    ivec2 inside = clamp(cell, ivec2(0), cells - ivec2(1));
    float nearest = fetchDepthPyramid(inside, level).x;
    return choose(all(equal(cell, inside)), nearest, kSkyLinearDepth);
}

// From one cell to the next along an axis. The nearest depth of a sloping cell lies at its border in the direction in
// which it comes nearer: so far apart are the two depths.
DepthDifference computeDepthDifference(bool orthographic, float firstDepth, float secondDepth, CellSpan first,
                                       CellSpan second)
{
    bool isEdge = isSkyDepth(firstDepth) || isSkyDepth(secondDepth);
    float rise = affineDepthFromLinear(orthographic, secondDepth) - affineDepthFromLinear(orthographic, firstDepth);
    int pixels = choose(rise > 0.0, second.end - first.end, second.begin - first.begin);
    float slope = rise / float(max(pixels, 1));
    return DepthDifference(choose(isEdge, 0.0, slope), !isEdge);
}

// By so much of itself a bound is wider than it says: depths in whole numbers have slopes in whole steps, and one of
// them is often just twice its neighbour. A rounding must not decide that.
const float kTieTolerance = 0.00390625; // 2^-8

// Two slopes of one surface: they differ by at most `bend`, or by at most the flatter one, with the same sign.
bool agree(float a, float b, float bend)
{
    float flatter = choose(a * b > 0.0, min(abs(a), abs(b)), 0.0);
    return abs(a - b) <= max(bend, flatter) * (1.0 + kTieTolerance);
}

// Slope of a cell along one axis (0 x, 1 y). Where the two sides differ, the side that goes on straight beyond its
// neighbour is the surface's own, and the other runs over a corner or an edge (the choice of the smoothest stencil:
// Harten, Engquist, Osher and Chakravarthy 1987, "Uniformly high order accurate essentially non-oscillatory schemes").
// Where neither does, the mean of both where they agree; else the flatter side, if it is no edge: flat enough, or going
// on beyond the neighbour. No side: 0. A `favour` other than 0 takes, where the sides part and neither is straight, the
// one that falls away in its direction.
float fitSlope(ScreenFrame frame, ivec2 cell, int axis, int level, float depth, float bend, float favour)
{
    ivec2 cells = depthPyramidSize(level);
    bool isX = axis == 0;
    ivec2 along = choose(isX, ivec2(1, 0), ivec2(0, 1));
    int place = choose(isX, cell.x, cell.y);
    int count = choose(isX, cells.x, cells.y);
    int side = choose(isX, frame.imageSize.x, frame.imageSize.y);
    CellSpan here = computeCellSpan(place, level, count, side);
    CellSpan spanBefore = computeCellSpan(place - 1, level, count, side);
    CellSpan spanAfter = computeCellSpan(place + 1, level, count, side);
    float depthBefore = fetchNearest(cell - along, level, cells);
    float depthAfter = fetchNearest(cell + along, level, cells);
    DepthDifference before = computeDepthDifference(frame.orthographic, depthBefore, depth, spanBefore, here);
    DepthDifference after = computeDepthDifference(frame.orthographic, depth, depthAfter, here, spanAfter);
    bool isBetween = before.isKnown && after.isKnown;
    bool isParallel = agree(before.slope, after.slope, bend);
    bool isSmooth = isBetween && isParallel;

    bool isFavoured = abs(favour) > 0.0;
    bool isFlatter = abs(before.slope) < abs(after.slope);
    bool isFalling = before.slope * favour < after.slope * favour;
    bool isBetter = isFavoured ? isFalling : isFlatter;
    bool isOnly = !after.isKnown;
    bool isTaken = isOnly || isBetter;
    bool takeBefore = before.isKnown && isTaken;
    float slope = choose(takeBefore, before.slope, after.slope);
    bool isFlat = abs(slope) <= 4.0 * bend;
    bool isCertain = isSmooth || isFlat;
    bool isSure = isCertain || isFavoured;
    slope = choose(isSmooth, 0.5 * (before.slope + after.slope), slope);
    float difference = abs(after.slope - before.slope);
    bool isPlane = isBetween && difference <= 0.0625 * bend;
    if (!isPlane) {
        DepthDifference beyondBefore =
            computeDepthDifference(frame.orthographic, fetchNearest(cell - along * 2, level, cells), depthBefore,
                                   computeCellSpan(place - 2, level, count, side), spanBefore);
        DepthDifference beyondAfter =
            computeDepthDifference(frame.orthographic, depthAfter, fetchNearest(cell + along * 2, level, cells),
                                   spanAfter, computeCellSpan(place + 2, level, count, side));
        bool knowsBefore = before.isKnown && beyondBefore.isKnown;
        bool knowsAfter = after.isKnown && beyondAfter.isKnown;
        float bendBefore = choose(knowsBefore, abs(before.slope - beyondBefore.slope), 1e30);
        float bendAfter = choose(knowsAfter, abs(beyondAfter.slope - after.slope), 1e30);
        bool isStraight = min(bendBefore, bendAfter) < 0.25 * difference;
        bool hasChoice = isBetween && isStraight;
        float straight = choose(bendBefore <= bendAfter, before.slope, after.slope);
        // The side taken above, where it must prove itself.
        float beyondSlope = choose(takeBefore, beyondBefore.slope, beyondAfter.slope);
        bool isKnownBeyond = (takeBefore && knowsBefore) || (!takeBefore && knowsAfter);
        bool isParallelBeyond = agree(beyondSlope, slope, bend);
        bool goesOn = isKnownBeyond && isParallelBeyond;
        bool stays = isSure || goesOn;
        slope = choose(hasChoice, straight, choose(stays, slope, 0.0));
    }
    return slope;
}

// The plane of a cell whose nearest depth is given; it must hold a surface. 4 to 8 reads. `favourSS`: a direction in
// which the plane falls away where its sides leave the choice; 0 for the flatter side.
DepthPatch fitDepthPatch(ScreenFrame frame, ivec2 cell, int level, float nearestLinearDepth, vec2 favourSS)
{
    ivec2 cells = depthPyramidSize(level);
    CellSpan x = computeCellSpan(cell.x, level, cells.x, frame.imageSize.x);
    CellSpan y = computeCellSpan(cell.y, level, cells.y, frame.imageSize.y);
    float nearest = affineDepthFromLinear(frame.orthographic, nearestLinearDepth);
    // Slopes that differ by less are one surface that bends by less than about 45 degrees a pixel.
    float bend = frame.footprint * choose(frame.orthographic, 1.0, nearest);
    vec2 gradient = vec2(0.0);
    for (int axis = 0; axis < 2; ++axis) { // a loop, and not two calls: half the code for the driver to compile
        float favour = choose(axis == 0, favourSS.x, favourSS.y);
        float slope = fitSlope(frame, cell, axis, level, nearestLinearDepth, bend, favour);
        gradient = choose(axis == 0, vec2(slope, 0.0), vec2(gradient.x, slope));
    }
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
