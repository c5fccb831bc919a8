// Made by tables.py: functions of the library on the rows of data/. Confidence is 1 where the row's answers are right; else HitDepth
// says which is wrong first (function * 100 + output, from 1), and HitPositionSS what it was and what was expected.
#include "crossray/project/screen_ray.glsl"

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

void checkScreenRay(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec3 d4 = ownNormalWS(ivec2(5, tableRow));
    vec3 d5 = ownNormalWS(ivec2(6, tableRow));
    bool o = d0.x > 0.5;
    vec3 p = vec3(d0.y, d0.z, d1.x);
    vec3 d = vec3(d1.y, d1.z, d2.x);
    ScreenRay r = makeScreenRay(tableView(o, true), p, d);
    check(1, r.startSS.x, d2.y, 0.0001, 2e-05);
    check(2, r.startSS.y, d2.z, 0.0001, 2e-05);
    check(3, r.deltaSS.x, d3.x, 0.0001, 2e-05);
    check(4, r.deltaSS.y, d3.y, 0.0001, 2e-05);
    check(5, r.pixelLength, d3.z, 0.0001, 2e-05);
    check(6, r.startAffineDepth, d4.x, 0.0001, 2e-05);
    check(7, r.deltaAffineDepth, d4.y, 0.0001, 2e-05);
    check(8, float(r.endReason), d4.z, 0.0001, 2e-05);
    check(9, float(r.status), d5.x, 0.0001, 2e-05);
}

void checkNoRay(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec3 d4 = ownNormalWS(ivec2(5, tableRow));
    bool o = d0.x > 0.5;
    vec3 p = vec3(d0.y, d0.z, d1.x);
    vec3 d = vec3(d1.y, d1.z, d2.x);
    ScreenRay r = makeScreenRay(tableView(o, true), p, d);
    check(101, r.startSS.x, d2.y, 1e-05, 1e-06);
    check(102, r.startSS.y, d2.z, 1e-05, 1e-06);
    check(103, r.pixelLength, d3.x, 1e-05, 1e-06);
    check(104, r.startAffineDepth, d3.y, 1e-05, 1e-06);
    check(105, r.deltaAffineDepth, d3.z, 1e-05, 1e-06);
    check(106, float(r.status), d4.x, 1e-05, 1e-06);
}

void checkFrame(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    bool o = d0.x > 0.5;
    ScreenFrame f = makeScreenFrame(tableView(o, true));
    check(201, float(f.imageSize.x), d0.y, 1e-05, 1e-06);
    check(202, float(f.imageSize.y), d0.z, 1e-05, 1e-06);
    check(203, f.footprint, d1.x, 1e-05, 1e-06);
    check(204, number(f.orthographic), d1.y, 1e-05, 1e-06);
}

void checkAffine(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    bool o = d0.x > 0.5;
    float z = d0.y;
    float back = d0.z;
    check(301, affineDepthFromLinear(o, z), d1.x, 1e-05, 1e-06);
    check(302, linearDepthFromAffine(o, back), d1.y, 1e-05, 1e-06);
}

void checkAt(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    float s = d0.x;
    ScreenRay r = ScreenRay(vec2(3.0, 5.0), vec2(10.0, -4.0), 0.1, 0.5, 0.25, 0, 0);
    check(401, screenRayPositionSS(r, s).x, d0.y, 1e-05, 1e-06);
    check(402, screenRayPositionSS(r, s).y, d0.z, 1e-05, 1e-06);
    check(403, screenRayAffineDepth(r, s), d1.x, 1e-05, 1e-06);
}

void checkBorder(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    float a = d0.x;
    float d = d0.y;
    int b = int(d0.z);
    check(501, borderTime(a, d, b), d1.x, 1e-05, 1e-06);
    check(502, float(entryBorder(b, d)), d1.y, 1e-05, 1e-06);
    check(503, float(exitBorder(b, d)), d1.z, 1e-05, 1e-06);
}

void checkPixelAt(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    float a = d0.x;
    float d = d0.y;
    int f = int(d0.z);
    float s = d1.x;
    bool i = d1.y > 0.5;
    check(601, float(pixelAt(a, d, f, s, i)), d1.z, 1e-05, 0);
}

void checkPixelFar(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    float a = d0.x;
    float d = d0.y;
    int f = int(d0.z);
    float s = d1.x;
    bool i = d1.y > 0.5;
    float e = d1.z;
    check(701, float(pixelAt(a, d, f, s, i)), d2.x, 0, 0);
}

void checkExactRay(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec3 d4 = ownNormalWS(ivec2(5, tableRow));
    vec3 d5 = ownNormalWS(ivec2(6, tableRow));
    bool o = d0.x > 0.5;
    vec3 p = vec3(d0.y, d0.z, d1.x);
    vec3 d = vec3(d1.y, d1.z, d2.x);
    View v = tableView(o, true);
    v.viewFromWorld = mat4(1.0);
    ScreenRay r = makeScreenRay(v, p, d);
    check(801, r.startSS.x, d2.y, 0.0001, 2e-05);
    check(802, r.startSS.y, d2.z, 0.0001, 2e-05);
    check(803, r.deltaSS.x * 1e20, d3.x, 0.0001, 2e-05);
    check(804, r.deltaSS.y * 1e20, d3.y, 0.0001, 2e-05);
    check(805, r.pixelLength, d3.z, 0.0001, 2e-05);
    check(806, r.startAffineDepth, d4.x, 0.0001, 2e-05);
    check(807, r.deltaAffineDepth, d4.y, 0.0001, 2e-05);
    check(808, float(r.endReason), d4.z, 0.0001, 2e-05);
    check(809, float(r.status), d5.x, 0.0001, 2e-05);
}

void checkConstants(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    float x = d0.x;
    check(901, kNever * x, d0.y, 1e-05, 1e-06);
    check(902, float(kMostMarchSteps) * x, d0.z, 1e-05, 1e-06);
}

OwnHit traceOwn(OwnRay ray)
{
    int row = ray.pixel.y;
    if (row >= 0 && row <= 19) checkScreenRay(row);
    if (row >= 20 && row <= 35) checkNoRay(row);
    if (row >= 36 && row <= 37) checkFrame(row);
    if (row >= 38 && row <= 53) checkAffine(row);
    if (row >= 54 && row <= 57) checkAt(row);
    if (row >= 58 && row <= 87) checkBorder(row);
    if (row >= 88 && row <= 267) checkPixelAt(row);
    if (row >= 268 && row <= 275) checkPixelFar(row);
    if (row >= 276 && row <= 315) checkExactRay(row);
    if (row >= 316 && row <= 316) checkConstants(row);
    return OwnHit(kHitClassHit, kHitReasonNone, wrongAnswer, float(wrongCheck), number(wrongCheck == 0));
}
