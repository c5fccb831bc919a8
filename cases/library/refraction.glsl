// Made by tables.py: functions of the library on the rows of data/. Confidence is 1 where the row's answers are right; else HitDepth
// says which is wrong first (function * 100 + output, from 1), and HitPositionSS what it was and what was expected.
#include "crossray/refract/refraction.glsl"
#include "crossray/refract/fresnel.glsl"
#include "crossray/refract/absorption.glsl"
#include "crossray/core/reflection.glsl"

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

void checkRefraction(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec3 d4 = ownNormalWS(ivec2(5, tableRow));
    vec3 d5 = ownNormalWS(ivec2(6, tableRow));
    vec3 d6 = ownNormalWS(ivec2(7, tableRow));
    int m = int(d0.x);
    vec3 p = vec3(d0.y, d0.z, d1.x);
    vec3 n = vec3(d1.y, d1.z, d2.x);
    vec3 v = vec3(d2.y, d2.z, d3.x);
    float ior = d3.y;
    float t = d3.z;
    RefractionExit e = computeRefraction(m, p, n, v, ior, t);
    check(1, e.positionWS.x, d4.x, 2e-05, 2e-05);
    check(2, e.positionWS.y, d4.y, 2e-05, 2e-05);
    check(3, e.positionWS.z, d4.z, 2e-05, 2e-05);
    check(4, e.dirWS.x, d5.x, 2e-05, 2e-05);
    check(5, e.dirWS.y, d5.y, 2e-05, 2e-05);
    check(6, e.dirWS.z, d5.z, 2e-05, 2e-05);
    check(7, e.pathLength, d6.x, 2e-05, 2e-05);
    check(8, float(e.status), d6.y, 2e-05, 2e-05);
}

void checkDenseRefraction(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec3 d4 = ownNormalWS(ivec2(5, tableRow));
    vec3 d5 = ownNormalWS(ivec2(6, tableRow));
    int m = int(d0.x);
    vec3 p = vec3(d0.y, d0.z, d1.x);
    vec3 n = vec3(d1.y, d1.z, d2.x);
    vec3 v = vec3(d2.y, d2.z, d3.x);
    float ior = d3.y;
    float t = d3.z;
    RefractionExit e = computeRefraction(m, p, n, v, ior, t);
    check(101, e.positionWS.x, d4.x, 1e-05, 0.0002);
    check(102, e.positionWS.z, d4.y, 1e-05, 0.0002);
    check(103, e.dirWS.x, d4.z, 1e-05, 0.0002);
    check(104, e.dirWS.z, d5.x, 1e-05, 0.0002);
    check(105, e.pathLength, d5.y, 1e-05, 0.0002);
    check(106, float(e.status), d5.z, 1e-05, 0.0002);
}

void checkFresnel(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    int m = int(d0.x);
    float c = d0.y;
    float ior = d0.z;
    check(201, computeFresnel(m, c, ior), d1.x, 2e-05, 2e-06);
}

void checkFresnelEnds(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    int m = int(d0.x);
    float c = d0.y;
    float ior = d0.z;
    check(301, computeFresnel(m, c, ior), d1.x, 1e-05, 0.0004);
}

void checkReflection(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 n = vec3(d0.x, d0.y, d0.z);
    vec3 v = vec3(d1.x, d1.y, d1.z);
    vec3 d = computeReflectionDirection(n, v);
    check(401, d.x, d2.x, 1e-05, 1e-06);
    check(402, d.y, d2.y, 1e-05, 1e-06);
    check(403, d.z, d2.z, 1e-05, 1e-06);
}

void checkTransmittance(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 c = vec3(d0.x, d0.y, d0.z);
    float a = d1.x;
    float path = d1.y;
    vec3 t = computeTransmittance(c, a, path);
    check(501, t.x, d1.z, 4e-05, 1e-07);
    check(502, t.y, d2.x, 4e-05, 1e-07);
    check(503, t.z, d2.y, 4e-05, 1e-07);
}

OwnHit traceOwn(OwnRay ray)
{
    int row = ray.pixel.y;
    if (row >= 0 && row <= 154) checkRefraction(row);
    if (row >= 155 && row <= 162) checkDenseRefraction(row);
    if (row >= 163 && row <= 410) checkFresnel(row);
    if (row >= 411 && row <= 434) checkFresnelEnds(row);
    if (row >= 435 && row <= 455) checkReflection(row);
    if (row >= 456 && row <= 479) checkTransmittance(row);
    return OwnHit(kHitClassHit, kHitReasonNone, wrongAnswer, float(wrongCheck), number(wrongCheck == 0));
}
