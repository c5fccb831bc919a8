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
    vec3 n = vec3(d0.x, d0.y, d0.z);
    vec3 v = vec3(d1.x, d1.y, d1.z);
    float ior = d2.x;
    float t = d2.y;
    RefractionEntry e = enterRefractor(n, v, ior, t);
    n = e.status == kHitReasonDegenerateRay ? vec3(0.0) : e.normalWS;
    check(201, n.x, d2.z, 2e-05, 2e-05);
    check(202, n.y, d3.x, 2e-05, 2e-05);
    check(203, n.z, d3.y, 2e-05, 2e-05);
    check(204, e.viewDirWS.x, d3.z, 2e-05, 2e-05);
    check(205, e.viewDirWS.y, d4.x, 2e-05, 2e-05);
    check(206, e.viewDirWS.z, d4.y, 2e-05, 2e-05);
    check(207, e.dirWS.x, d4.z, 2e-05, 2e-05);
    check(208, e.dirWS.y, d5.x, 2e-05, 2e-05);
    check(209, e.dirWS.z, d5.y, 2e-05, 2e-05);
    check(210, e.cosineOutside, d5.z, 2e-05, 2e-05);
    check(211, e.cosineInside, d6.x, 2e-05, 2e-05);
    check(212, e.indexOfRefraction, d6.y, 2e-05, 2e-05);
    check(213, e.thickness, d6.z, 2e-05, 2e-05);
    check(214, float(e.status), d7.x, 2e-05, 2e-05);
}

void checkSteepEntry(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec3 n = vec3(d0.x, d0.y, d0.z);
    float ior = d1.x;
    float t = d1.y;
    RefractionEntry e = enterRefractor(n, n, ior, t);
    check(301, e.dirWS.x, d1.z, 1e-05, 0.001);
    check(302, e.dirWS.y, d2.x, 1e-05, 0.001);
    check(303, e.dirWS.z, d2.y, 1e-05, 0.001);
    check(304, float(e.status), d2.z, 1e-05, 0.001);
    check(305, number(e.cosineInside < 1.1), d3.x, 1e-05, 0.001);
}

void checkLongExit(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 n = vec3(d0.x, d0.y, d0.z);
    vec3 v = vec3(d1.x, d1.y, d1.z);
    float ior = d2.x;
    RefractionExit e = computeRefraction(kRefractionSphere, vec3(0.0), n, v, ior, 1.0);
    check(401, dot(e.dirWS, e.dirWS), d2.y, 1e-05, 1e-06);
}

void checkFresnel(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    int m = int(d0.x);
    float c = d0.y;
    float ior = d0.z;
    check(501, computeFresnel(m, c, ior), d1.x, 2e-05, 2e-06);
}

void checkFresnelEnds(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    int m = int(d0.x);
    float c = d0.y;
    float ior = d0.z;
    check(601, computeFresnel(m, c, ior), d1.x, 1e-05, 0.0004);
}

void checkReflection(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 n = vec3(d0.x, d0.y, d0.z);
    vec3 v = vec3(d1.x, d1.y, d1.z);
    vec3 d = computeReflectionDirection(n, v);
    check(701, d.x, d2.x, 1e-05, 1e-06);
    check(702, d.y, d2.y, 1e-05, 1e-06);
    check(703, d.z, d2.z, 1e-05, 1e-06);
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
    check(801, t.x, d1.z, 4e-05, 1e-07);
    check(802, t.y, d2.x, 4e-05, 1e-07);
    check(803, t.z, d2.y, 4e-05, 1e-07);
}

OwnHit traceOwn(OwnRay ray)
{
    int row = ray.pixel.y;
    if (row >= 0 && row <= 162) checkRefraction(row);
    if (row >= 163 && row <= 170) checkDenseRefraction(row);
    if (row >= 171 && row <= 214) checkEnter(row);
    if (row >= 215 && row <= 226) checkSteepEntry(row);
    if (row >= 227 && row <= 244) checkLongExit(row);
    if (row >= 245 && row <= 496) checkFresnel(row);
    if (row >= 497 && row <= 520) checkFresnelEnds(row);
    if (row >= 521 && row <= 542) checkReflection(row);
    if (row >= 543 && row <= 566) checkTransmittance(row);
    return OwnHit(kHitClassHit, kHitReasonNone, wrongAnswer, float(wrongCheck), number(wrongCheck == 0));
}
