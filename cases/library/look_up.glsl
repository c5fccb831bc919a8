// Made by tables.py: functions of the library on the rows of data/. Confidence is 1 where the row's answers are right; else HitDepth
// says which is wrong first (function * 100 + output, from 1), and HitPositionSS what it was and what was expected.
#include "crossray/probe/roughness.glsl"
#include "crossray/probe/rgbm.glsl"
#include "crossray/probe/sky.glsl"
#include "crossray/probe/two_probes.glsl"
#include "crossray/probe/hdrp_order.glsl"
#include "crossray/project/color_pyramid.glsl"

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

void checkMips(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    float r = d0.x;
    int n = int(d0.y);
    check(1, computeReflectionMip(r, n), d0.z, 3e-05, 2e-06);
    check(2, computeRefractionMip(r, n), d1.x, 3e-05, 2e-06);
    check(3, computeProbeMip(r, n), d1.y, 3e-05, 2e-06);
    check(4, computeBuiltInMip(r), d1.z, 3e-05, 2e-06);
    check(5, computeBuiltInMipExact(r), d2.x, 3e-05, 2e-06);
    check(6, computeReflectionColorLevel(r, n), d2.y, 3e-05, 2e-06);
    check(7, computeRefractionColorLevel(r, n), d2.z, 3e-05, 2e-06);
}

void checkDistanceBased(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    float r = d0.x;
    float h = d0.y;
    float c = d0.z;
    check(101, computeDistanceBasedRoughness(r, h, c), d1.x, 1e-05, 1e-06);
}

void checkDominant(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec3 d4 = ownNormalWS(ivec2(5, tableRow));
    vec3 n = vec3(d0.x, d0.y, d0.z);
    vec3 m = vec3(d1.x, d1.y, d1.z);
    vec3 v = vec3(d2.x, d2.y, d2.z);
    float r = d3.x;
    int form = int(d3.y);
    vec3 d = computeDominantDirection(n, m, v, r, form);
    check(201, d.x, d3.z, 1e-05, 4e-06);
    check(202, d.y, d4.x, 1e-05, 4e-06);
    check(203, d.z, d4.y, 1e-05, 4e-06);
}

void checkRgbm(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec3 d4 = ownNormalWS(ivec2(5, tableRow));
    vec4 t = vec4(d0.x, d0.y, d0.z, d1.x);
    vec4 d = vec4(d1.y, d1.z, d2.x, d2.y);
    vec3 a = decodeRgbmLinear(t, d);
    vec3 b = decodeRgbmGamma(t, d);
    check(301, a.x, d2.z, 3e-05, 1e-06);
    check(302, a.y, d3.x, 3e-05, 1e-06);
    check(303, a.z, d3.y, 3e-05, 1e-06);
    check(304, b.x, d3.z, 3e-05, 1e-06);
    check(305, b.y, d4.x, 3e-05, 1e-06);
    check(306, b.z, d4.y, 3e-05, 1e-06);
}

void checkSky(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec3 up = vec3(d0.x, d0.y, d0.z);
    float s = d1.x;
    vec3 d = vec3(d1.y, d1.z, d2.x);
    vec3 c = evaluateGradientSky(GradientSky(vec3(1.0, 2.0, 3.0), vec3(4.0, 5.5, 6.25), vec3(7.0, 9.0, 11.0), up, s), d);
    check(401, c.x, d2.y, 1e-05, 4e-06);
    check(402, c.y, d2.z, 1e-05, 4e-06);
    check(403, c.z, d3.x, 1e-05, 4e-06);
}

void checkTwoProbes(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    float w = d0.x;
    vec3 c = blendTwoProbes(vec3(1.0, 2.0, 3.0), vec3(5.0, 7.0, 11.0), w);
    check(501, number(needsSecondProbe(w)), d0.y, 1e-05, 1e-06);
    check(502, computeTwoProbeWeights(w).first, d0.z, 1e-05, 1e-06);
    check(503, computeTwoProbeWeights(w).second, d1.x, 1e-05, 1e-06);
    check(504, c.x, d1.y, 1e-05, 1e-06);
    check(505, c.y, d1.z, 1e-05, 1e-06);
    check(506, c.z, d2.x, 1e-05, 1e-06);
}

void checkLargestKey(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 h = vec3(d0.x, d0.y, d0.z);
    check(601, float(computeHdrpProbeKey(h)), d1.x, 0, 0);
}

void checkTwoColors(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec3 a = vec3(d0.x, d0.y, d0.z);
    vec3 b = vec3(d1.x, d1.y, d1.z);
    float w = d2.x;
    vec3 c = blendTwoProbes(a, b, w);
    check(701, c.x, d2.y, 1e-05, 1e-06);
    check(702, c.y, d2.z, 1e-05, 1e-06);
    check(703, c.z, d3.x, 1e-05, 1e-06);
}

void checkKey(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 h = vec3(d0.x, d0.y, d0.z);
    check(801, float(computeHdrpProbeKey(h)), d1.x, 3e-06, 3);
}

void checkOrder(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    int a = int(d0.x);
    int i = int(d0.y);
    int b = int(d0.z);
    int j = int(d1.x);
    check(901, number(hdrpProbeComesFirst(a, i, b, j)), d1.y, 1e-05, 1e-06);
}

void checkColorTexel(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 c = vec3(d0.x, d0.y, d0.z);
    vec4 t = makeColorPyramidTexel(c);
    check(1001, t.x, d1.x, 1e-05, 0);
    check(1002, t.y, d1.y, 1e-05, 0);
    check(1003, t.z, d1.z, 1e-05, 0);
    check(1004, t.w, d2.x, 1e-05, 0);
}

OwnHit traceOwn(OwnRay ray)
{
    int row = ray.pixel.y;
    if (row >= 0 && row <= 54) checkMips(row);
    if (row >= 55 && row <= 124) checkDistanceBased(row);
    if (row >= 125 && row <= 316) checkDominant(row);
    if (row >= 317 && row <= 339) checkRgbm(row);
    if (row >= 340 && row <= 403) checkSky(row);
    if (row >= 404 && row <= 416) checkTwoProbes(row);
    if (row >= 417 && row <= 418) checkLargestKey(row);
    if (row >= 419 && row <= 422) checkTwoColors(row);
    if (row >= 423 && row <= 444) checkKey(row);
    if (row >= 445 && row <= 460) checkOrder(row);
    if (row >= 461 && row <= 469) checkColorTexel(row);
    return OwnHit(kHitClassHit, kHitReasonNone, wrongAnswer, float(wrongCheck), number(wrongCheck == 0));
}
