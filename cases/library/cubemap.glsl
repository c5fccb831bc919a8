// Made by tables.py: functions of the library on the rows of data/. Confidence is 1 where the row's answers are right; else HitDepth
// says which is wrong first (function * 100 + output, from 1), and HitPositionSS what it was and what was expected.
#include "crossray/probe/cubemap.glsl"

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

void checkPlace(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d = vec3(d0.x, d0.y, d0.z);
    CubePosition c = cubePositionFromDirection(d);
    check(1, float(c.face), d1.x, 1e-05, 1e-06);
    check(2, c.uv.x, d1.y, 1e-05, 1e-06);
    check(3, c.uv.y, d1.z, 1e-05, 1e-06);
    check(4, number(c.valid), d2.x, 1e-05, 1e-06);
}

void checkPoint(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    int f = int(d0.x);
    float s = d0.y;
    float t = d0.z;
    float m = d1.x;
    check(101, cubePoint(f, s, t, m).x, d1.y, 1e-05, 1e-06);
    check(102, cubePoint(f, s, t, m).y, d1.z, 1e-05, 1e-06);
    check(103, cubePoint(f, s, t, m).z, d2.x, 1e-05, 1e-06);
}

void checkDirection(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    int f = int(d0.x);
    vec2 uv = vec2(d0.y, d0.z);
    vec3 d = directionFromCubePosition(f, uv);
    check(201, d.x, d1.x, 1e-05, 1e-06);
    check(202, d.y, d1.y, 1e-05, 1e-06);
    check(203, d.z, d1.z, 1e-05, 1e-06);
}

void checkFold(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    int f = int(d0.x);
    vec2 uv = vec2(d0.y, d0.z);
    CubePosition c = foldCubePosition(f, uv);
    check(301, float(c.face), d1.x, 1e-05, 1e-06);
    check(302, c.uv.x, d1.y, 1e-05, 1e-06);
    check(303, c.uv.y, d1.z, 1e-05, 1e-06);
    check(304, number(c.valid), d2.x, 1e-05, 1e-06);
}

OwnHit traceOwn(OwnRay ray)
{
    int row = ray.pixel.y;
    if (row >= 0 && row <= 27) checkPlace(row);
    if (row >= 28 && row <= 35) checkPoint(row);
    if (row >= 36 && row <= 227) checkDirection(row);
    if (row >= 228 && row <= 419) checkFold(row);
    return OwnHit(kHitClassHit, kHitReasonNone, wrongAnswer, float(wrongCheck), number(wrongCheck == 0));
}
