// Made by tables.py: functions of the library on the rows of data/. Confidence is 1 where the row's answers are right; else HitDepth
// says which is wrong first (function * 100 + output, from 1), and HitPositionSS what it was and what was expected.
#include "crossray/debug/debug_modes.glsl"

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

void checkVectors(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec3 d4 = ownNormalWS(ivec2(5, tableRow));
    vec3 v = vec3(d0.x, d0.y, d0.z);
    check(1, encodeDirection(v).x, d1.x, 1e-05, 2e-06);
    check(2, encodeDirection(v).y, d1.y, 1e-05, 2e-06);
    check(3, encodeDirection(v).z, d1.z, 1e-05, 2e-06);
    check(4, encodePositionNDC(v).x, d2.x, 1e-05, 2e-06);
    check(5, encodePositionNDC(v).y, d2.y, 1e-05, 2e-06);
    check(6, encodePositionNDC(v).z, d2.z, 1e-05, 2e-06);
    check(7, encodeRayDirNDC(v).x, d3.x, 1e-05, 2e-06);
    check(8, encodeRayDirNDC(v).y, d3.y, 1e-05, 2e-06);
    check(9, encodeRayDirNDC(v).z, d3.z, 1e-05, 2e-06);
    check(10, encodeColor(v).x, d4.x, 1e-05, 2e-06);
    check(11, encodeColor(v).y, d4.y, 1e-05, 2e-06);
    check(12, encodeColor(v).z, d4.z, 1e-05, 2e-06);
}

void checkScalars(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    float x = d0.x;
    check(101, encodeLinearDepth(x).x, d0.y, 1e-05, 4e-06);
    check(102, encodeLinearDepth(x).y, d0.z, 1e-05, 4e-06);
    check(103, encodeLinearDepth(x).z, d1.x, 1e-05, 4e-06);
    check(104, encodeWeight(x).x, d1.y, 1e-05, 4e-06);
    check(105, encodeWeight(x).y, d1.z, 1e-05, 4e-06);
    check(106, encodeWeight(x).z, d2.x, 1e-05, 4e-06);
}

void checkClasses(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    int c = int(d0.x);
    check(201, encodeHitClass(c).x, d0.y, 0, 0);
    check(202, encodeHitClass(c).y, d0.z, 0, 0);
    check(203, encodeHitClass(c).z, d1.x, 0, 0);
    check(204, encodeIndex(c).x, d1.y, 0, 0);
    check(205, encodeIndex(c).y, d1.z, 0, 0);
    check(206, encodeIndex(c).z, d2.x, 0, 0);
}

void checkCounts(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    int c = int(d0.x);
    int m = int(d0.y);
    check(301, encodeCount(c, m).x, d0.z, 1e-05, 1e-06);
    check(302, encodeCount(c, m).y, d1.x, 1e-05, 1e-06);
    check(303, encodeCount(c, m).z, d1.y, 1e-05, 1e-06);
}

OwnHit traceOwn(OwnRay ray)
{
    int row = ray.pixel.y;
    if (row >= 0 && row <= 9) checkVectors(row);
    if (row >= 10 && row <= 18) checkScalars(row);
    if (row >= 19 && row <= 35) checkClasses(row);
    if (row >= 36 && row <= 65) checkCounts(row);
    return OwnHit(kHitClassHit, kHitReasonNone, wrongAnswer, float(wrongCheck), number(wrongCheck == 0));
}
