// Made by tables.py: functions of the library on the rows of data/. Confidence is 1 where the row's answers are right; else HitDepth
// says which is wrong first (function * 100 + output, from 1), and HitPositionSS what it was and what was expected.
#include "crossray/core/math.glsl"

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

void checkChoose(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec3 d4 = ownNormalWS(ivec2(5, tableRow));
    bool c = d0.x > 0.5;
    vec2 x = vec2(d0.y, d0.z);
    vec3 y = vec3(d1.x, d1.y, d1.z);
    check(1, choose(c, x.x, x.y), d2.x, 1e-05, 1e-06);
    check(2, float(choose(c, int(x.x), int(x.y))), d2.y, 1e-05, 1e-06);
    check(3, choose(c, x, y.xy).x, d2.z, 1e-05, 1e-06);
    check(4, choose(c, x, y.xy).y, d3.x, 1e-05, 1e-06);
    check(5, choose(c, y, y.yzx).x, d3.y, 1e-05, 1e-06);
    check(6, choose(c, y, y.yzx).y, d3.z, 1e-05, 1e-06);
    check(7, choose(c, y, y.yzx).z, d4.x, 1e-05, 1e-06);
    check(8, float(choose(c, ivec2(x), ivec2(y.xy)).x), d4.y, 1e-05, 1e-06);
    check(9, float(choose(c, ivec2(x), ivec2(y.xy)).y), d4.z, 1e-05, 1e-06);
}

void checkSaturate(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec3 v = vec3(d0.x, d0.y, d0.z);
    check(101, saturate(v.x), d1.x, 1e-06, 0);
    check(102, saturate(v).x, d1.y, 1e-06, 0);
    check(103, saturate(v).y, d1.z, 1e-06, 0);
    check(104, saturate(v).z, d2.x, 1e-06, 0);
    check(105, saturate(v.yz).x, d2.y, 1e-06, 0);
    check(106, saturate(v.yz).y, d2.z, 1e-06, 0);
    check(107, smoothRamp(v.x), d3.x, 1e-06, 0);
}

void checkIsFinite(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec4 v = vec4(d0.x, d0.y, d0.z, d1.x);
    check(201, number(isFinite(v.x)), d1.y, 1e-05, 0);
    check(202, number(isFinite(v.xy)), d1.z, 1e-05, 0);
    check(203, number(isFinite(v.xyz)), d2.x, 1e-05, 0);
    check(204, number(isFinite(v)), d2.y, 1e-05, 0);
    check(205, finiteOr(v.x, 7.0), d2.z, 1e-05, 0);
}

void checkDirection(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec3 v = vec3(d0.x, d0.y, d0.z);
    vec3 f = vec3(d1.x, d1.y, d1.z);
    check(301, number(hasDirection(v)), d2.x, 1e-05, 2e-07);
    check(302, safeNormalize(v, f).x, d2.y, 1e-05, 2e-07);
    check(303, safeNormalize(v, f).y, d2.z, 1e-05, 2e-07);
    check(304, safeNormalize(v, f).z, d3.x, 1e-05, 2e-07);
}

void checkMagnitudes(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 v = vec3(d0.x, d0.y, d0.z);
    check(401, sumOfMagnitudes(v), d1.x, 0, 0);
    check(402, minComponent(v), d1.y, 0, 0);
    check(403, maxComponent(v), d1.z, 0, 0);
}

void checkSafeDivide(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    float a = d0.x;
    float b = d0.y;
    float f = d0.z;
    check(501, safeDivide(a, b, f), d1.x, 1e-05, 1e-06);
}

void checkAwayFromZero(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    float x = d0.x;
    float s = d0.y;
    check(601, awayFromZero(x, s), d0.z, 0, 0);
}

void checkConstants(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    float x = d0.x;
    check(701, kPi * x, d0.y, 1e-05, 0);
    check(702, kFarAway * x, d0.z, 1e-05, 0);
    check(703, kShortestVector * x, d1.x, 1e-05, 0);
    check(704, kLongestVector * x, d1.y, 1e-05, 0);
}

OwnHit traceOwn(OwnRay ray)
{
    int row = ray.pixel.y;
    if (row >= 0 && row <= 1) checkChoose(row);
    if (row >= 2 && row <= 21) checkSaturate(row);
    if (row >= 22 && row <= 46) checkIsFinite(row);
    if (row >= 47 && row <= 75) checkDirection(row);
    if (row >= 76 && row <= 85) checkMagnitudes(row);
    if (row >= 86 && row <= 101) checkSafeDivide(row);
    if (row >= 102 && row <= 112) checkAwayFromZero(row);
    if (row >= 113 && row <= 113) checkConstants(row);
    return OwnHit(kHitClassHit, kHitReasonNone, wrongAnswer, float(wrongCheck), number(wrongCheck == 0));
}
