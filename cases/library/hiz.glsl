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

int tableKind = 0;

// Affine depth (1/m) of a pixel: a wall that turns away to the right, or a floor; before it from column `begin` on a box that faces the eye.
float wallAffine(ivec2 pixel)
{
    vec2 center = vec2(pixel) + vec2(0.5);
    return tableKind == 1 ? 0.03125 + 0.0078125 * center.y : tableKind == 2 ? 0.375 - 0.00390625 * center.x : 0.125 + 0.001953125 * center.x + 0.00048828125 * center.y;
}
ivec4 tableBox() { return tableKind == 3 ? ivec4(28, 12, 36, 34) : tableKind == 4 ? ivec4(20, 8, 52, 40) : ivec4(0); } // begin, end
float boxAffine() { return tableKind == 4 ? 0.28125 : 0.3125; }

ivec2 depthPyramidSize(int level) { return max(ivec2(64 >> level, 48 >> level), ivec2(1)); }
int depthPyramidLevelCount() { return 7; }

vec2 fetchDepthPyramid(ivec2 cell, int level)
{
    ivec2 cells = depthPyramidSize(level);
    ivec2 begin = ivec2(cell.x << level, cell.y << level);
    ivec2 end = ivec2(cell.x == cells.x - 1 ? 64 : begin.x + (1 << level), cell.y == cells.y - 1 ? 48 : begin.y + (1 << level)) - ivec2(1);
    float a = wallAffine(begin), b = wallAffine(end), c = wallAffine(ivec2(begin.x, end.y)), d = wallAffine(ivec2(end.x, begin.y));
    float high = max(max(a, b), max(c, d));
    float low = min(min(a, b), min(c, d));
    ivec4 box = tableBox();
    bool touches = box.z > 0 && begin.x < box.z && end.x >= box.x && begin.y < box.w && end.y >= box.y;
    bool isInside = touches && begin.x >= box.x && end.x < box.z && begin.y >= box.y && end.y < box.w;
    high = touches ? boxAffine() : high;
    low = isInside ? boxAffine() : low;
    vec2 depths = 1.0 / vec2(high, low);
    return tableKind == 5 && begin.x >= 32 ? vec2(1e30) : depths;
}

float recorded = 0.0; // a sum over the steps that knows their order
float recordedCells = 0.0;
void recordHizStep(HizStep step)
{
    float share = 1.0 / float(step.iteration + 2);
    recorded += share * (step.positionSS.x + 2.0 * step.positionSS.y + 3.0 * step.rayLinearDepth + 5.0 * min(step.nearestLinearDepth, 20.0) + 7.0 * min(step.farthestLinearDepth, 40.0)
        + 11.0 * min(step.thickLinearDepth, 40.0));
    recordedCells += share * float(step.level + 3 * step.cell.x + 5 * step.cell.y + 7 * step.cellSizeSS.x + 11 * step.cellSizeSS.y + 13 * step.intersectionKind);
}

void checkMarch(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec3 d4 = ownNormalWS(ivec2(5, tableRow));
    vec3 d5 = ownNormalWS(ivec2(6, tableRow));
    vec3 d6 = ownNormalWS(ivec2(7, tableRow));
    int k = int(d0.x);
    int x = int(d0.y);
    int y = int(d0.z);
    float lift = d1.x;
    vec3 d = vec3(d1.y, d1.z, d2.x);
    int low = int(d2.y);
    int high = int(d2.z);
    int most = int(d3.x);
    float bias = d3.y;
    tableKind = k;
    View v = tableView(false, true);
    float z = fetchDepthPyramid(ivec2(x, y), 0).x * (1.0 + lift);
    vec3 p = positionWSFromSS(v, vec2(float(x) + 0.5, float(y) + 0.5), z);
    vec3 w = (v.worldFromView * vec4(d, 0.0)).xyz;
    TraceResult r = traceHiz(v, p, w, HizSettings(low, high, most, bias));
    check(1, float(r.hitClass), d3.z, 0.0003, 0.004);
    check(2, float(r.reason), d4.x, 0.0003, 0.004);
    check(3, r.positionSS.x, d4.y, 0.0003, 0.004);
    check(4, r.positionSS.y, d4.z, 0.0003, 0.004);
    check(5, r.linearDepth, d5.x, 0.0003, 0.004);
    check(6, float(r.iterations), d5.y, 0.0003, 0.004);
    check(7, float(r.maxUsedLevel), d5.z, 0.0003, 0.004);
    check(8, float(r.intersectionKind), d6.x, 0.0003, 0.004);
    check(9, recorded, d6.y, 0.0003, 0.004);
    check(10, recordedCells, d6.z, 0.0003, 0.004);
}

void checkNoStart(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec3 d4 = ownNormalWS(ivec2(5, tableRow));
    vec3 p = vec3(d0.x, d0.y, d0.z);
    vec3 d = vec3(d1.x, d1.y, d1.z);
    TraceResult r = traceHiz(tableView(false, true), p, d, HizSettings(1, 4, 100, 1.0));
    check(101, float(r.hitClass), d2.x, 2e-05, 0.0001);
    check(102, float(r.reason), d2.y, 2e-05, 0.0001);
    check(103, r.positionSS.x, d2.z, 2e-05, 0.0001);
    check(104, r.positionSS.y, d3.x, 2e-05, 0.0001);
    check(105, r.linearDepth, d3.y, 2e-05, 0.0001);
    check(106, float(r.iterations), d3.z, 2e-05, 0.0001);
    check(107, float(r.maxUsedLevel), d4.x, 2e-05, 0.0001);
}

OwnHit traceOwn(OwnRay ray)
{
    int row = ray.pixel.y;
    if (row >= 0 && row <= 699) checkMarch(row);
    if (row >= 700 && row <= 713) checkNoStart(row);
    return OwnHit(kHitClassHit, kHitReasonNone, wrongAnswer, float(wrongCheck), number(wrongCheck == 0));
}
