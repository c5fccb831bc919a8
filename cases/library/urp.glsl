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
    vec3 d8 = ownNormalWS(ivec2(9, tableRow));
    vec3 d9 = ownNormalWS(ivec2(10, tableRow));
    vec3 d10 = ownNormalWS(ivec2(11, tableRow));
    vec3 d11 = ownNormalWS(ivec2(12, tableRow));
    int p = int(d0.x);
    vec4 a = vec4(d0.y, d0.z, d1.x, d1.y);
    vec4 b = vec4(d1.z, d2.x, d2.y, d2.z);
    vec4 c = vec4(d3.x, d3.y, d3.z, d4.x);
    UrpPair pair = offerUrpProbe(makeUrpPair(), UrpProbe(a.w * vec3(1.0, 2.0, 3.0), a.w * vec3(1.0, 2.0, 3.0) + vec3(a.x), 0.5 + a.w, a.y, a.z, int(a.w)), 0, p);
    pair = offerUrpProbe(pair, UrpProbe(b.w * vec3(1.0, 2.0, 3.0), b.w * vec3(1.0, 2.0, 3.0) + vec3(b.x), 0.5 + b.w, b.y, b.z, int(b.w)), 1, p);
    pair = offerUrpProbe(pair, UrpProbe(c.w * vec3(1.0, 2.0, 3.0), c.w * vec3(1.0, 2.0, 3.0) + vec3(c.x), 0.5 + c.w, c.y, c.z, int(c.w)), 2, p);
    check(301, float(pair.first), d4.y, 1e-05, 1e-06);
    check(302, float(pair.second), d4.z, 1e-05, 1e-06);
    check(303, float(pair.firstProbe.boxMinWS.x), d5.x, 1e-05, 1e-06);
    check(304, float(pair.firstProbe.boxMinWS.y), d5.y, 1e-05, 1e-06);
    check(305, float(pair.firstProbe.boxMinWS.z), d5.z, 1e-05, 1e-06);
    check(306, float(pair.firstProbe.boxMaxWS.x), d6.x, 1e-05, 1e-06);
    check(307, float(pair.firstProbe.boxMaxWS.y), d6.y, 1e-05, 1e-06);
    check(308, float(pair.firstProbe.boxMaxWS.z), d6.z, 1e-05, 1e-06);
    check(309, float(pair.firstProbe.blendDistance), d7.x, 1e-05, 1e-06);
    check(310, float(pair.firstProbe.importance), d7.y, 1e-05, 1e-06);
    check(311, float(pair.firstProbe.coveredArea), d7.z, 1e-05, 1e-06);
    check(312, float(pair.firstProbe.index), d8.x, 1e-05, 1e-06);
    check(313, float(pair.secondProbe.boxMinWS.x), d8.y, 1e-05, 1e-06);
    check(314, float(pair.secondProbe.boxMinWS.y), d8.z, 1e-05, 1e-06);
    check(315, float(pair.secondProbe.boxMinWS.z), d9.x, 1e-05, 1e-06);
    check(316, float(pair.secondProbe.boxMaxWS.x), d9.y, 1e-05, 1e-06);
    check(317, float(pair.secondProbe.boxMaxWS.y), d9.z, 1e-05, 1e-06);
    check(318, float(pair.secondProbe.boxMaxWS.z), d10.x, 1e-05, 1e-06);
    check(319, float(pair.secondProbe.blendDistance), d10.y, 1e-05, 1e-06);
    check(320, float(pair.secondProbe.importance), d10.z, 1e-05, 1e-06);
    check(321, float(pair.secondProbe.coveredArea), d11.x, 1e-05, 1e-06);
    check(322, float(pair.secondProbe.index), d11.y, 1e-05, 1e-06);
}

void checkNearly(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    int p = int(d0.x);
    vec3 x = vec3(d0.y, d0.z, d1.x);
    check(401, float(computeUrpDominance(UrpProbe(vec3(0.0), x, 0.5, 1.0, 1.0, 0), UrpProbe(vec3(0.0), vec3(0.0), 0.5, 1.0, 1.0, 1), p)), d1.y, 1e-05, 0);
    check(402, float(computeUrpDominance(UrpProbe(vec3(0.0), vec3(0.0), 0.5, 1.0, 1.0, 1), UrpProbe(vec3(0.0), x, 0.5, 1.0, 1.0, 0), p)), d1.z, 1e-05, 0);
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
    check(501, s.first, d1.y, 1e-05, 1e-06);
    check(502, s.second, d1.z, 1e-05, 1e-06);
    check(503, s.sky, d2.x, 1e-05, 1e-06);
}

void checkSkyWeight(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    float t = d0.x;
    int p = int(d0.y);
    check(601, computeUrpSkyWeight(t, p), d0.z, 1e-05, 1e-06);
}

void checkForwardPlus(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    float t = d0.x;
    float w = d0.y;
    UrpStep s = stepUrpForwardPlus(t, w);
    check(701, s.weight, d0.z, 1e-05, 1e-06);
    check(702, s.total, d1.x, 1e-05, 1e-06);
    check(703, number(s.done), d1.y, 1e-05, 1e-06);
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
    check(801, s.first, d4.x, 1e-05, 1e-06);
    check(802, s.second, d4.y, 1e-05, 1e-06);
    check(803, s.sky, d4.z, 1e-05, 1e-06);
}

OwnHit traceOwn(OwnRay ray)
{
    int row = ray.pixel.y;
    if (row >= 0 && row <= 86) checkWeight(row);
    if (row >= 87 && row <= 131) checkSize(row);
    if (row >= 132 && row <= 431) checkOrder(row);
    if (row >= 432 && row <= 470) checkPair(row);
    if (row >= 471 && row <= 474) checkNearly(row);
    if (row >= 475 && row <= 591) checkShares(row);
    if (row >= 592 && row <= 621) checkSkyWeight(row);
    if (row >= 622 && row <= 693) checkForwardPlus(row);
    if (row >= 694 && row <= 813) checkPairShares(row);
    return OwnHit(kHitClassHit, kHitReasonNone, wrongAnswer, float(wrongCheck), number(wrongCheck == 0));
}
