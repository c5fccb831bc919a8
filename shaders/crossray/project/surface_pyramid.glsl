// The pyramid that project/patch_tracer.glsl marches: level 0 holds the surface of each pixel as a plane, a coarser
// cell one plane and how far the planes under it stray from it. A floor or a wall fills a large cell without straying,
// so that a ray that leaves it, or runs along it, passes it in a few steps, and one that nears it goes straight to the
// pixel where it meets it; a pyramid of nearest and farthest depths must look closer all along.
// Hooks, asked for when CROSSRAY_BUILD_SURFACE_PYRAMID is defined before the include (a pass that only reads the
// pyramid needs none):
//     float fetchDeviceDepth(ivec2 pixel)     as stored; the pixel is in the image
//     vec3 fetchNormalWS(ivec2 pixel)         of any length; zero or NaN where there is none
//     vec4 fetchFinerSurface(ivec2 cell, int level)   packed cell of a finer level
//     ivec2 finerSurfaceSize(int level)       cells of that level
// Source: own. On a plane the affine depth (project/screen_ray.glsl) is affine over the screen: it is a number and a
// gradient. Sizes and the covering of odd sizes are those of project/depth_pyramid.glsl.
#ifndef CROSSRAY_PROJECT_SURFACE_PYRAMID_GLSL
#define CROSSRAY_PROJECT_SURFACE_PYRAMID_GLSL

#include "crossray/project/depth_pyramid.glsl"
#include "crossray/project/screen_ray.glsl"

// All surfaces of a cell have an affine depth within slack of affineDepth + dot(gradient, positionSS - centre).
struct SurfaceCell {
    float affineDepth; // at the cell's centre
    vec2 gradient;     // affine depth a pixel
    float slack;       // level 0: 0, and -1 where the pixel shows no surface
};

// Pixels [begin, end).
struct CellRect {
    ivec2 begin;
    ivec2 end;
};

// The farthest share of its depth by which the plane of a pixel may rise or fall at the pixel's border. Surfaces seen
// edge-on are no planes of a pixel's size: nothing is known of them half a pixel beyond their silhouette.
const float kPatchExtent = 0.03;
// Rounding of a cell's bound, as a share of what is added up.
const float kSurfaceRounding = 1e-6;

vec4 packSurfaceCell(SurfaceCell cell)
{
    return vec4(cell.affineDepth, cell.gradient, cell.slack);
}

SurfaceCell unpackSurfaceCell(vec4 packedCell)
{
    return SurfaceCell(packedCell.x, packedCell.yz, packedCell.w);
}

bool isSky(SurfaceCell cell)
{
    return cell.slack < 0.0;
}

// Farther than any ray goes.
SurfaceCell makeSkySurface(View view)
{
    return SurfaceCell(view.orthographic ? -2.0 * view.farDistance : 0.0, vec2(0.0), -1.0);
}

CellRect computeCellRect(ivec2 cell, int level, ivec2 cells, ivec2 pixels)
{
    return CellRect(ivec2(cell.x << level, cell.y << level),
                    ivec2(cell.x >= cells.x - 1 ? pixels.x : (cell.x + 1) << level,
                          cell.y >= cells.y - 1 ? pixels.y : (cell.y + 1) << level));
}

vec2 computeRectCenter(CellRect rect)
{
    return 0.5 * vec2(rect.begin + rect.end);
}

float surfaceAffineDepth(SurfaceCell cell, vec2 centerSS, vec2 positionSS)
{
    return cell.affineDepth + dot(cell.gradient, positionSS - centerSS);
}

// Affine depth a pixel of a surface that the eye sees under 45 degrees.
float computeFootprint(View view, float affineDepth)
{
    return 2.0 * view.slope.y / view.imageSize.y * (view.orthographic ? 1.0 : affineDepth);
}

// Gradient of the plane with this normal (view space, unit) through a pixel's centre; it may be as steep as it likes.
vec2 computeNormalGradient(View view, vec2 centerSS, float affineDepth, vec3 normalVS)
{
    vec2 slope = positionNDCFromSS(view, centerSS) * view.slope; // of the view ray
    float facing = view.orthographic ? -normalVS.z : normalVS.x * slope.x + normalVS.y * slope.y - normalVS.z;
    // Towards the eye, whichever side the normal is on; edge-on becomes steep.
    float against = -max(abs(facing), 1e-6) * (facing > 0.0 ? -1.0 : 1.0);
    vec2 scale = vec2(2.0, -2.0) * view.slope / view.imageSize;
    return normalVS.xy * scale * ((view.orthographic ? 1.0 : affineDepth) / against);
}

// Makes a plane no steeper at a pixel's border than kPatchExtent.
vec2 clampGradient(vec2 gradient, float affineDepth)
{
    float extent = 0.5 * (abs(gradient.x) + abs(gradient.y));
    float limit = kPatchExtent * abs(affineDepth);
    return extent > limit ? gradient * (limit / extent) : gradient;
}

// Affine depth of one neighbour less that of the pixel.
struct NeighborRise {
    float rise;
    bool isKnown; // in the image, and a surface
};

// The slope along one axis. Where both sides are known, the normal is taken at its word as far as it lies between the
// slopes of the two sides: a normal map or a smoothed normal that says otherwise is no geometry. Then the mean counts
// where the sides agree, else the flatter one: the other is an edge.
float chooseSlope(float fromNormal, bool hasNormal, NeighborRise before, NeighborRise after, float tolerance)
{
    if (!before.isKnown || !after.isKnown) {
        float known = before.isKnown ? -before.rise : (after.isKnown ? after.rise : 0.0);
        return hasNormal ? fromNormal : known;
    }
    float left = -before.rise;
    float right = after.rise;
    if (hasNormal && fromNormal >= min(left, right) - tolerance && fromNormal <= max(left, right) + tolerance) {
        return fromNormal;
    }
    bool agree = abs(left - right) <= max(tolerance, left * right > 0.0 ? min(abs(left), abs(right)) : 0.0);
    return agree ? 0.5 * (left + right) : (abs(left) < abs(right) ? left : right);
}

#ifdef CROSSRAY_BUILD_SURFACE_PYRAMID
float fetchDeviceDepth(ivec2 pixel);
vec3 fetchNormalWS(ivec2 pixel);
vec4 fetchFinerSurface(ivec2 cell, int level);
ivec2 finerSurfaceSize(int level);

NeighborRise computeNeighborRise(View view, ivec2 neighbor, float affineDepth)
{
    ivec2 size = ivec2(view.imageSize);
    if (neighbor.x < 0 || neighbor.y < 0 || neighbor.x >= size.x || neighbor.y >= size.y) {
        return NeighborRise(0.0, false);
    }
    float deviceDepth = fetchDeviceDepth(neighbor);
    float rise = affineDepthFromLinear(view.orthographic, linearDepthFromDevice(view, deviceDepth)) - affineDepth;
    return NeighborRise(rise, !isClearedDepth(view, deviceDepth));
}

// Level 0, packed. depthError: by how much a stored affine depth may be wrong (PatchTracerSettings).
vec4 buildSurfacePixel(View view, ivec2 pixel, float depthError)
{
    float deviceDepth = fetchDeviceDepth(pixel);
    if (isClearedDepth(view, deviceDepth)) return packSurfaceCell(makeSkySurface(view));
    float affineDepth = affineDepthFromLinear(view.orthographic, linearDepthFromDevice(view, deviceDepth));
    vec3 normalWS = fetchNormalWS(pixel);
    bool hasNormal = hasDirection(normalWS);
    vec3 normalVS = safeNormalize(directionVSFromWS(view, normalWS), vec3(0.0, 0.0, 1.0));
    vec2 fromNormal = computeNormalGradient(view, vec2(pixel) + 0.5, affineDepth, normalVS);
    float tolerance =
        0.05 * computeFootprint(view, affineDepth) + 2.0 * depthError + kSurfaceRounding * abs(affineDepth);
    NeighborRise left = computeNeighborRise(view, pixel - ivec2(1, 0), affineDepth);
    NeighborRise right = computeNeighborRise(view, pixel + ivec2(1, 0), affineDepth);
    NeighborRise above = computeNeighborRise(view, pixel - ivec2(0, 1), affineDepth);
    NeighborRise below = computeNeighborRise(view, pixel + ivec2(0, 1), affineDepth);
    vec2 gradient = vec2(chooseSlope(fromNormal.x, hasNormal, left, right, tolerance),
                         chooseSlope(fromNormal.y, hasNormal, above, below, tolerance));
    return packSurfaceCell(SurfaceCell(affineDepth, clampGradient(gradient, affineDepth), 0.0));
}

// Finer cells [begin, end) of a cell, and their level's size.
struct FinerCells {
    CellRect cells;
    ivec2 size;
    int level;
    ivec2 pixels;
    vec2 centerSS; // of the cell over them
};

// One of them: its surface, the way from its centre to that of the cell over it, and its own size, pixels.
struct FinerSurface {
    SurfaceCell surface;
    vec2 toCenter;
    vec2 extent;
};

// Affine depths at a cell's centre between which a plane of some gradient must lie to touch what is below.
struct SurfaceRange {
    float low;
    float high;
};

FinerSurface loadFinerSurface(FinerCells finer, ivec2 cell)
{
    CellRect rect = computeCellRect(cell, finer.level, finer.size, finer.pixels);
    return FinerSurface(unpackSurfaceCell(fetchFinerSurface(cell, finer.level)),
                        finer.centerSS - computeRectCenter(rect), vec2(rect.end - rect.begin));
}

SurfaceRange computeRange(FinerSurface finer, vec2 gradient)
{
    float middle = finer.surface.affineDepth + dot(gradient, finer.toCenter);
    vec2 tilt = abs(finer.surface.gradient - gradient);
    float reach = max(finer.surface.slack, 0.0) + 0.5 * dot(tilt, finer.extent);
    return SurfaceRange(middle - reach, middle + reach);
}

SurfaceRange joinRanges(SurfaceRange a, SurfaceRange b)
{
    return SurfaceRange(min(a.low, b.low), max(a.high, b.high));
}

SurfaceCell makeCover(FinerCells finer, vec2 gradient, SurfaceRange range)
{
    float size = float(finer.cells.end.x - finer.cells.begin.x + finer.cells.end.y - finer.cells.begin.y);
    float terms =
        abs(range.low) + abs(range.high) + (abs(gradient.x) + abs(gradient.y)) * size * float(1 << finer.level);
    return SurfaceCell(0.5 * (range.low + range.high), gradient,
                       0.5 * (range.high - range.low) + kSurfaceRounding * terms);
}

// The tightest cell that has this gradient: the range of what the finer cells reach, seen from the plane.
SurfaceCell coverFinerCells(FinerCells finer, vec2 gradient)
{
    SurfaceRange range = SurfaceRange(1e30, -1e30);
    for (int y = finer.cells.begin.y; y < finer.cells.end.y; ++y) {
        for (int x = finer.cells.begin.x; x < finer.cells.end.x; ++x)
            range = joinRanges(range, computeRange(loadFinerSurface(finer, ivec2(x, y)), gradient));
    }
    return makeCover(finer, gradient, range);
}

SurfaceCell chooseTighter(SurfaceCell best, SurfaceCell other)
{
    bool isTighter = other.slack < best.slack;
    return SurfaceCell(isTighter ? other.affineDepth : best.affineDepth, isTighter ? other.gradient : best.gradient,
                       isTighter ? other.slack : best.slack);
}

// At the borders of odd sizes: 1 to 9 cells.
SurfaceCell reduceAnyCells(FinerCells finer)
{
    SurfaceCell best = coverFinerCells(finer, vec2(0.0));
    vec2 sum = vec2(0.0);
    for (int y = finer.cells.begin.y; y < finer.cells.end.y; ++y) {
        for (int x = finer.cells.begin.x; x < finer.cells.end.x; ++x) {
            vec2 gradient = unpackSurfaceCell(fetchFinerSurface(ivec2(x, y), finer.level)).gradient;
            best = chooseTighter(best, coverFinerCells(finer, gradient));
            sum = sum + gradient;
        }
    }
    ivec2 count = finer.cells.end - finer.cells.begin;
    return chooseTighter(best, coverFinerCells(finer, sum / float(count.x * count.y)));
}

// Four cells, nearly everywhere; each is read once.
struct FourSurfaces {
    FinerSurface a;
    FinerSurface b;
    FinerSurface c;
    FinerSurface d;
};

SurfaceCell coverFourCells(FinerCells finer, FourSurfaces four, vec2 gradient)
{
    SurfaceRange above = joinRanges(computeRange(four.a, gradient), computeRange(four.b, gradient));
    SurfaceRange below = joinRanges(computeRange(four.c, gradient), computeRange(four.d, gradient));
    return makeCover(finer, gradient, joinRanges(above, below));
}

SurfaceCell reduceFourCells(FinerCells finer)
{
    ivec2 begin = finer.cells.begin;
    FourSurfaces four =
        FourSurfaces(loadFinerSurface(finer, begin), loadFinerSurface(finer, begin + ivec2(1, 0)),
                     loadFinerSurface(finer, begin + ivec2(0, 1)), loadFinerSurface(finer, begin + ivec2(1, 1)));
    SurfaceCell best = coverFourCells(finer, four, vec2(0.0));
    best = chooseTighter(best, coverFourCells(finer, four, four.a.surface.gradient));
    best = chooseTighter(best, coverFourCells(finer, four, four.b.surface.gradient));
    best = chooseTighter(best, coverFourCells(finer, four, four.c.surface.gradient));
    best = chooseTighter(best, coverFourCells(finer, four, four.d.surface.gradient));
    vec2 sum = four.a.surface.gradient + four.b.surface.gradient + four.c.surface.gradient + four.d.surface.gradient;
    return chooseTighter(best, coverFourCells(finer, four, sum / 4.0));
}

// A cell of a level above 0, packed, from the 1 to 9 cells that it covers in the next finer level, whose number is
// finerLevel. It takes the gradient that strays least: one of theirs, their mean, or none.
vec4 reduceSurfaceCell(ivec2 cell, int finerLevel, ivec2 imageSize)
{
    ivec2 finerSize = max(finerSurfaceSize(finerLevel), ivec2(1));
    ivec2 size = max(ivec2(finerSize.x / 2, finerSize.y / 2), ivec2(1));
    ivec2 begin = ivec2(cell.x * 2, cell.y * 2);
    ivec2 end =
        ivec2(cell.x == size.x - 1 ? finerSize.x : begin.x + 2, cell.y == size.y - 1 ? finerSize.y : begin.y + 2);
    vec2 centerSS = computeRectCenter(computeCellRect(cell, finerLevel + 1, size, imageSize));
    FinerCells finer = FinerCells(CellRect(begin, end), finerSize, finerLevel, imageSize, centerSS);
    bool isFour = end.x - begin.x == 2 && end.y - begin.y == 2;
    SurfaceCell best;
    if (isFour) {
        best = reduceFourCells(finer);
    } else {
        best = reduceAnyCells(finer);
    }
    return packSurfaceCell(best);
}
#endif

#endif
