// Made by tables.py: functions of the library on the rows of data/. Confidence is 1 where the row's answers are right; else HitDepth
// says which is wrong first (function * 100 + output, from 1), and HitPositionSS what it was and what was expected.
#include "crossray/hierarchy/screen_weight.glsl"
#include "crossray/hierarchy/weights.glsl"
#include "crossray/project/march_end.glsl"
#include "crossray/project/reprojection.glsl"

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

void checkScreenWeight(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec2 uv = vec2(d0.x, d0.y);
    float d = d0.z;
    int form = int(d1.x);
    check(1, computeScreenWeight(uv, d, form), d1.y, 1e-05, 1e-06);
}

void checkTiers(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    float h = d0.x;
    float w = d0.y;
    check(101, addTier(h, w).hierarchyWeight, d0.z, 0, 1e-07);
    check(102, addTier(h, w).weight, d1.x, 0, 1e-07);
    check(103, addSky(h).hierarchyWeight, d1.y, 0, 1e-07);
    check(104, addSky(h).weight, d1.z, 0, 1e-07);
}

void checkMarchEnd(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    int r = int(d0.x);
    bool f = d0.y > 0.5;
    bool h = d0.z > 0.5;
    check(201, float(computeMarchReason(r, f, h)), d1.x, 1e-05, 0);
    check(202, float(computeMarchClass(r)), d1.y, 1e-05, 0);
}

void checkByMotion(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec2 uv = vec2(d0.x, d0.y);
    vec2 m = vec2(d0.z, d1.x);
    Reprojection r = reprojectByMotion(uv, m);
    check(301, r.positionUV.x, d1.y, 0, 0);
    check(302, r.positionUV.y, d1.z, 0, 0);
    check(303, number(r.isOnScreen), d2.x, 0, 0);
}

void checkByView(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 p = vec3(d0.x, d0.y, d0.z);
    Reprojection r = reprojectByView(tableView(false, true), p);
    check(401, r.positionUV.x, d1.x, 1e-05, 2e-06);
    check(402, r.positionUV.y, d1.y, 1e-05, 2e-06);
    check(403, number(r.isOnScreen), d1.z, 1e-05, 2e-06);
}

OwnHit traceOwn(OwnRay ray)
{
    int row = ray.pixel.y;
    if (row >= 0 && row <= 128) checkScreenWeight(row);
    if (row >= 129 && row <= 192) checkTiers(row);
    if (row >= 193 && row <= 236) checkMarchEnd(row);
    if (row >= 237 && row <= 248) checkByMotion(row);
    if (row >= 249 && row <= 256) checkByView(row);
    return OwnHit(kHitClassHit, kHitReasonNone, wrongAnswer, float(wrongCheck), number(wrongCheck == 0));
}
