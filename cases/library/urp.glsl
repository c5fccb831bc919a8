// Made by tables.py: functions of the library on the rows of data/. Confidence is 1 where the row's answers are right; else HitDepth
// says which is wrong first (function * 100 + output, from 1), and HitPositionSS what it was and what was expected.
#include "crossray/probe/urp.glsl"

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

void checkWeight(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec3 low = vec3(d0.x, d0.y, d0.z);
    vec3 high = vec3(d1.x, d1.y, d1.z);
    float blend = d2.x;
    vec3 p = vec3(d2.y, d2.z, d3.x);
    check(1, computeUrpWeight(UrpProbe(low, high, blend, 0.0, 0.0, 0), p), d3.y, 1e-05, 1e-06);
}

void checkSize(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 low = vec3(d0.x, d0.y, d0.z);
    vec3 high = vec3(d1.x, d1.y, d1.z);
    int p = int(d2.x);
    check(101, computeUrpSize(UrpProbe(low, high, 0.5, 0.0, 0.0, 0), p), d2.y, 1e-05, 1e-06);
}

void checkOrder(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    int p = int(d0.x);
    vec4 a = vec4(d0.y, d0.z, d1.x, d1.y);
    vec4 b = vec4(d1.z, d2.x, d2.y, d2.z);
    check(201, number(urpProbeComesFirst(UrpProbe(vec3(0.0), vec3(a.x), 0.5, a.y, a.z, int(a.w)), UrpProbe(vec3(0.0), vec3(b.x), 0.5, b.y, b.z, int(b.w)), p)), d3.x, 1e-05, 0);
    check(202, float(computeUrpDominance(UrpProbe(vec3(0.0), vec3(a.x), 0.5, a.y, a.z, int(a.w)), UrpProbe(vec3(0.0), vec3(b.x), 0.5, b.y, b.z, int(b.w)), p)), d3.y, 1e-05, 0);
}

void checkPair(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec3 d4 = ownNormalWS(ivec2(5, tableRow));
    vec3 d5 = ownNormalWS(ivec2(6, tableRow));
    vec3 d6 = ownNormalWS(ivec2(7, tableRow));
    vec3 d7 = ownNormalWS(ivec2(8, tableRow));
    int p = int(d0.x);
    vec4 a = vec4(d0.y, d0.z, d1.x, d1.y);
    vec4 b = vec4(d1.z, d2.x, d2.y, d2.z);
    vec4 c = vec4(d3.x, d3.y, d3.z, d4.x);
    UrpPair pair = offerUrpProbe(makeUrpPair(), UrpProbe(vec3(0.0), vec3(a.x), 0.5, a.y, a.z, int(a.w)), 0, p);
    pair = offerUrpProbe(pair, UrpProbe(vec3(0.0), vec3(b.x), 0.5, b.y, b.z, int(b.w)), 1, p);
    pair = offerUrpProbe(pair, UrpProbe(vec3(0.0), vec3(c.x), 0.5, c.y, c.z, int(c.w)), 2, p);
    check(301, float(pair.first), d4.y, 1e-05, 1e-06);
    check(302, float(pair.second), d4.z, 1e-05, 1e-06);
    check(303, float(pair.firstProbe.index), d5.x, 1e-05, 1e-06);
    check(304, float(pair.secondProbe.index), d5.y, 1e-05, 1e-06);
    check(305, pair.secondProbe.boxMaxWS.y, d5.z, 1e-05, 1e-06);
    check(306, pair.secondProbe.importance, d6.x, 1e-05, 1e-06);
    check(307, pair.secondProbe.coveredArea, d6.y, 1e-05, 1e-06);
    check(308, pair.firstProbe.blendDistance, d6.z, 1e-05, 1e-06);
    check(309, pair.firstProbe.boxMaxWS.z, d7.x, 1e-05, 1e-06);
}

void checkShares(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    float a = d0.x;
    float b = d0.y;
    int d = int(d0.z);
    int p = int(d1.x);
    UrpWeights s = computeUrpShares(a, b, d, p);
    check(401, s.first, d1.y, 1e-05, 1e-06);
    check(402, s.second, d1.z, 1e-05, 1e-06);
    check(403, s.sky, d2.x, 1e-05, 1e-06);
}

void checkSkyWeight(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    float t = d0.x;
    int p = int(d0.y);
    check(501, computeUrpSkyWeight(t, p), d0.z, 1e-05, 1e-06);
}

void checkForwardPlus(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    float t = d0.x;
    float w = d0.y;
    UrpStep s = stepUrpForwardPlus(t, w);
    check(601, s.weight, d0.z, 1e-05, 1e-06);
    check(602, s.total, d1.x, 1e-05, 1e-06);
    check(603, number(s.done), d1.y, 1e-05, 1e-06);
}

void checkPairShares(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec3 d4 = ownNormalWS(ivec2(5, tableRow));
    int p = int(d0.x);
    vec4 a = vec4(d0.y, d0.z, d1.x, d1.y);
    vec4 b = vec4(d1.z, d2.x, d2.y, d2.z);
    float wa = d3.x;
    float wb = d3.y;
    int which = int(d3.z);
    UrpProbe first = UrpProbe(vec3(0.0), vec3(a.x), 0.5, a.y, a.z, int(a.w));
    UrpProbe second = UrpProbe(vec3(0.0), vec3(b.x), 0.5, b.y, b.z, int(b.w));
    first.boxMinWS = vec3(-0.5 * a.x);
    first.boxMaxWS = vec3(0.5 * a.x);
    second.boxMinWS = vec3(-0.5 * b.x);
    second.boxMaxWS = vec3(0.5 * b.x);
    first.blendDistance = 0.5 * a.x / wa;
    second.blendDistance = 0.5 * b.x / wb;
    UrpWeights s = computeUrpPairShares(UrpPair((which & 1) == 1 ? 0 : kUrpNoProbe, which >= 2 ? 1 : kUrpNoProbe, first, second), vec3(0.0), p);
    check(701, s.first, d4.x, 1e-05, 1e-06);
    check(702, s.second, d4.y, 1e-05, 1e-06);
    check(703, s.sky, d4.z, 1e-05, 1e-06);
}

OwnHit traceOwn(OwnRay ray)
{
    int row = ray.pixel.y;
    if (row >= 0 && row <= 84) checkWeight(row);
    if (row >= 85 && row <= 123) checkSize(row);
    if (row >= 124 && row <= 423) checkOrder(row);
    if (row >= 424 && row <= 453) checkPair(row);
    if (row >= 454 && row <= 570) checkShares(row);
    if (row >= 571 && row <= 600) checkSkyWeight(row);
    if (row >= 601 && row <= 672) checkForwardPlus(row);
    if (row >= 673 && row <= 792) checkPairShares(row);
    return OwnHit(kHitClassHit, kHitReasonNone, wrongAnswer, float(wrongCheck), number(wrongCheck == 0));
}
