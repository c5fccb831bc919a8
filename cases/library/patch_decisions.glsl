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

void checkSettle(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec3 d4 = ownNormalWS(ivec2(5, tableRow));
    vec3 d5 = ownNormalWS(ivec2(6, tableRow));
    vec3 d6 = ownNormalWS(ivec2(7, tableRow));
    vec2 start = vec2(d0.x, d0.y);
    vec2 delta = vec2(d0.z, d1.x);
    vec2 affine = vec2(d1.y, d1.z);
    vec2 first = vec2(d2.x, d2.y);
    vec4 surface = vec4(d2.z, d3.x, d3.y, d3.z);
    float error = d4.x;
    spotA = whole(first);
    cellA = surface;
    PatchWalk w = makePatchWalk(tableRay(start, delta, affine), whole(first), error);
    check(1, w.ray.startAffineDepth, d4.y, 1e-06, 0.002);
    check(2, w.ray.deltaAffineDepth, d4.z, 1e-06, 0.002);
    check(3, w.lifted.startAffineDepth * 16384.0, d5.x, 1e-06, 0.002);
    check(4, w.lifted.deltaAffineDepth * 16384.0, d5.y, 1e-06, 0.002);
    check(5, number(w.stands), d5.z, 1e-06, 0.002);
    check(6, w.depthError, d6.x, 1e-06, 0.002);
    check(7, float(w.startPixel.x), d6.y, 1e-06, 0.002);
    check(8, float(w.startPixel.y), d6.z, 1e-06, 0.002);
}

void checkClearance(int tableRow)
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
    vec3 d11 = ownNormalWS(ivec2(12, tableRow));
    bool o = d0.x > 0.5;
    vec2 start = vec2(d0.y, d0.z);
    vec2 delta = vec2(d1.x, d1.y);
    vec2 affine = vec2(d1.z, d2.x);
    vec2 from = vec2(d2.y, d2.z);
    float fromS = d3.x;
    vec2 last = vec2(d3.y, d3.z);
    float s = d4.x;
    vec3 plane = vec3(d4.y, d4.z, d5.x);
    vec4 a = vec4(d5.y, d5.z, d6.x, d6.y);
    vec2 a2 = vec2(d6.z, d7.x);
    vec4 b = vec4(d7.y, d7.z, d8.x, d8.y);
    vec2 b2 = vec2(d8.z, d9.x);
    vec4 c = vec4(d9.y, d9.z, d10.x, d10.y);
    vec2 c2 = vec2(d10.z, d11.x);
    spotA = whole(a.xy);
    spotB = whole(b.xy);
    spotC = whole(c.xy);
    cellA = vec4(a.zw, a2);
    cellB = vec4(b.zw, b2);
    cellC = vec4(c.zw, c2);
    tablePlane = plane;
    PatchWalk w = tableWalk(start, delta, vec4(affine, 7.0, 8.0), vec2(8.0), false, 0.0);
    check(101, computeClearance(tableView(o, true), w, HiddenStart(whole(from), fromS), whole(last), s), d11.y, 0.0001, 1e-06);
}

void checkGoesOn(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec3 d4 = ownNormalWS(ivec2(5, tableRow));
    vec3 d5 = ownNormalWS(ivec2(6, tableRow));
    vec3 d6 = ownNormalWS(ivec2(7, tableRow));
    vec3 d7 = ownNormalWS(ivec2(8, tableRow));
    vec2 start = vec2(d0.x, d0.y);
    vec2 delta = vec2(d0.z, d1.x);
    vec2 affine = vec2(d1.y, d1.z);
    vec2 first = vec2(d2.x, d2.y);
    float error = d2.z;
    vec2 pixel = vec2(d3.x, d3.y);
    float s = d3.z;
    bool byX = d4.x > 0.5;
    vec4 surface = vec4(d4.y, d4.z, d5.x, d5.y);
    float front = d5.z;
    vec4 other = vec4(d6.x, d6.y, d6.z, d7.x);
    tablePlane = other.xyz;
    tableSlack = other.w;
    PatchWalk w = tableWalk(start, delta, vec4(affine, 7.0, 8.0), first, false, error);
    spotA = computePixelBefore(w, whole(pixel), byX);
    cellA = other;
    check(201, number(doesSurfaceGoOn(w, tableCell(vec4(pixel, pixel + vec2(1.0)), surface, vec2(s, 1.0), vec2(front, 5.0), false), whole(pixel), PixelEntry(s, byX))), d7.y, 1e-05, 1e-06);
}

void checkPixelHit(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec3 d4 = ownNormalWS(ivec2(5, tableRow));
    vec3 d5 = ownNormalWS(ivec2(6, tableRow));
    vec3 d6 = ownNormalWS(ivec2(7, tableRow));
    vec2 start = vec2(d0.x, d0.y);
    vec2 delta = vec2(d0.z, d1.x);
    vec2 affine = vec2(d1.y, d1.z);
    vec4 rect = vec4(d2.x, d2.y, d2.z, d3.x);
    vec4 surface = vec4(d3.y, d3.z, d4.x, d4.y);
    vec2 s = vec2(d4.z, d5.x);
    vec2 first = vec2(8.0);
    float error = 0.0;
    bool inFront = true;
    float known = 0.625;
    vec2 pixel = first;
    vec2 front = vec2(6.0, 7.0);
    PatchWalk w = tableWalk(start, delta, vec4(affine, 7.0, 8.0), first, false, error);
    PixelTest t = makePixelHit(w, tableCell(rect, surface, s, front, false), PatchState(whole(pixel), 0, inFront, HiddenStart(ivec2(10, 9), 0.125), known), known);
    check(301, t.s, d5.y, 1e-05, 1e-06);
    check(302, number(t.isHit && !t.isRefused && !t.inFront), d5.z, 1e-05, 1e-06);
    check(303, t.clearance, d6.x, 1e-05, 1e-06);
    check(304, t.hidden.s, d6.y, 1e-05, 1e-06);
}

void checkDecision(int tableRow)
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
    vec3 d11 = ownNormalWS(ivec2(12, tableRow));
    vec2 start = vec2(d0.x, d0.y);
    vec2 delta = vec2(d0.z, d1.x);
    vec4 affine = vec4(d1.y, d1.z, d2.x, d2.y);
    vec2 first = vec2(d2.z, d3.x);
    bool stands = d3.y > 0.5;
    float error = d3.z;
    vec2 pixel = vec2(d4.x, d4.y);
    bool inFront = d4.z > 0.5;
    float caution = d5.x;
    float known = d5.y;
    vec4 surface = vec4(d5.z, d6.x, d6.y, d6.z);
    vec2 front = vec2(d7.x, d7.y);
    vec2 s = vec2(d7.z, d8.x);
    vec3 plane = vec3(d8.y, d8.z, d9.x);
    PatchWalk w = tableWalk(start, delta, affine, first, stands, error);
    tablePlane = plane;
    vec4 rect = vec4(pixel, pixel + vec2(1.0));
    PixelTest t = testPixel(tableView(false, true), w, tableCell(rect, surface, s, front, false), PatchState(whole(pixel), 0, inFront, HiddenStart(ivec2(10, 9), 0.125), known), caution);
    check(401, number(t.isHit), d9.y, 0.0001, 1e-06);
    check(402, number(t.isRefused), d9.z, 0.0001, 1e-06);
    check(403, t.s, d10.x, 0.0001, 1e-06);
    check(404, number(t.inFront), d10.y, 0.0001, 1e-06);
    check(405, float(t.hidden.pixel.x), d10.z, 0.0001, 1e-06);
    check(406, float(t.hidden.pixel.y), d11.x, 0.0001, 1e-06);
    check(407, t.hidden.s, d11.y, 0.0001, 1e-06);
    check(408, t.clearance, d11.z, 0.0001, 1e-06);
}

void checkConfidence(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    float c = d0.x;
    check(501, computeConfidence(c), d0.y, 1e-05, 1e-06);
}

void checkStep(int tableRow)
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
    vec4 affine = vec4(d1.z, d2.x, d2.y, d2.z);
    vec4 rect = vec4(d3.x, d3.y, d3.z, d4.x);
    vec4 surface = vec4(d4.y, d4.z, d5.x, d5.y);
    vec2 s = vec2(d5.z, d6.x);
    vec2 front = vec2(d6.y, d6.z);
    vec2 first = vec2(8.0);
    bool stands = false;
    float error = 0.0;
    PatchWalk w = tableWalk(start, delta, affine, first, stands, error);
    PatchStep p = makePatchStep(tableView(o, true), w, tableCell(rect, surface, s, front, false), 3, 2, 17);
    check(601, float(p.iteration), d7.x, 1e-05, 1e-06);
    check(602, float(p.level), d7.y, 1e-05, 1e-06);
    check(603, float(p.cell.x), d7.z, 1e-05, 1e-06);
    check(604, float(p.cell.y), d8.x, 1e-05, 1e-06);
    check(605, float(p.rect.end.x), d8.y, 1e-05, 1e-06);
    check(606, float(p.rect.end.y), d8.z, 1e-05, 1e-06);
    check(607, p.positionSS.x, d9.x, 1e-05, 1e-06);
    check(608, p.positionSS.y, d9.y, 1e-05, 1e-06);
    check(609, p.rayLinearDepth, d9.z, 1e-05, 1e-06);
    check(610, p.nearLinearDepth, d10.x, 1e-05, 1e-06);
    check(611, p.farLinearDepth, d10.y, 1e-05, 1e-06);
    check(612, float(p.intersectionKind), d10.z, 1e-05, 1e-06);
}

void checkEnd(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec3 d4 = ownNormalWS(ivec2(5, tableRow));
    vec3 d5 = ownNormalWS(ivec2(6, tableRow));
    vec3 d6 = ownNormalWS(ivec2(7, tableRow));
    bool o = d0.x > 0.5;
    vec2 start = vec2(d0.y, d0.z);
    vec2 delta = vec2(d1.x, d1.y);
    vec2 affine = vec2(d1.z, d2.x);
    float s = d2.y;
    int reason = int(d2.z);
    int status = int(d3.x);
    PatchTraceResult counts = PatchTraceResult(8, 8, vec2(88.0), 88.0, 31, 4, 1, 88.0);
    ScreenRay ray = tableRay(start, delta, affine);
    ray.status = status;
    PatchTraceResult r = makePatchEnd(tableView(o, true), ray, s, reason, counts);
    check(701, float(r.hitClass), d3.y, 1e-05, 1e-06);
    check(702, float(r.reason), d3.z, 1e-05, 1e-06);
    check(703, r.positionSS.x, d4.x, 1e-05, 1e-06);
    check(704, r.positionSS.y, d4.y, 1e-05, 1e-06);
    check(705, r.linearDepth, d4.z, 1e-05, 1e-06);
    check(706, float(r.iterations), d5.x, 1e-05, 1e-06);
    check(707, float(r.maxUsedLevel), d5.y, 1e-05, 1e-06);
    check(708, float(r.intersectionKind), d5.z, 1e-05, 1e-06);
    check(709, r.confidence, d6.x, 1e-05, 1e-06);
}

void checkHit(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec3 d4 = ownNormalWS(ivec2(5, tableRow));
    vec3 d5 = ownNormalWS(ivec2(6, tableRow));
    vec3 d6 = ownNormalWS(ivec2(7, tableRow));
    vec3 d7 = ownNormalWS(ivec2(8, tableRow));
    bool o = d0.x > 0.5;
    vec2 start = vec2(d0.y, d0.z);
    vec2 delta = vec2(d1.x, d1.y);
    vec4 rect = vec4(d1.z, d2.x, d2.y, d2.z);
    vec4 surface = vec4(d3.x, d3.y, d3.z, d4.x);
    float s = d4.y;
    float known = d4.z;
    PatchTraceResult counts = PatchTraceResult(8, 8, vec2(88.0), 88.0, 31, 4, 1, 88.0);
    PatchWalk w = tableWalk(start, delta, vec4(0.25, -0.125, 7.0, 8.0), vec2(8.0), false, 0.0);
    PatchCell cell = tableCell(rect, surface, vec2(5.0, 6.0), vec2(7.0, 8.0), false);
    PixelTest t = PixelTest(true, false, s, false, HiddenStart(ivec2(1), 9.0), known);
    PatchTraceResult r = makePatchHit(tableView(o, true), w, cell, t, counts);
    check(801, float(r.hitClass), d5.x, 1e-05, 1e-06);
    check(802, float(r.reason), d5.y, 1e-05, 1e-06);
    check(803, r.positionSS.x, d5.z, 1e-05, 1e-06);
    check(804, r.positionSS.y, d6.x, 1e-05, 1e-06);
    check(805, r.linearDepth, d6.y, 1e-05, 1e-06);
    check(806, float(r.iterations), d6.z, 1e-05, 1e-06);
    check(807, float(r.maxUsedLevel), d7.x, 1e-05, 1e-06);
    check(808, float(r.intersectionKind), d7.y, 1e-05, 1e-06);
    check(809, r.confidence, d7.z, 1e-05, 1e-06);
}

OwnHit traceOwn(OwnRay ray)
{
    int row = ray.pixel.y;
    if (row >= 0 && row <= 143) checkSettle(row);
    if (row >= 144 && row <= 305) checkClearance(row);
    if (row >= 306 && row <= 662) checkGoesOn(row);
    if (row >= 663 && row <= 710) checkPixelHit(row);
    if (row >= 711 && row <= 1990) checkDecision(row);
    if (row >= 1991 && row <= 2011) checkConfidence(row);
    if (row >= 2012 && row <= 2035) checkStep(row);
    if (row >= 2036 && row <= 2067) checkEnd(row);
    if (row >= 2068 && row <= 2091) checkHit(row);
    return OwnHit(kHitClassHit, kHitReasonNone, wrongAnswer, float(wrongCheck), number(wrongCheck == 0));
}
