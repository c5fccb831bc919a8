// Made by tables.py: functions of the library on the rows of data/. Confidence is 1 where the row's answers are right; else HitDepth
// says which is wrong first (function * 100 + output, from 1), and HitPositionSS what it was and what was expected.
#include "crossray/probe/influence.glsl"

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

// A rotation without a zero: its columns are the axes.
mat3 tableTurn(bool turned)
{
    mat3 turn = mat3(vec3(2.0, 2.0, -1.0) / 3.0, vec3(-1.0, 2.0, 2.0) / 3.0, vec3(2.0, -1.0, 2.0) / 3.0);
    return turned ? turn : mat3(1.0);
}

void checkInfluence(int tableRow)
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
    vec3 d9 = ownNormalWS(ivec2(10, tableRow));
    vec3 d10 = ownNormalWS(ivec2(11, tableRow));
    vec3 d11 = ownNormalWS(ivec2(12, tableRow));
    vec3 d12 = ownNormalWS(ivec2(13, tableRow));
    vec3 d13 = ownNormalWS(ivec2(14, tableRow));
    vec3 d14 = ownNormalWS(ivec2(15, tableRow));
    int s = int(d0.x);
    vec3 p = vec3(d0.y, d0.z, d1.x);
    vec3 n = vec3(d1.y, d1.z, d2.x);
    vec3 d = vec3(d2.y, d2.z, d3.x);
    vec3 c = vec3(d3.y, d3.z, d4.x);
    bool t = d4.y > 0.5;
    vec3 h = vec3(d4.z, d5.x, d5.y);
    vec3 bp = vec3(d5.z, d6.x, d6.y);
    vec3 bn = vec3(d6.z, d7.x, d7.y);
    vec3 np = vec3(d7.z, d8.x, d8.y);
    vec3 nn = vec3(d8.z, d9.x, d9.y);
    vec3 fp = vec3(d9.z, d10.x, d10.y);
    vec3 fn = vec3(d10.z, d11.x, d11.y);
    vec3 q = vec3(d11.z, d12.x, d12.y);
    float w = d12.z;
    ProbeWeight r = computeProbeWeight(ProbeInfluence(s, c, tableTurn(t), h, bp, bn, np, nn, fp, fn, q, w), p, n, d);
    check(1, r.volume, d13.x, 1e-05, 1e-05);
    check(2, r.blendNormal, d13.y, 1e-05, 1e-05);
    check(3, r.faceFade, d13.z, 1e-05, 1e-05);
    check(4, r.weight, d14.x, 1e-05, 1e-05);
}

void checkStep(int tableRow)
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
    vec3 d9 = ownNormalWS(ivec2(10, tableRow));
    vec3 d10 = ownNormalWS(ivec2(11, tableRow));
    vec3 d11 = ownNormalWS(ivec2(12, tableRow));
    vec3 d12 = ownNormalWS(ivec2(13, tableRow));
    vec3 d13 = ownNormalWS(ivec2(14, tableRow));
    vec3 d14 = ownNormalWS(ivec2(15, tableRow));
    int s = int(d0.x);
    vec3 p = vec3(d0.y, d0.z, d1.x);
    vec3 n = vec3(d1.y, d1.z, d2.x);
    vec3 d = vec3(d2.y, d2.z, d3.x);
    vec3 c = vec3(d3.y, d3.z, d4.x);
    bool t = d4.y > 0.5;
    vec3 h = vec3(d4.z, d5.x, d5.y);
    vec3 bp = vec3(d5.z, d6.x, d6.y);
    vec3 bn = vec3(d6.z, d7.x, d7.y);
    vec3 np = vec3(d7.z, d8.x, d8.y);
    vec3 nn = vec3(d8.z, d9.x, d9.y);
    vec3 fp = vec3(d9.z, d10.x, d10.y);
    vec3 fn = vec3(d10.z, d11.x, d11.y);
    vec3 q = vec3(d11.z, d12.x, d12.y);
    float w = d12.z;
    ProbeWeight r = computeProbeWeight(ProbeInfluence(s, c, tableTurn(t), h, bp, bn, np, nn, fp, fn, q, w), p, n, d);
    check(101, r.volume, d13.x, 1e-05, 0.003);
    check(102, r.blendNormal, d13.y, 1e-05, 0.003);
    check(103, r.faceFade, d13.z, 1e-05, 0.003);
    check(104, r.weight, d14.x, 1e-05, 0.003);
}

void checkBox(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec3 d4 = ownNormalWS(ivec2(5, tableRow));
    vec3 p = vec3(d0.x, d0.y, d0.z);
    vec3 h = vec3(d1.x, d1.y, d1.z);
    vec3 a = vec3(d2.x, d2.y, d2.z);
    vec3 b = vec3(d3.x, d3.y, d3.z);
    check(201, computeBoxInfluence(p, h, a, b), d4.x, 1e-05, 1e-06);
}

void checkFaceFade(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec3 d = vec3(d0.x, d0.y, d0.z);
    vec3 p = vec3(d1.x, d1.y, d1.z);
    vec3 n = vec3(d2.x, d2.y, d2.z);
    check(301, computeFaceFade(d, p, n), d3.x, 1e-05, 1e-06);
}

void checkColor(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 c = vec3(d0.x, d0.y, d0.z);
    float m = d1.x;
    vec3 r = multiplyProbeColor(c, m);
    check(401, r.x, d1.y, 1e-06, 0);
    check(402, r.y, d1.z, 1e-06, 0);
    check(403, r.z, d2.x, 1e-06, 0);
}

OwnHit traceOwn(OwnRay ray)
{
    int row = ray.pixel.y;
    if (row >= 0 && row <= 451) checkInfluence(row);
    if (row >= 452 && row <= 511) checkStep(row);
    if (row >= 512 && row <= 520) checkBox(row);
    if (row >= 521 && row <= 525) checkFaceFade(row);
    if (row >= 526 && row <= 543) checkColor(row);
    return OwnHit(kHitClassHit, kHitReasonNone, wrongAnswer, float(wrongCheck), number(wrongCheck == 0));
}
