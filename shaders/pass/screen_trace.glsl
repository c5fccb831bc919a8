// One pixel of the pass screen_trace: the reflected or refracted ray, its projection by one of the models, the screen weight, and
// the debug modes. The variant constants select the code; what a variant does not use is not in it.
// Hooks: fetchDeviceDepth, fetchNormalWS, fetchColor, fetchTraced, loadPyramidCell, storeOutputValue, and the block params;
// bindings/screen_trace.glsl.
#ifndef PASS_SCREEN_TRACE_GLSL
#define PASS_SCREEN_TRACE_GLSL

#include "crossray/core/math.glsl"
#include "crossray/core/ray_ndc.glsl"
#include "crossray/core/reflection.glsl"
#include "crossray/core/view.glsl"
#include "crossray/hierarchy/screen_weight.glsl"
#include "crossray/project/proxy.glsl"
#include "crossray/refract/refraction.glsl"
#include "crossray/shared/outputs.glsl"

// A value of kEffect; kRefractionModel has those of crossray/refract/refraction.glsl, kProjectionModel the tracing models of
// crossray/shared/outputs.glsl.
const int kEffectRefraction = 1;

#include "crossray/project/hiz.glsl"

// The library's hooks for the pyramid, over one buffer of cells.
int depthPyramidLevelCount() { return params.hizLimits.w; }
ivec2 depthPyramidSize(int level) { return ivec2(params.pyramidLevels[level].y, params.pyramidLevels[level].z); }
vec2 fetchDepthPyramid(ivec2 cell, int level)
{
    ivec4 layoutOfLevel = params.pyramidLevels[level];
    return loadPyramidCell(layoutOfLevel.x + cell.y * layoutOfLevel.y + cell.x);
}

// The release build records nothing.
void recordHizStep(HizStep) {}

View loadView()
{
    return View(params.viewFromWorld, params.worldFromView, params.clipFromView, params.imageSizeAndSlope.xy,
                params.imageSizeAndSlope.zw, params.depthTerms.x, params.depthTerms.y, params.depthTerms.z,
                params.depthTerms.w, kOrthographic == 1, kReversedDepth == 1);
}

// What a pixel knows in the end; each debug mode shows a part of it.
struct PixelAnswer {
    int hitClass;
    int reason;
    vec3 rayOriginWS;
    vec3 rayDirWS;
    float pathLength;  // metres in the material
    vec2 positionSS;   // of the hit, or of the end of the ray
    float linearDepth; // of the hit, metres; 0 where there is none
    int iterations;
    int maxUsedLevel;
    int intersectionKind;
};

// The ray that the pixel sends out. Reflection about the shading normal; refraction by the model.
RefractionExit computePixelRay(vec3 positionWS, vec3 normalWS, vec3 viewDirWS)
{
    float ior = params.material.x;
    float thickness = params.material.y;
    if (kEffect == kEffectRefraction) {
        return computeRefraction(kRefractionModel, positionWS, normalWS, viewDirWS, ior, thickness);
    }
    vec3 dirWS = computeReflectionDirection(normalWS, viewDirWS);
    return RefractionExit(positionWS, dirWS, 0.0, dot(dirWS, dirWS) > 0.0 ? kHitReasonNone : kHitReasonDegenerateRay);
}

ProxyHit projectOnProxy(vec3 originWS, vec3 dirWS)
{
    vec3 centerWS = params.proxyCenterWS.xyz;
    if (kProjectionModel == kTracingModelProxyBox) {
        return projectProxyBox(originWS, dirWS, centerWS, mat3(params.worldFromProxy), params.proxyExtents.xyz);
    }
    if (kProjectionModel == kTracingModelProxySphere) {
        return projectProxySphere(originWS, dirWS, centerWS, params.proxyExtents.w);
    }
    return projectProxyInfinite(originWS, dirWS);
}

PixelAnswer answerByProxy(View view, RefractionExit ray)
{
    ProxyHit hit = projectOnProxy(ray.positionWS, ray.dirWS);
    ScreenPosition end = projectWSToSS(view, hit.positionWS);
    bool success = hit.hit && end.inFront;
    int reason = hit.hit ? (end.inFront ? kHitReasonNone : kHitReasonBehindCamera) : hit.reason;
    return PixelAnswer(success ? kHitClassHit : kHitClassMiss, reason, ray.positionWS, ray.dirWS, ray.pathLength,
                       end.positionSS, success ? end.linearDepth : 0.0, 0, 0, 0);
}

PixelAnswer answerByHiz(View view, RefractionExit ray)
{
    HizSettings settings =
        HizSettings(params.hizLimits.x, params.hizLimits.y, params.hizLimits.z, params.tracing.x);
    TraceResult result = traceHiz(view, ray.positionWS, ray.dirWS, settings);
    return PixelAnswer(result.hitClass, result.reason, ray.positionWS, ray.dirWS, ray.pathLength, result.positionSS,
                       result.hitClass == kHitClassHit ? result.linearDepth : 0.0, result.iterations,
                       result.maxUsedLevel, result.intersectionKind);
}

PixelAnswer answerPixel(View view, ivec2 pixel)
{
    vec2 positionSS = vec2(pixel) + vec2(0.5, 0.5);
    float linearDepth = linearDepthFromDevice(view, fetchDeviceDepth(pixel));
    vec3 positionWS = positionWSFromSS(view, positionSS, linearDepth);
    vec3 viewDirWS = viewDirectionWS(view, positionWS);
    RefractionExit ray = computePixelRay(positionWS, fetchNormalWS(pixel), viewDirWS);
    if (ray.status != kHitReasonNone) {
        return PixelAnswer(kHitClassNoRaycast, ray.status, ray.positionWS, ray.dirWS, ray.pathLength, positionSS, 0.0, 0,
                           0, 0);
    }
    if (kProjectionModel == kTracingModelHiz) return answerByHiz(view, ray);
    if (kProjectionModel != kTracingModelNone) return answerByProxy(view, ray);
    // Only the ray is asked for: nothing is cast, so nothing is hit or missed.
    return PixelAnswer(kHitClassNoRaycast, kHitReasonNone, ray.positionWS, ray.dirWS, ray.pathLength, positionSS,
                       0.0, 0, 0, 0);
}

void storeOutput(int id, ivec2 pixel, vec4 value)
{
    int slot = bitCount(kOutputMask & ((1 << id) - 1));
    ivec2 size = ivec2(int(params.imageSizeAndSlope.x), int(params.imageSizeAndSlope.y));
    storeOutputValue((slot * size.y + pixel.y) * size.x + pixel.x, value);
}

bool wantsOutput(int id) { return (kOutputMask & (1 << id)) != 0; }

vec3 fetchColorAt(vec2 positionSS)
{
    ivec2 size = ivec2(int(params.imageSizeAndSlope.x), int(params.imageSizeAndSlope.y));
    return fetchColor(clamp(ivec2(floor(positionSS)), ivec2(0, 0), size - ivec2(1, 1)));
}

void storeAnswer(View view, ivec2 pixel, PixelAnswer answer)
{
    bool hit = answer.hitClass == kHitClassHit;
    float weight = 0.0;
    if (wantsOutput(kOutputHitWeight) || wantsOutput(kOutputColor)) {
        weight = hit ? computeScreenWeight(answer.positionSS / view.imageSize, params.tracing.y, kScreenWeightForm) : 0.0;
    }
    vec3 color = vec3(0.0, 0.0, 0.0);
    if (wantsOutput(kOutputSampledColor) || wantsOutput(kOutputColor)) {
        bool onScreen = all(greaterThanEqual(answer.positionSS, vec2(0.0, 0.0))) &&
                        all(lessThanEqual(answer.positionSS, view.imageSize));
        if (hit && onScreen) color = fetchColorAt(answer.positionSS);
    }
    if (wantsOutput(kOutputColor)) storeOutput(kOutputColor, pixel, vec4(color * weight, 0.0));
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
    if (wantsOutput(kOutputHitWeight)) storeOutput(kOutputHitWeight, pixel, vec4(weight, 0.0, 0.0, 0.0));
    if (wantsOutput(kOutputSampledColor)) storeOutput(kOutputSampledColor, pixel, vec4(color, 0.0));
    if (wantsOutput(kOutputHitPositionSS)) {
        storeOutput(kOutputHitPositionSS, pixel, vec4(hit ? answer.positionSS : vec2(0.0, 0.0), 0.0, 0.0));
    }
    if (wantsOutput(kOutputPathLength)) {
        storeOutput(kOutputPathLength, pixel, vec4(answer.pathLength, 0.0, 0.0, 0.0));
    }
    if (wantsOutput(kOutputRayOriginWS)) storeOutput(kOutputRayOriginWS, pixel, vec4(answer.rayOriginWS, 0.0));
}

void traceScreenPixel(ivec2 pixel)
{
    View view = loadView();
    if (float(pixel.x) >= view.imageSize.x || float(pixel.y) >= view.imageSize.y) return;
    if (!fetchTraced(pixel)) {
        vec3 none = vec3(0.0, 0.0, 0.0);
        storeAnswer(view, pixel,
                    PixelAnswer(kHitClassNoRaycast, kHitReasonNone, none, none, 0.0, vec2(0.0, 0.0), 0.0, 0, 0, 0));
        return;
    }
    storeAnswer(view, pixel, answerPixel(view, pixel));
}

#endif
