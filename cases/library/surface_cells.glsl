// Made by tables.py: functions of the library on the rows of data/. Confidence is 1 where the row's answers are right; else HitDepth
// says which is wrong first (function * 100 + output, from 1), and HitPositionSS what it was and what was expected.

int wrongCheck = 0; // function * 100 + output, from 1, of the first wrong answer; what it was, and what was expected
vec2 wrongAnswer = vec2(0.0);

void check(int which, float answer, float expected, float relative, float absolute)
{
    bool isRight = abs(answer - expected) <= max(absolute, relative * abs(expected)); // false for a NaN
    bool isFirst = !isRight && wrongCheck == 0;
    wrongCheck = isFirst ? which : wrongCheck;
    wrongAnswer = isFirst ? vec2(answer, expected) : wrongAnswer;
}

float number(bool condition) { return condition ? 1.0 : 0.0; }

// Cameras of one place and turn: perspective and orthographic, standard and reversed depth; images of 64 x 48 pixels.
View tableView(bool orthographic, bool reversed)
{
    vec4 right = vec4(2.0, 2.0, -1.0, 0.0) / 3.0;
    vec4 up = vec4(-1.0, 2.0, 2.0, 0.0) / 3.0;
    vec4 back = vec4(2.0, -1.0, 2.0, 0.0) / 3.0;
    mat4 world = mat4(right, up, back, vec4(1.0, 2.0, 3.0, 1.0));
    mat4 view = transpose(mat4(right, up, back, vec4(0.0, 0.0, 0.0, 1.0)));
    view[3] = vec4(-(view * vec4(1.0, 2.0, 3.0, 0.0)).xyz, 1.0);
    float nearDistance = 0.5;
    float farDistance = 64.0;
    // Depth 0 at the near plane and 1 at the far one, and its mirror image.
    float b = orthographic ? 1.0 / 63.5 : -32.0 / 63.5;
    float a = orthographic ? -0.5 / 63.5 : 64.0 / 63.5;
    a = reversed ? 1.0 - a : a;
    b = reversed ? -b : b;
    vec2 slope = vec2(0.8, 0.5);
    float z = orthographic ? -1.0 : 0.0;
    mat4 clip = orthographic ? mat4(vec4(1.25, 0.0, 0.0, 0.0), vec4(0.0, 2.0, 0.0, 0.0), vec4(0.0, 0.0, -b, 0.0), vec4(0.0, 0.0, a, 1.0))
                             : mat4(vec4(1.25, 0.0, 0.0, 0.0), vec4(0.0, 2.0, 0.0, 0.0), vec4(0.0, 0.0, -a, -1.0), vec4(0.0, 0.0, b, 0.0));
    return View(view, world, clip, vec2(64.0, 48.0), slope, a, b, nearDistance, farDistance, orthographic, reversed);
}
#define kPatchExtent copyOf_kPatchExtent
#define kSurfaceRounding copyOf_kSurfaceRounding
#define packSurfaceCell copyOf_packSurfaceCell
#define unpackSurfaceCell copyOf_unpackSurfaceCell
#define isSky copyOf_isSky
#define makeSkySurface copyOf_makeSkySurface
#define computeCellRect copyOf_computeCellRect
#define computeRectCenter copyOf_computeRectCenter
#define surfaceAffineDepth copyOf_surfaceAffineDepth
#define computeFootprint copyOf_computeFootprint
#define computeNormalGradient copyOf_computeNormalGradient
#define clampGradient copyOf_clampGradient
#define chooseSlope copyOf_chooseSlope
#define fetchDeviceDepth copyOf_fetchDeviceDepth
#define fetchNormalWS copyOf_fetchNormalWS
#define fetchFinerSurface copyOf_fetchFinerSurface
#define finerSurfaceSize copyOf_finerSurfaceSize
#define computeNeighborRise copyOf_computeNeighborRise
#define buildSurfacePixel copyOf_buildSurfacePixel
#define loadFinerSurface copyOf_loadFinerSurface
#define computeRange copyOf_computeRange
#define joinRanges copyOf_joinRanges
#define makeCover copyOf_makeCover
#define coverFinerCells copyOf_coverFinerCells
#define chooseTighter copyOf_chooseTighter
#define reduceAnyCells copyOf_reduceAnyCells
#define coverFourCells copyOf_coverFourCells
#define reduceFourCells copyOf_reduceFourCells
#define reduceSurfaceCell copyOf_reduceSurfaceCell
#define SurfaceCell copyOf_SurfaceCell
#define CellRect copyOf_CellRect
#define NeighborRise copyOf_NeighborRise
#define FinerCells copyOf_FinerCells
#define FinerSurface copyOf_FinerSurface
#define SurfaceRange copyOf_SurfaceRange
#define FourSurfaces copyOf_FourSurfaces
#define CROSSRAY_BUILD_SURFACE_PYRAMID
#undef CROSSRAY_PROJECT_SURFACE_PYRAMID_GLSL
#include "crossray/project/surface_pyramid.glsl"

ivec2 tableSize = ivec2(7, 5);
ivec2 finerSurfaceSize(int level) { return tableSize; }
vec4 fetchFinerSurface(ivec2 cell, int level)
{
    int number = cell.x * 7 + cell.y * 5 + cell.x * cell.y * 3;
    ivec2 last = max(tableSize, ivec2(1)) - ivec2(1);
    vec2 center = vec2(cell.x == last.x ? 4 * cell.x + 3 : 4 * cell.x + 2, cell.y == last.y ? 4 * cell.y + 3 : 4 * cell.y + 2) * 0.5;
    vec2 strays = vec2(float(number * 3 % 11 - 5), float(number * 5 % 13 - 6)) * 0.0009765625;
    return vec4(0.5 + 0.03125 * center.x - 0.015625 * center.y, vec2(0.03125, -0.015625) + strays, 0.001953125 * float(number % 3));
}

bool tableOrthographic = false;
float tableShift = 0.0;
vec3 tableNormal = vec3(0.0);
float fetchDeviceDepth(ivec2 pixel)
{
    float affine = tableOrthographic ? tableShift - 8.0 + 0.03125 * float(pixel.x) - 0.0625 * float(pixel.y) : 0.25 + 0.00390625 * float(pixel.x) - 0.001953125 * float(pixel.y);
    return deviceDepthFromLinear(tableView(tableOrthographic, true), tableOrthographic ? -affine : 1.0 / affine);
}
vec3 fetchNormalWS(ivec2 pixel) { return tableNormal; }

void checkCover(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec3 d4 = ownNormalWS(ivec2(5, tableRow));
    int bx = int(d0.x);
    int by = int(d0.y);
    int ex = int(d0.z);
    int ey = int(d1.x);
    int l = int(d1.y);
    vec2 g = vec2(d1.z, d2.x);
    float low = d2.y;
    float high = d2.z;
    SurfaceCell c = makeCover(FinerCells(CellRect(ivec2(bx, by), ivec2(ex, ey)), ivec2(64), l, ivec2(512), vec2(0.0)), g, SurfaceRange(low, high));
    check(1, c.affineDepth, d3.x, 1e-05, 1e-10);
    check(2, c.gradient.x, d3.y, 1e-05, 1e-10);
    check(3, c.gradient.y, d3.z, 1e-05, 1e-10);
    check(4, c.slack, d4.x, 1e-05, 1e-10);
}

void checkReduce(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    int x = int(d0.x);
    int y = int(d0.y);
    int w = int(d0.z);
    int h = int(d1.x);
    int px = int(d1.y);
    int py = int(d1.z);
    tableSize = ivec2(w, h);
    vec4 c = reduceSurfaceCell(ivec2(x, y), 1, ivec2(px, py));
    check(101, c.x, d2.x, 1e-05, 4e-06);
    check(102, c.y, d2.y, 1e-05, 4e-06);
    check(103, c.z, d2.z, 1e-05, 4e-06);
    check(104, c.w, d3.x, 1e-05, 4e-06);
}

void checkSlopeEnds(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    float n = d0.x;
    bool h = d0.y > 0.5;
    float l = d0.z;
    float r = d1.x;
    float t = d1.y;
    check(201, chooseSlope(n, h, NeighborRise(-l, true), NeighborRise(r, true), t), d1.z, 1e-05, 0);
}

void checkEdgeOn(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 n = vec3(d0.x, d0.y, d0.z);
    vec2 g = computeNormalGradient(tableView(false, true), vec2(32.0, 24.0), 0.25, n);
    check(301, g.x, d1.x, 4e-05, 1e-06);
    check(302, g.y, d1.y, 4e-05, 1e-06);
}

void checkCorner(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    bool o = d0.x > 0.5;
    float shift = d0.y;
    int x = int(d0.z);
    int y = int(d1.x);
    vec3 n = vec3(d1.y, d1.z, d2.x);
    float e = d2.y;
    tableOrthographic = o;
    tableShift = shift;
    tableNormal = n;
    vec4 c = buildSurfacePixel(tableView(o, true), ivec2(x, y), e);
    check(401, c.x, d2.z, 4e-05, 1e-06);
    check(402, c.y, d3.x, 4e-05, 1e-06);
    check(403, c.z, d3.y, 4e-05, 1e-06);
    check(404, c.w, d3.z, 4e-05, 1e-06);
}

void checkTrusted(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    bool o = d0.x > 0.5;
    float shift = d0.y;
    int x = int(d0.z);
    int y = int(d1.x);
    vec3 n = vec3(d1.y, d1.z, d2.x);
    float e = d2.y;
    tableOrthographic = o;
    tableShift = shift;
    tableNormal = n;
    vec4 c = buildSurfacePixel(tableView(o, true), ivec2(x, y), e);
    check(501, c.x, d2.z, 0.001, 3e-05);
    check(502, c.y, d3.x, 0.001, 3e-05);
    check(503, c.z, d3.y, 0.001, 3e-05);
    check(504, c.w, d3.z, 0.001, 3e-05);
}

OwnHit traceOwn(OwnRay ray)
{
    int row = ray.pixel.y;
    if (row >= 0 && row <= 26) checkCover(row);
    if (row >= 27 && row <= 62) checkReduce(row);
    if (row >= 63 && row <= 70) checkSlopeEnds(row);
    if (row >= 71 && row <= 71) checkEdgeOn(row);
    if (row >= 72 && row <= 107) checkCorner(row);
    if (row >= 108 && row <= 188) checkTrusted(row);
    return OwnHit(kHitClassHit, kHitReasonNone, wrongAnswer, float(wrongCheck), number(wrongCheck == 0));
}
