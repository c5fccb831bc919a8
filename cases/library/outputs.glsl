// Made by tables.py: functions of the library on the rows of data/. Confidence is 1 where the row's answers are right; else HitDepth
// says which is wrong first (function * 100 + output, from 1), and HitPositionSS what it was and what was expected.
#include "crossray/shared/outputs.glsl"

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

void checkOutput(int tableRow)
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
    float x = d0.x;
    check(1, float(kOutputColor) * x, d0.y, 0, 0);
    check(2, float(kOutputRayDirWS) * x, d0.z, 0, 0);
    check(3, float(kOutputHitDepth) * x, d1.x, 0, 0);
    check(4, float(kOutputHitSuccess) * x, d1.y, 0, 0);
    check(5, float(kOutputHitReason) * x, d1.z, 0, 0);
    check(6, float(kOutputTracingModel) * x, d2.x, 0, 0);
    check(7, float(kOutputPositionNDC) * x, d2.y, 0, 0);
    check(8, float(kOutputRayDirNDC) * x, d2.z, 0, 0);
    check(9, float(kOutputIterationCount) * x, d3.x, 0, 0);
    check(10, float(kOutputMaxUsedMipLevel) * x, d3.y, 0, 0);
    check(11, float(kOutputIntersectionKind) * x, d3.z, 0, 0);
    check(12, float(kOutputHitWeight) * x, d4.x, 0, 0);
    check(13, float(kOutputSampledColor) * x, d4.y, 0, 0);
    check(14, float(kOutputHitPositionSS) * x, d4.z, 0, 0);
    check(15, float(kOutputPathLength) * x, d5.x, 0, 0);
    check(16, float(kOutputRayOriginWS) * x, d5.y, 0, 0);
    check(17, float(kOutputTierWeights) * x, d5.z, 0, 0);
    check(18, float(kOutputProbeWeights) * x, d6.x, 0, 0);
    check(19, float(kOutputProbeDirWS) * x, d6.y, 0, 0);
    check(20, float(kOutputProbeMipLevel) * x, d6.z, 0, 0);
    check(21, float(kOutputConfidence) * x, d7.x, 0, 0);
    check(22, float(kOutputPlanarUV) * x, d7.y, 0, 0);
    check(23, float(kOutputPlanarStatus) * x, d7.z, 0, 0);
    check(24, float(kOutputTransmittance) * x, d8.x, 0, 0);
    check(25, float(kOutputColorMipLevel) * x, d8.y, 0, 0);
    check(26, float(kOutputHistoryUV) * x, d8.z, 0, 0);
    check(27, float(kOutputFetchCount) * x, d9.x, 0, 0);
    check(28, float(kOutputCount) * x, d9.y, 0, 0);
}

void checkHitClass(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    float x = d0.x;
    check(101, float(kHitClassNoRaycast) * x, d0.y, 0, 0);
    check(102, float(kHitClassHit) * x, d0.z, 0, 0);
    check(103, float(kHitClassMiss) * x, d1.x, 0, 0);
    check(104, float(kHitClassUnknown) * x, d1.y, 0, 0);
}

void checkHitReason(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec3 d4 = ownNormalWS(ivec2(5, tableRow));
    float x = d0.x;
    check(201, float(kHitReasonNone) * x, d0.y, 0, 0);
    check(202, float(kHitReasonIterationCap) * x, d0.z, 0, 0);
    check(203, float(kHitReasonOffScreen) * x, d1.x, 0, 0);
    check(204, float(kHitReasonBehindSurface) * x, d1.y, 0, 0);
    check(205, float(kHitReasonNearPlane) * x, d1.z, 0, 0);
    check(206, float(kHitReasonBehindCamera) * x, d2.x, 0, 0);
    check(207, float(kHitReasonNoProxyHit) * x, d2.y, 0, 0);
    check(208, float(kHitReasonSky) * x, d2.z, 0, 0);
    check(209, float(kHitReasonNoRefractedRay) * x, d3.x, 0, 0);
    check(210, float(kHitReasonDegenerateRay) * x, d3.y, 0, 0);
    check(211, float(kHitReasonDegenerateInput) * x, d3.z, 0, 0);
    check(212, float(kHitReasonCount) * x, d4.x, 0, 0);
}

void checkTracingModel(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    float x = d0.x;
    check(301, float(kTracingModelNone) * x, d0.y, 0, 0);
    check(302, float(kTracingModelProxyInfinite) * x, d0.z, 0, 0);
    check(303, float(kTracingModelProxyBox) * x, d1.x, 0, 0);
    check(304, float(kTracingModelProxySphere) * x, d1.y, 0, 0);
    check(305, float(kTracingModelHiz) * x, d1.z, 0, 0);
    check(306, float(kTracingModelLinear) * x, d2.x, 0, 0);
    check(307, float(kTracingModelPatches) * x, d2.y, 0, 0);
    check(308, float(kTracingModelProxyProbe) * x, d2.z, 0, 0);
    check(309, float(kTracingModelOwn) * x, d3.x, 0, 0);
}

void checkIntersection(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    float x = d0.x;
    check(401, float(kIntersectionNone) * x, d0.y, 0, 0);
    check(402, float(kIntersectionCell) * x, d0.z, 0, 0);
    check(403, float(kIntersectionDepth) * x, d1.x, 0, 0);
}

void checkRefraction(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    float x = d0.x;
    check(501, float(kRefractionNone) * x, d0.y, 0, 0);
    check(502, float(kRefractionSphere) * x, d0.z, 0, 0);
    check(503, float(kRefractionBox) * x, d1.x, 0, 0);
    check(504, float(kRefractionThin) * x, d1.y, 0, 0);
}

void checkFresnel(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    float x = d0.x;
    check(601, float(kFresnelNone) * x, d0.y, 0, 0);
    check(602, float(kFresnelExact) * x, d0.z, 0, 0);
    check(603, float(kFresnelSchlick) * x, d1.x, 0, 0);
}

void checkScreenWeight(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    float x = d0.x;
    check(701, float(kScreenWeightLinear) * x, d0.y, 0, 0);
    check(702, float(kScreenWeightSmooth2018) * x, d0.z, 0, 0);
    check(703, float(kScreenWeightSmoothToday) * x, d1.x, 0, 0);
}

OwnHit traceOwn(OwnRay ray)
{
    int row = ray.pixel.y;
    if (row >= 0 && row <= 0) checkOutput(row);
    if (row >= 1 && row <= 1) checkHitClass(row);
    if (row >= 2 && row <= 2) checkHitReason(row);
    if (row >= 3 && row <= 3) checkTracingModel(row);
    if (row >= 4 && row <= 4) checkIntersection(row);
    if (row >= 5 && row <= 5) checkRefraction(row);
    if (row >= 6 && row <= 6) checkFresnel(row);
    if (row >= 7 && row <= 7) checkScreenWeight(row);
    return OwnHit(kHitClassHit, kHitReasonNone, wrongAnswer, float(wrongCheck), number(wrongCheck == 0));
}
