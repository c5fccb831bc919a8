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

ivec2 tableCells = ivec2(1);
ivec2 tableCell = ivec2(0);
float tableMiddle = 0.0;
vec4 tableLine = vec4(0.0);
vec4 tableColumn = vec4(0.0);
float pick(vec4 line, int step) { return step == -2 ? line.x : step == -1 ? line.y : step == 1 ? line.z : line.w; }
ivec2 depthPyramidSize(int level) { return tableCells; }
vec2 fetchDepthPyramid(ivec2 cell, int level)
{
    ivec2 to = cell - tableCell;
    float nearest = to.y == 0 ? pick(tableLine, to.x) : to.x == 0 ? pick(tableColumn, to.y) : 0.001;
    nearest = to == ivec2(0) ? tableMiddle : nearest;
    return vec2(nearest, nearest + 100.0);
}

void checkPatch(int tableRow)
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
    bool o = d0.x > 0.5;
    int x = int(d0.y);
    int y = int(d0.z);
    int cx = int(d1.x);
    int cy = int(d1.y);
    int px = int(d1.z);
    int py = int(d2.x);
    int level = int(d2.y);
    float middle = d2.z;
    vec4 line = vec4(d3.x, d3.y, d3.z, d4.x);
    vec4 column = vec4(d4.y, d4.z, d5.x, d5.y);
    float fx = d5.z;
    float fy = d6.x;
    tableCells = ivec2(cx, cy);
    tableCell = ivec2(x, y);
    tableMiddle = middle;
    tableLine = line;
    tableColumn = column;
    DepthPatch p = fitDepthPatch(ScreenFrame(ivec2(px, py), 1.0 / 48.0, o), ivec2(x, y), level, middle, vec2(fx, fy));
    check(1, p.centerSS.x, d6.y, 0.0002, 2e-06);
    check(2, p.centerSS.y, d6.z, 0.0002, 2e-06);
    check(3, p.affineDepth, d7.x, 0.0002, 2e-06);
    check(4, p.gradient.x, d7.y, 0.0002, 2e-06);
    check(5, p.gradient.y, d7.z, 0.0002, 2e-06);
    check(6, patchAffineDepth(p, p.centerSS + vec2(3.0, -2.0)), d8.x, 0.0002, 2e-06);
}

void checkSlope(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec3 d4 = ownNormalWS(ivec2(5, tableRow));
    bool o = d0.x > 0.5;
    int n = int(d0.y);
    int place = int(d0.z);
    int level = int(d1.x);
    int axis = int(d1.y);
    float middle = d1.z;
    vec4 line = vec4(d2.x, d2.y, d2.z, d3.x);
    float bend = d3.y;
    float favour = d3.z;
    tableCells = ivec2(n);
    tableCell = axis == 0 ? ivec2(place, 0) : ivec2(0, place);
    tableMiddle = middle;
    tableLine = axis == 0 ? line : vec4(0.001);
    tableColumn = axis == 0 ? vec4(0.001) : line;
    float s = fitSlope(ScreenFrame(ivec2(n << level), 0.03125, o), tableCell, axis, level, middle, bend, favour);
    check(101, s, d4.x, 0, 0);
}

OwnHit traceOwn(OwnRay ray)
{
    int row = ray.pixel.y;
    if (row >= 0 && row <= 699) checkPatch(row);
    if (row >= 700 && row <= 1019) checkSlope(row);
    return OwnHit(kHitClassHit, kHitReasonNone, wrongAnswer, float(wrongCheck), number(wrongCheck == 0));
}
