// The debug modes as raw planes, each only where the variant asks for it. Hooks: those of pass/output_slots.glsl.
#ifndef PASS_STORE_OUTPUTS_GLSL
#define PASS_STORE_OUTPUTS_GLSL

#include "crossray/core/ray_ndc.glsl"
#include "pass/output_slots.glsl"
#include "pass/composite.glsl"
#include "pass/hierarchy.glsl"
#include "pass/pixel_color.glsl"
#include "pass/projection.glsl"

void storeAnswer(View view, ivec2 pixel, PixelAnswer answer, ScreenColor screen, HierarchyAnswer tiers,
                 PixelShare share)
{
    bool hit = answer.hitClass == kHitClassHit;
    vec3 color = kHierarchy != 0 ? tiers.color : screen.color * screen.weight;
    if (wantsOutput(kOutputColor)) storeOutput(kOutputColor, pixel, vec4(color * share.composite, 0.0));
    if (wantsOutput(kOutputRayDirWS)) storeOutput(kOutputRayDirWS, pixel, vec4(answer.rayDirWS, 0.0));
    if (wantsOutput(kOutputHitDepth)) storeOutput(kOutputHitDepth, pixel, vec4(answer.linearDepth, 0.0, 0.0, 0.0));
    if (wantsOutput(kOutputHitSuccess)) {
        storeOutput(kOutputHitSuccess, pixel, vec4(float(answer.hitClass), 0.0, 0.0, 0.0));
    }
    if (wantsOutput(kOutputHitReason)) {
        storeOutput(kOutputHitReason, pixel, vec4(float(answer.reason), 0.0, 0.0, 0.0));
    }
    if (wantsOutput(kOutputTracingModel)) {
        storeOutput(kOutputTracingModel, pixel, vec4(float(kProjectionModel), 0.0, 0.0, 0.0));
    }
    if (wantsOutput(kOutputPositionNDC)) {
        storeOutput(kOutputPositionNDC, pixel, vec4(positionNDCFromSS(view, answer.positionSS), 0.0, 0.0));
    }
    if (wantsOutput(kOutputRayDirNDC)) {
        storeOutput(kOutputRayDirNDC, pixel, vec4(computeRayDirNDC(view, answer.rayOriginWS, answer.rayDirWS), 0.0));
    }
    if (wantsOutput(kOutputIterationCount)) {
        storeOutput(kOutputIterationCount, pixel, vec4(float(answer.iterations), 0.0, 0.0, 0.0));
    }
    if (wantsOutput(kOutputMaxUsedMipLevel)) {
        storeOutput(kOutputMaxUsedMipLevel, pixel, vec4(float(answer.maxUsedLevel), 0.0, 0.0, 0.0));
    }
    if (wantsOutput(kOutputIntersectionKind)) {
        storeOutput(kOutputIntersectionKind, pixel, vec4(float(answer.intersectionKind), 0.0, 0.0, 0.0));
    }
    if (wantsOutput(kOutputHitWeight)) storeOutput(kOutputHitWeight, pixel, vec4(screen.weight, 0.0, 0.0, 0.0));
    if (wantsOutput(kOutputSampledColor)) storeOutput(kOutputSampledColor, pixel, vec4(screen.color, 0.0));
    if (wantsOutput(kOutputHitPositionSS)) {
        storeOutput(kOutputHitPositionSS, pixel, vec4(hit ? answer.positionSS : vec2(0.0, 0.0), 0.0, 0.0));
    }
    if (wantsOutput(kOutputPathLength)) {
        storeOutput(kOutputPathLength, pixel, vec4(answer.pathLength, 0.0, 0.0, 0.0));
    }
    if (wantsOutput(kOutputConfidence)) {
        storeOutput(kOutputConfidence, pixel, vec4(answer.confidence, 0.0, 0.0, 0.0));
    }
    if (wantsOutput(kOutputRayOriginWS)) storeOutput(kOutputRayOriginWS, pixel, vec4(answer.rayOriginWS, 0.0));
    if (wantsOutput(kOutputTierWeights)) storeOutput(kOutputTierWeights, pixel, tiers.tierWeights);
    if (wantsOutput(kOutputProbeWeights)) storeOutput(kOutputProbeWeights, pixel, tiers.probeWeights);
    if (wantsOutput(kOutputProbeDirWS)) storeOutput(kOutputProbeDirWS, pixel, vec4(tiers.probeDirWS, 0.0));
    if (wantsOutput(kOutputPlanarUV)) storeOutput(kOutputPlanarUV, pixel, vec4(tiers.planar.positionUV, 0.0, 0.0));
    if (wantsOutput(kOutputPlanarStatus)) {
        storeOutput(kOutputPlanarStatus, pixel, vec4(float(tiers.planar.status), 0.0, 0.0, 0.0));
    }
    if (wantsOutput(kOutputProbeMipLevel)) {
        storeOutput(kOutputProbeMipLevel, pixel, vec4(tiers.probeMipLevel, 0.0, 0.0, 0.0));
    }
    if (wantsOutput(kOutputTransmittance)) storeOutput(kOutputTransmittance, pixel, vec4(share.transmittance, 0.0));
    if (wantsOutput(kOutputColorMipLevel)) {
        storeOutput(kOutputColorMipLevel, pixel, vec4(screen.mipLevel, 0.0, 0.0, 0.0));
    }
    if (wantsOutput(kOutputFetchCount)) storeOutput(kOutputFetchCount, pixel, vec4(float(fetchCount), 0.0, 0.0, 0.0));
    if (wantsOutput(kOutputHistoryUV)) storeOutput(kOutputHistoryUV, pixel, vec4(screen.historyUV, 0.0, 0.0));
}

#endif
