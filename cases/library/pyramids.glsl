// Made by tables.py: functions of the library on the rows of data/. Confidence is 1 where the row's answers are right; else HitDepth
// says which is wrong first (function * 100 + output, from 1), and HitPositionSS what it was and what was expected.
#include "crossray/project/surface_pyramid.glsl"
#include "crossray/project/depth_pyramid.glsl"
#include "crossray/project/depth_patch.glsl"
#include "crossray/project/linear.glsl"

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

void checkCellRect(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec3 d4 = ownNormalWS(ivec2(5, tableRow));
    int x = int(d0.x);
    int y = int(d0.y);
    int l = int(d0.z);
    int cx = int(d1.x);
    int cy = int(d1.y);
    int px = int(d1.z);
    int py = int(d2.x);
    CellRect r = computeCellRect(ivec2(x, y), l, ivec2(cx, cy), ivec2(px, py));
    vec2 c = computeRectCenter(r);
    CellSpan s = computeCellSpan(x, l, cx, px);
    check(1, float(r.begin.x), d2.y, 1e-05, 0);
    check(2, float(r.begin.y), d2.z, 1e-05, 0);
    check(3, float(r.end.x), d3.x, 1e-05, 0);
    check(4, float(r.end.y), d3.y, 1e-05, 0);
    check(5, c.x, d3.z, 1e-05, 0);
    check(6, c.y, d4.x, 1e-05, 0);
    check(7, float(s.begin), d4.y, 1e-05, 0);
    check(8, float(s.end), d4.z, 1e-05, 0);
}

void checkSurface(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec3 d4 = ownNormalWS(ivec2(5, tableRow));
    vec4 c = vec4(d0.x, d0.y, d0.z, d1.x);
    vec2 a = vec2(d1.y, d1.z);
    vec2 b = vec2(d2.x, d2.y);
    SurfaceCell u = unpackSurfaceCell(c);
    check(101, u.affineDepth, d2.z, 1e-05, 1e-06);
    check(102, u.gradient.x, d3.x, 1e-05, 1e-06);
    check(103, u.gradient.y, d3.y, 1e-05, 1e-06);
    check(104, u.slack, d3.z, 1e-05, 1e-06);
    check(105, number(isSky(u)), d4.x, 1e-05, 1e-06);
    check(106, packSurfaceCell(u).z, d4.y, 1e-05, 1e-06);
    check(107, surfaceAffineDepth(u, a, b), d4.z, 1e-05, 1e-06);
}

void checkSky(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    bool o = d0.x > 0.5;
    View v = tableView(o, true);
    check(201, makeSkySurface(v).affineDepth, d0.y, 1e-05, 1e-06);
    check(202, makeSkySurface(v).gradient.x, d0.z, 1e-05, 1e-06);
    check(203, makeSkySurface(v).slack, d1.x, 1e-05, 1e-06);
    check(204, computeFootprint(v, 0.25), d1.y, 1e-05, 1e-06);
    check(205, makeDepthPyramidTexel(v, 0.0).x, d1.z, 1e-05, 1e-06);
    check(206, makeDepthPyramidTexel(v, 0.0).y, d2.x, 1e-05, 1e-06);
}

void checkTexel(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    bool o = d0.x > 0.5;
    float d = d0.y;
    View v = tableView(o, true);
    check(301, makeDepthPyramidTexel(v, d).x, d0.z, 0.0001, 1e-06);
    check(302, makeDepthPyramidTexel(v, d).y, d1.x, 0.0001, 1e-06);
}

void checkNormalGradient(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    bool o = d0.x > 0.5;
    vec2 ss = vec2(d0.y, d0.z);
    float z = d1.x;
    vec3 n = vec3(d1.y, d1.z, d2.x);
    vec2 g = computeNormalGradient(tableView(o, true), ss, 1.0 / z, n);
    check(401, g.x, d2.y, 4e-05, 1e-06);
    check(402, g.y, d2.z, 4e-05, 1e-06);
}

void checkSteep(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 n = vec3(d0.x, d0.y, d0.z);
    vec2 g = computeNormalGradient(tableView(false, true), vec2(32.0, 24.0), 0.25, n);
    check(501, g.x, d1.x, 4e-05, 1e-06);
    check(502, g.y, d1.y, 4e-05, 1e-06);
}

void checkClampGradient(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec2 g = vec2(d0.x, d0.y);
    float a = d0.z;
    check(601, clampGradient(g, a).x, d1.x, 1e-05, 1e-06);
    check(602, clampGradient(g, a).y, d1.y, 1e-05, 1e-06);
}

void checkChooseSlope(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    float n = d0.x;
    bool h = d0.y > 0.5;
    float l = d0.z;
    bool a = d1.x > 0.5;
    float r = d1.y;
    bool b = d1.z > 0.5;
    float t = d2.x;
    check(701, chooseSlope(n, h, NeighborRise(-l, a), NeighborRise(r, b), t), d2.y, 1e-05, 1e-06);
}

void checkSizes(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    int w = int(d0.x);
    int h = int(d0.y);
    int l = int(d0.z);
    check(801, float(computeDepthPyramidSize(ivec2(w, h), l).x), d1.x, 1e-05, 0);
    check(802, float(computeDepthPyramidSize(ivec2(w, h), l).y), d1.y, 1e-05, 0);
    check(803, float(computeDepthPyramidLevelCount(ivec2(w, h))), d1.z, 1e-05, 0);
}

void checkCell(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    int x = int(d0.x);
    int y = int(d0.y);
    int l = int(d0.z);
    ivec2 c = computeDepthPyramidCell(ivec2(x, y), l, ivec2(43 >> l, 27 >> l));
    check(901, float(c.x), d1.x, 1e-05, 0);
    check(902, float(c.y), d1.y, 1e-05, 0);
}

void checkDifference(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    bool o = d0.x > 0.5;
    float f = d0.y;
    float s = d0.z;
    vec2 a = vec2(d1.x, d1.y);
    vec2 b = vec2(d1.z, d2.x);
    DepthDifference d = computeDepthDifference(o, f, s, CellSpan(int(a.x), int(a.y)), CellSpan(int(b.x), int(b.y)));
    check(1001, d.slope, d2.y, 1e-05, 1e-06);
    check(1002, number(d.isKnown), d2.z, 1e-05, 1e-06);
}

void checkAgree(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    float a = d0.x;
    float b = d0.y;
    float t = d0.z;
    check(1101, number(agree(a, b, t)), d1.x, 1e-05, 1e-06);
}

void checkLinearStride(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    float s = d0.x;
    int n = int(d0.y);
    float end = d0.z;
    float p = d1.x;
    check(1201, computeLinearStride(LinearSettings(s, n, 1, 0.0, 0), ScreenRay(vec2(0.0), vec2(1.0), p, 0.0, 0.0, 0, 0), end), d1.y, 1e-05, 1e-06);
}

void checkLinearEnd(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec2 a = vec2(d0.x, d0.y);
    vec2 d = vec2(d0.z, d1.x);
    check(1301, computeLinearEnd(tableView(false, true), ScreenRay(a, d, 0.1, 0.0, 0.0, 0, 0)), d1.y, 1e-05, 1e-06);
}

OwnHit traceOwn(OwnRay ray)
{
    int row = ray.pixel.y;
    if (row >= 0 && row <= 17) checkCellRect(row);
    if (row >= 18 && row <= 21) checkSurface(row);
    if (row >= 22 && row <= 23) checkSky(row);
    if (row >= 24 && row <= 29) checkTexel(row);
    if (row >= 30 && row <= 89) checkNormalGradient(row);
    if (row >= 90 && row <= 93) checkSteep(row);
    if (row >= 94 && row <= 109) checkClampGradient(row);
    if (row >= 110 && row <= 581) checkChooseSlope(row);
    if (row >= 582 && row <= 611) checkSizes(row);
    if (row >= 612 && row <= 629) checkCell(row);
    if (row >= 630 && row <= 646) checkDifference(row);
    if (row >= 647 && row <= 726) checkAgree(row);
    if (row >= 727 && row <= 762) checkLinearStride(row);
    if (row >= 763 && row <= 794) checkLinearEnd(row);
    return OwnHit(kHitClassHit, kHitReasonNone, wrongAnswer, float(wrongCheck), number(wrongCheck == 0));
}
