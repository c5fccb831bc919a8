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
#define fetchSurfaceCell copyOf_fetchSurfaceCell
#define surfacePyramidSize copyOf_surfacePyramidSize
#define surfacePyramidLevelCount copyOf_surfacePyramidLevelCount
#define recordPatchStep copyOf_recordPatchStep
#define kHiddenSamples copyOf_kHiddenSamples
#define kPatchStartLevel copyOf_kPatchStartLevel
#define kPatchTolerance copyOf_kPatchTolerance
#define kPatchStartTolerance copyOf_kPatchStartTolerance
#define kNoClearance copyOf_kNoClearance
#define computePixelEntry copyOf_computePixelEntry
#define computePixelBefore copyOf_computePixelBefore
#define fetchPixelSurface copyOf_fetchPixelSurface
#define pixelAffineDepth copyOf_pixelAffineDepth
#define liftAffineDepth copyOf_liftAffineDepth
#define makePatchWalk copyOf_makePatchWalk
#define positionInRect copyOf_positionInRect
#define computeFront copyOf_computeFront
#define enterPatchCell copyOf_enterPatchCell
#define computeExitPixel copyOf_computeExitPixel
#define computeGap copyOf_computeGap
#define computeClearance copyOf_computeClearance
#define doesSurfaceGoOn copyOf_doesSurfaceGoOn
#define makePixelHit copyOf_makePixelHit
#define testPixel copyOf_testPixel
#define computeFreePath copyOf_computeFreePath
#define chooseFinerLevel copyOf_chooseFinerLevel
#define chooseCoarserLevel copyOf_chooseCoarserLevel
#define descendPatch copyOf_descendPatch
#define computeConfidence copyOf_computeConfidence
#define makePatchStep copyOf_makePatchStep
#define makePatchEnd copyOf_makePatchEnd
#define makePatchHit copyOf_makePatchHit
#define tracePatches copyOf_tracePatches
#define PatchTracerSettings copyOf_PatchTracerSettings
#define PatchStep copyOf_PatchStep
#define PatchTraceResult copyOf_PatchTraceResult
#define HiddenStart copyOf_HiddenStart
#define PatchWalk copyOf_PatchWalk
#define PatchState copyOf_PatchState
#define PatchCell copyOf_PatchCell
#define PixelEntry copyOf_PixelEntry
#define PixelTest copyOf_PixelTest
#undef CROSSRAY_PROJECT_PATCH_TRACER_GLSL
#include "crossray/project/patch_tracer.glsl"

vec3 tablePlane = vec3(0.125, 0.0, 0.0); // affine depth at the corner of the image, and its change a pixel
float tableSlack = 0.0;
ivec2 spotA = ivec2(-9);
ivec2 spotB = ivec2(-9);
ivec2 spotC = ivec2(-9);
vec4 cellA = vec4(0.0);
vec4 cellB = vec4(0.0);
vec4 cellC = vec4(0.0);
ivec2 surfacePyramidSize(int level) { return max(ivec2(64 >> level, 48 >> level), ivec2(1)); }
int surfacePyramidLevelCount() { return 7; }
void recordPatchStep(PatchStep step) {}

vec4 fetchSurfaceCell(ivec2 cell, int level)
{
    vec2 center = (vec2(cell) + vec2(0.5)) * float(1 << level);
    vec4 found = vec4(tablePlane.x + dot(tablePlane.yz, center), tablePlane.yz, level == 0 ? tableSlack : 0.0009765625 * float(level));
    found = cell == spotC ? cellC : found;
    found = cell == spotB ? cellB : found;
    return cell == spotA ? cellA : found;
}

ivec2 whole(vec2 v) { return ivec2(int(v.x), int(v.y)); }
ScreenRay tableRay(vec2 start, vec2 delta, vec2 affine) { return ScreenRay(start, delta, 0.0, affine.x, affine.y, 7, 0); }

PatchWalk tableWalk(vec2 start, vec2 delta, vec4 affine, vec2 startPixel, bool stands, float error)
{
    return PatchWalk(tableRay(start, delta, affine.xy), tableRay(start, delta, affine.zw), whole(startPixel), stands, error);
}

CellRect tableRect(vec4 r) { return CellRect(whole(r.xy), whole(r.zw)); }
PatchCell tableCell(vec4 r, vec4 surface, vec2 s, vec2 front, bool byX)
{
    return PatchCell(whole(r.xy), tableRect(r), unpackSurfaceCell(surface), s.x, s.y, front.x, front.y, byX, false);
}

void checkEntry(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec2 start = vec2(d0.x, d0.y);
    vec2 delta = vec2(d0.z, d1.x);
    vec2 first = vec2(d1.y, d1.z);
    vec2 pixel = vec2(d2.x, d2.y);
    PatchWalk w = tableWalk(start, delta, vec4(0.0), first, false, 0.0);
    PixelEntry e = computePixelEntry(w, whole(pixel));
    check(1, e.s, d2.z, 1e-05, 1e-06);
    check(2, number(e.isByX), d3.x, 1e-05, 1e-06);
}

void checkBefore(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec2 delta = vec2(d0.x, d0.y);
    vec2 first = vec2(d0.z, d1.x);
    vec2 pixel = vec2(d1.y, d1.z);
    bool byX = d2.x > 0.5;
    vec2 p = vec2(computePixelBefore(tableWalk(vec2(8.5), delta, vec4(0.0), first, false, 0.0), whole(pixel), byX));
    check(101, p.x, d2.y, 1e-05, 1e-06);
    check(102, p.y, d2.z, 1e-05, 1e-06);
}

void checkExit(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec3 d4 = ownNormalWS(ivec2(5, tableRow));
    vec2 start = vec2(d0.x, d0.y);
    vec2 delta = vec2(d0.z, d1.x);
    vec4 rect = vec4(d1.y, d1.z, d2.x, d2.y);
    float leave = d2.z;
    bool byX = d3.x > 0.5;
    vec2 pixel = vec2(d3.y, d3.z);
    vec2 first = pixel;
    PatchWalk w = tableWalk(start, delta, vec4(0.0), first, false, 0.0);
    vec2 p = vec2(computeExitPixel(w, tableCell(rect, vec4(0.0), vec2(0.0, leave), vec2(0.0), byX), whole(pixel)));
    check(201, p.x, d4.x, 1e-05, 1e-06);
    check(202, p.y, d4.y, 1e-05, 1e-06);
}

void checkFiner(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec2 front = vec2(d0.x, d0.y);
    vec2 s = vec2(d0.z, d1.x);
    vec2 delta = vec2(d1.y, d1.z);
    float slack = d2.x;
    int level = int(d2.y);
    PatchWalk w = tableWalk(vec2(0.5), delta, vec4(0.0), vec2(0.0), false, 0.0);
    check(301, float(chooseFinerLevel(w, tableCell(vec4(0.0, 0.0, 8.0, 8.0), vec4(0.25, 0.0, 0.0, slack), s, front, false), level)), d2.z, 1e-05, 1e-06);
}

void checkCoarser(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    bool byX = d0.x > 0.5;
    vec2 next = vec2(d0.y, d0.z);
    vec2 delta = vec2(d1.x, d1.y);
    int level = int(d1.z);
    int high = int(d2.x);
    check(401, float(chooseCoarserLevel(tableCell(vec4(0.0), vec4(0.0), vec2(0.0), vec2(0.0), byX), whole(next), delta, level, high)), d2.y, 1e-05, 1e-06);
}

void checkDescend(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec3 d4 = ownNormalWS(ivec2(5, tableRow));
    vec3 d5 = ownNormalWS(ivec2(6, tableRow));
    vec3 d6 = ownNormalWS(ivec2(7, tableRow));
    vec3 d7 = ownNormalWS(ivec2(8, tableRow));
    vec3 d8 = ownNormalWS(ivec2(9, tableRow));
    vec3 d9 = ownNormalWS(ivec2(10, tableRow));
    vec2 start = vec2(d0.x, d0.y);
    vec2 delta = vec2(d0.z, d1.x);
    vec4 rect = vec4(d1.y, d1.z, d2.x, d2.y);
    vec4 surface = vec4(d2.z, d3.x, d3.y, d3.z);
    vec2 s = vec2(d4.x, d4.y);
    vec2 front = vec2(d4.z, d5.x);
    vec2 pixel = vec2(d5.y, d5.z);
    int level = int(d6.x);
    float free = d6.y;
    vec2 first = pixel;
    PatchWalk w = tableWalk(start, delta, vec4(0.0), first, false, 0.0);
    PatchState from = PatchState(whole(pixel), level, false, HiddenStart(ivec2(5, 6), 0.375), 0.875);
    PatchState n = descendPatch(w, tableCell(rect, surface, s, front, true), from, free);
    check(501, float(n.pixel.x), d6.z, 1e-05, 1e-06);
    check(502, float(n.pixel.y), d7.x, 1e-05, 1e-06);
    check(503, float(n.level), d7.y, 1e-05, 1e-06);
    check(504, number(n.inFront), d7.z, 1e-05, 1e-06);
    check(505, float(n.hidden.pixel.x), d8.x, 1e-05, 1e-06);
    check(506, float(n.hidden.pixel.y), d8.y, 1e-05, 1e-06);
    check(507, n.hidden.s, d8.z, 1e-05, 1e-06);
    check(508, n.clearance, d9.x, 1e-05, 1e-06);
}

void checkFree(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec3 d4 = ownNormalWS(ivec2(5, tableRow));
    vec3 d5 = ownNormalWS(ivec2(6, tableRow));
    vec2 lifted = vec2(d0.x, d0.y);
    vec4 rect = vec4(d0.z, d1.x, d1.y, d1.z);
    vec4 surface = vec4(d2.x, d2.y, d2.z, d3.x);
    vec2 s = vec2(d3.y, d3.z);
    vec2 front = vec2(d4.x, d4.y);
    bool inFront = d4.z > 0.5;
    PatchWalk w = tableWalk(vec2(8.5), vec2(4.0), vec4(100.0, 100.0, lifted), vec2(8.0), false, 0.0);
    check(601, min(computeFreePath(w, tableCell(rect, surface, s, front, false), inFront), 4.0), d5.x, 1e-06, 1e-06);
}

void checkEnter(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec3 d4 = ownNormalWS(ivec2(5, tableRow));
    vec3 d5 = ownNormalWS(ivec2(6, tableRow));
    vec3 d6 = ownNormalWS(ivec2(7, tableRow));
    vec3 d7 = ownNormalWS(ivec2(8, tableRow));
    vec3 d8 = ownNormalWS(ivec2(9, tableRow));
    vec3 d9 = ownNormalWS(ivec2(10, tableRow));
    vec3 d10 = ownNormalWS(ivec2(11, tableRow));
    bool o = d0.x > 0.5;
    vec2 start = vec2(d0.y, d0.z);
    vec2 delta = vec2(d1.x, d1.y);
    vec2 lifted = vec2(d1.z, d2.x);
    vec2 first = vec2(d2.y, d2.z);
    vec2 pixel = vec2(d3.x, d3.y);
    int level = int(d3.z);
    vec3 plane = vec3(d4.x, d4.y, d4.z);
    tablePlane = plane;
    PatchWalk w = tableWalk(start, delta, vec4(lifted + vec2(1.0), lifted), first, false, 0.0);
    PatchCell c = enterPatchCell(tableView(o, true), w, PatchState(whole(pixel), level, true, HiddenStart(whole(first), 0.0), kNoClearance));
    check(701, float(c.cell.x), d5.x, 1e-05, 1e-06);
    check(702, float(c.cell.y), d5.y, 1e-05, 1e-06);
    check(703, float(c.rect.begin.x), d5.z, 1e-05, 1e-06);
    check(704, float(c.rect.begin.y), d6.x, 1e-05, 1e-06);
    check(705, float(c.rect.end.x), d6.y, 1e-05, 1e-06);
    check(706, float(c.rect.end.y), d6.z, 1e-05, 1e-06);
    check(707, c.surface.affineDepth, d7.x, 1e-05, 1e-06);
    check(708, c.surface.gradient.x, d7.y, 1e-05, 1e-06);
    check(709, c.surface.gradient.y, d7.z, 1e-05, 1e-06);
    check(710, c.surface.slack, d8.x, 1e-05, 1e-06);
    check(711, c.enter, d8.y, 1e-05, 1e-06);
    check(712, c.leave, d8.z, 1e-05, 1e-06);
    check(713, c.frontAtEnter, d9.x, 1e-05, 1e-06);
    check(714, c.frontAtLeave, d9.y, 1e-05, 1e-06);
    check(715, number(c.leavesByX), d9.z, 1e-05, 1e-06);
    check(716, number(c.isLast), d10.x, 1e-05, 1e-06);
}

OwnHit traceOwn(OwnRay ray)
{
    int row = ray.pixel.y;
    if (row >= 0 && row <= 350) checkEntry(row);
    if (row >= 351 && row <= 392) checkBefore(row);
    if (row >= 393 && row <= 602) checkExit(row);
    if (row >= 603 && row <= 768) checkFiner(row);
    if (row >= 769 && row <= 1056) checkCoarser(row);
    if (row >= 1057 && row <= 1227) checkDescend(row);
    if (row >= 1228 && row <= 1345) checkFree(row);
    if (row >= 1346 && row <= 1527) checkEnter(row);
    return OwnHit(kHitClassHit, kHitReasonNone, wrongAnswer, float(wrongCheck), number(wrongCheck == 0));
}
