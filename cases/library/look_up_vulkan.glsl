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

void checkDistanceBased(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    float r = d0.x;
    float h = d0.y;
    float c = d0.z;
    check(1, computeDistanceBasedRoughness(r, h, c), d1.x, 1e-05, 1e-06);
}

void checkKey(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 h = vec3(d0.x, d0.y, d0.z);
    check(101, float(computeHdrpProbeKey(h)), d1.x, 3e-06, 3);
}

OwnHit traceOwn(OwnRay ray)
{
    int row = ray.pixel.y;
    if (row >= 0 && row <= 8) checkDistanceBased(row);
    if (row >= 9 && row <= 11) checkKey(row);
    return OwnHit(kHitClassHit, kHitReasonNone, wrongAnswer, float(wrongCheck), number(wrongCheck == 0));
}
