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
#define fetchDepthPyramid copyOf_fetchDepthPyramid
#define depthPyramidSize copyOf_depthPyramidSize
#define computeCellSpan copyOf_computeCellSpan
#define isSkyDepth copyOf_isSkyDepth
#define fetchNearest copyOf_fetchNearest
#define computeDepthDifference copyOf_computeDepthDifference
#define kTieTolerance copyOf_kTieTolerance
#define agree copyOf_agree
#define fitSlope copyOf_fitSlope
#define fitDepthPatch copyOf_fitDepthPatch
#define patchAffineDepth copyOf_patchAffineDepth
#define CellSpan copyOf_CellSpan
#define DepthPatch copyOf_DepthPatch
#define DepthDifference copyOf_DepthDifference
#undef CROSSRAY_PROJECT_DEPTH_PATCH_GLSL
#include "crossray/project/depth_patch.glsl"
#define depthPyramidLevelCount copyOf_depthPyramidLevelCount
#define recordHizStep copyOf_recordHizStep
#define kHizStartTolerance copyOf_kHizStartTolerance
#define kHizSinkTolerance copyOf_kHizSinkTolerance
#define kHizRuns copyOf_kHizRuns
#define sanitizeHizSettings copyOf_sanitizeHizSettings
#define computeHizEntry copyOf_computeHizEntry
#define enterHizCell copyOf_enterHizCell
#define testHizPlane copyOf_testHizPlane
#define testHizCell copyOf_testHizCell
#define computeHizCloserPixel copyOf_computeHizCloserPixel
#define stepHiz copyOf_stepHiz
#define makeHizStep copyOf_makeHizStep
#define traceHiz copyOf_traceHiz
#define HizSettings copyOf_HizSettings
#define HizStep copyOf_HizStep
#define TraceResult copyOf_TraceResult
#define HizState copyOf_HizState
#define HizCell copyOf_HizCell
#define HizTest copyOf_HizTest
#undef CROSSRAY_PROJECT_HIZ_GLSL
#include "crossray/project/hiz.glsl"

ivec2 tableImage = ivec2(32, 24);
int tableLevels = 6;
bool tableOrtho = false;
vec4 tablePlane = vec4(0.0); // affine depth at the image's corner, its change a pixel, and the bend
ivec2 depthPyramidSize(int level) { return max(ivec2(tableImage.x >> level, tableImage.y >> level), ivec2(1)); }
int depthPyramidLevelCount() { return tableLevels; }
float planeAffine(vec2 center) { return tablePlane.x + dot(tablePlane.yz, center) + tablePlane.w * center.x * center.x; }
vec2 fetchDepthPyramid(ivec2 cell, int level)
{
    ivec2 cells = depthPyramidSize(level);
    vec2 begin = vec2(cell.x << level, cell.y << level) + vec2(0.5);
    vec2 end = vec2(cell.x == cells.x - 1 ? tableImage.x : (cell.x + 1) << level, cell.y == cells.y - 1 ? tableImage.y : (cell.y + 1) << level) - vec2(0.5);
    float a = planeAffine(begin), b = planeAffine(end), c = planeAffine(vec2(begin.x, end.y)), d = planeAffine(vec2(end.x, begin.y));
    float high = max(max(a, b), max(c, d));
    float low = min(min(a, b), min(c, d));
    return tableOrtho ? -vec2(high, low) : 1.0 / vec2(high, low);
}
void recordHizStep(HizStep step) {}
ScreenFrame tableFrame() { return ScreenFrame(tableImage, 0.03125, tableOrtho); }
float runs(int pixel) { return float(clamp(pixel, -4, 999)); } // pixels so far away that a float says it all

void checkPlane(int tableRow)
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
    bool o = d0.x > 0.5;
    vec4 q = vec4(d0.y, d0.z, d1.x, d1.y);
    int cx = int(d1.z);
    int cy = int(d2.x);
    int wide = int(d2.y);
    int tall = int(d2.z);
    int level = int(d3.x);
    float near = d3.y;
    vec2 a = vec2(d3.z, d4.x);
    vec2 d = vec2(d4.y, d4.z);
    float pixel = d5.x;
    float a0 = d5.y;
    float da = d5.z;
    bool front = d6.x > 0.5;
    bool attached = d6.y > 0.5;
    bool start = d6.z > 0.5;
    float enter = d7.x;
    float leave = d7.y;
    float bias = d7.z;
    tableOrtho = o;
    tablePlane = q;
    ScreenRay ray = ScreenRay(a, d, pixel, a0, da, 0, 0);
    HizState state = HizState(0.25, ivec2(0), level, front, attached, false, start);
    ivec2 begin = ivec2(cx << level, cy << level);
    HizCell c = HizCell(ivec2(cx, cy), begin, begin + ivec2(wide, tall), vec2(near, near), enter, leave, ivec2(0), false, false, 0.0, 0.0);
    HizTest t = testHizPlane(tableFrame(), ray, state, c, bias);
    check(1, float(t.kind), d8.x, 0.0001, 2e-05);
    check(2, t.s, d8.y, 0.0001, 2e-05);
    check(3, t.affineDepth, d8.z, 0.0001, 2e-05);
    check(4, number(t.inFront), d9.x, 0.0001, 2e-05);
    check(5, number(t.attached), d9.y, 0.0001, 2e-05);
    check(6, number(t.isHidden), d9.z, 0.0001, 2e-05);
}

void checkCell(int tableRow)
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
    vec4 q = vec4(d0.y, d0.z, d1.x, d1.y);
    int cx = int(d1.z);
    int cy = int(d2.x);
    int level = int(d2.y);
    float near = d2.z;
    float far = d3.x;
    float rayNear = d3.y;
    float rayFar = d3.z;
    bool leaves = d4.x > 0.5;
    int low = int(d4.y);
    vec2 a = vec2(d4.z, d5.x);
    vec2 d = vec2(d5.y, d5.z);
    float pixel = d6.x;
    float a0 = d6.y;
    float da = d6.z;
    bool front = d7.x > 0.5;
    bool attached = d7.y > 0.5;
    bool start = d7.z > 0.5;
    float s = d8.x;
    float enter = d8.y;
    float leave = d8.z;
    float bias = d9.x;
    tableOrtho = o;
    tablePlane = q;
    ScreenRay ray = ScreenRay(a, d, pixel, a0, da, 0, 0);
    HizState state = HizState(s, ivec2(0), level, front, attached, false, start);
    ivec2 begin = ivec2(cx << level, cy << level);
    HizCell c = HizCell(ivec2(cx, cy), begin, begin + ivec2(1 << level), vec2(near, far), enter, leave, ivec2(0), leaves, false, rayNear, rayFar);
    HizTest t = testHizCell(tableFrame(), ray, state, c, HizSettings(low, 5, 9, bias));
    check(101, float(t.kind), d9.y, 1e-05, 1e-06);
    check(102, t.s, d9.z, 1e-05, 1e-06);
    check(103, t.affineDepth, d10.x, 1e-05, 1e-06);
    check(104, number(t.inFront), d10.y, 1e-05, 1e-06);
    check(105, number(t.attached), d10.z, 1e-05, 1e-06);
    check(106, number(t.isHidden), d11.x, 1e-05, 1e-06);
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
    bool o = d0.x > 0.5;
    int ix = int(d0.y);
    int iy = int(d0.z);
    vec2 a = vec2(d1.x, d1.y);
    vec2 d = vec2(d1.z, d2.x);
    float a0 = d2.y;
    float da = d2.z;
    float s = d3.x;
    int px = int(d3.y);
    int py = int(d3.z);
    int level = int(d4.x);
    bool finest = d4.y > 0.5;
    tableOrtho = o;
    tableImage = ivec2(ix, iy);
    tablePlane = vec4(o ? -8.0 : 0.125, 0.0078125, -0.00390625, 0.0);
    float pixel = 0.125;
    ScreenRay ray = ScreenRay(a, d, pixel, a0, da, 0, 0);
    HizCell c = enterHizCell(tableFrame(), ray, HizState(s, ivec2(px, py), level, true, true, false, false), finest);
    check(201, float(c.cell.x), d4.z, 1e-05, 1e-06);
    check(202, float(c.cell.y), d5.x, 1e-05, 1e-06);
    check(203, float(c.begin.x), d5.y, 1e-05, 1e-06);
    check(204, float(c.begin.y), d5.z, 1e-05, 1e-06);
    check(205, float(c.end.x), d6.x, 1e-05, 1e-06);
    check(206, float(c.end.y), d6.y, 1e-05, 1e-06);
    check(207, c.depths.x, d6.z, 1e-05, 1e-06);
    check(208, c.depths.y, d7.x, 1e-05, 1e-06);
    check(209, c.enter, d7.y, 1e-05, 1e-06);
    check(210, c.leave, d7.z, 1e-05, 1e-06);
    check(211, runs(c.leavePixel.x), d8.x, 1e-05, 1e-06);
    check(212, runs(c.leavePixel.y), d8.y, 1e-05, 1e-06);
    check(213, number(c.leavesImage), d8.z, 1e-05, 1e-06);
    check(214, number(c.isLast), d9.x, 1e-05, 1e-06);
    check(215, c.rayNearest, d9.y, 1e-05, 1e-06);
    check(216, c.rayFarthest, d9.z, 1e-05, 1e-06);
}

void checkCloser(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec3 d4 = ownNormalWS(ivec2(5, tableRow));
    bool o = d0.x > 0.5;
    float near = d0.y;
    vec2 a = vec2(d0.z, d1.x);
    vec2 d = vec2(d1.y, d1.z);
    float a0 = d2.x;
    float da = d2.y;
    int px = int(d2.z);
    int py = int(d3.x);
    bool attached = d3.y > 0.5;
    float s = d3.z;
    tableOrtho = o;
    float pixel = 0.125;
    ScreenRay ray = ScreenRay(a, d, pixel, a0, da, 0, 0);
    HizCell c = HizCell(ivec2(0), ivec2(0), ivec2(0), vec2(near, near + 4.0), 0.0, 1.0, ivec2(0), false, false, 0.0, 0.0);
    ivec2 p = computeHizCloserPixel(tableFrame(), ray, HizState(0.0, ivec2(px, py), 1, true, attached, false, false), c, s);
    check(301, float(p.x), d4.x, 1e-05, 0);
    check(302, float(p.y), d4.y, 1e-05, 0);
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
    int kind = int(d0.x);
    float s = d0.y;
    float near = d0.z;
    int level = int(d1.x);
    int low = int(d1.y);
    int high = int(d1.z);
    bool front = d2.x > 0.5;
    bool hid = d2.y > 0.5;
    bool start = d2.z > 0.5;
    bool attached = d3.x > 0.5;
    float to = d3.y;
    bool inFront = d3.z > 0.5;
    bool hidden = d4.x > 0.5;
    ScreenRay ray = ScreenRay(vec2(4.5, 5.5), vec2(16.0, 8.0), 0.0625, -8.0, 0.0, 0, 0);
    tableOrtho = true;
    HizCell c = HizCell(ivec2(0), ivec2(0), ivec2(0), vec2(near), 0.0, 0.75, ivec2(12, 13), false, false, 0.0, 0.0);
    HizState n = stepHiz(tableFrame(), ray, HizState(s, ivec2(4, 5), level, front, true, hid, start), c, HizTest(kind, to, 0.0, inFront, attached, hidden), HizSettings(low, high, 9, 1.0));
    check(401, n.s, d4.y, 1e-05, 1e-06);
    check(402, float(n.pixel.x), d4.z, 1e-05, 1e-06);
    check(403, float(n.pixel.y), d5.x, 1e-05, 1e-06);
    check(404, float(n.level), d5.y, 1e-05, 1e-06);
    check(405, number(n.inFront), d5.z, 1e-05, 1e-06);
    check(406, number(n.attached), d6.x, 1e-05, 1e-06);
    check(407, number(n.wasHidden), d6.y, 1e-05, 1e-06);
    check(408, number(n.isStart), d6.z, 1e-05, 1e-06);
}

void checkSanitize(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    int n = int(d0.x);
    int low = int(d0.y);
    int high = int(d0.z);
    int most = int(d1.x);
    float bias = d1.y;
    tableLevels = n;
    HizSettings t = sanitizeHizSettings(HizSettings(low, high, most, bias));
    check(501, float(t.minLevel), d1.z, 1e-05, 0);
    check(502, float(t.maxLevel), d2.x, 1e-05, 0);
    check(503, float(t.maxIterations), d2.y, 1e-05, 0);
    check(504, t.depthBias, d2.z, 1e-05, 0);
}

void checkTrace(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec3 d4 = ownNormalWS(ivec2(5, tableRow));
    vec3 d5 = ownNormalWS(ivec2(6, tableRow));
    vec2 a = vec2(d0.x, d0.y);
    float z = d0.z;
    vec3 d = vec3(d1.x, d1.y, d1.z);
    int low = int(d2.x);
    int high = int(d2.y);
    int most = int(d2.z);
    float bias = d3.x;
    mat4 one = mat4(vec4(1.0, 0.0, 0.0, 0.0), vec4(0.0, 1.0, 0.0, 0.0), vec4(0.0, 0.0, 1.0, 0.0), vec4(0.0, 0.0, 0.0, 1.0));
    View v = View(one, one, one, vec2(tableImage), vec2(16.0, 12.0), 0.0, 1.0, 0.5, 64.0, true, false);
    tableOrtho = true;
    tablePlane = vec4(-8.0, 0.0, 0.0, 0.0);
    TraceResult r = traceHiz(v, vec3(a.x - 16.0, 12.0 - a.y, -z), vec3(d.x, -d.y, -d.z), HizSettings(low, high, most, bias));
    check(601, float(r.hitClass), d3.y, 1e-05, 0.0001);
    check(602, float(r.reason), d3.z, 1e-05, 0.0001);
    check(603, r.positionSS.x, d4.x, 1e-05, 0.0001);
    check(604, r.positionSS.y, d4.y, 1e-05, 0.0001);
    check(605, r.linearDepth, d4.z, 1e-05, 0.0001);
    check(606, float(r.iterations), d5.x, 1e-05, 0.0001);
    check(607, float(r.maxUsedLevel), d5.y, 1e-05, 0.0001);
    check(608, float(r.intersectionKind), d5.z, 1e-05, 0.0001);
}

OwnHit traceOwn(OwnRay ray)
{
    int row = ray.pixel.y;
    if (row >= 0 && row <= 503) checkPlane(row);
    if (row >= 504 && row <= 809) checkCell(row);
    if (row >= 810 && row <= 1009) checkEnter(row);
    if (row >= 1010 && row <= 1145) checkCloser(row);
    if (row >= 1146 && row <= 1181) checkStep(row);
    if (row >= 1182 && row <= 1217) checkSanitize(row);
    if (row >= 1218 && row <= 1224) checkTrace(row);
    return OwnHit(kHitClassHit, kHitReasonNone, wrongAnswer, float(wrongCheck), number(wrongCheck == 0));
}
