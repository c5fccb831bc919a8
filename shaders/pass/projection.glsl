// What a pixel's ray meets: a proxy's surface or, in screen space, a surface that the depth buffer shows. kProjectionModel has the
// tracing models of crossray/shared/outputs.glsl. Hooks: fetchDeviceDepth, loadPyramidCell, loadSurfaceCell, the invocation's own
// int fetchCount, and the block params.
#ifndef PASS_PROJECTION_GLSL
#define PASS_PROJECTION_GLSL

#include "crossray/core/view.glsl"
#include "crossray/project/hiz.glsl"
#include "crossray/project/linear.glsl"
#include "crossray/project/patch_tracer.glsl"
#include "crossray/project/proxy.glsl"
#include "crossray/refract/refraction.glsl"
#include "crossray/shared/outputs.glsl"
#include "pass/output_slots.glsl"
#include "pass/pixel_record.glsl"
#include "pass/view_of_params.glsl"

// Called by each hook that a tracer reads by.
void countFetch()
{
    if (wantsOutput(kOutputFetchCount)) fetchCount = fetchCount + 1;
}

// The library's hooks for the pyramid, over one buffer of cells.
int depthPyramidLevelCount() { return params.hizLimits.w; }
ivec2 depthPyramidSize(int level) { return ivec2(params.pyramidLevels[level].y, params.pyramidLevels[level].z); }
vec2 fetchDepthPyramid(ivec2 cell, int level)
{
    countFetch();
    ivec4 layoutOfLevel = params.pyramidLevels[level];
    return loadPyramidCell(layoutOfLevel.x + cell.y * layoutOfLevel.y + cell.x);
}

// The depth of a pixel, for the linear march.
float fetchLinearDepth(ivec2 pixel)
{
    countFetch();
    View view = loadView();
    float deviceDepth = fetchDeviceDepth(pixel);
    return choose(isClearedDepth(view, deviceDepth), kNoSurfaceDepth, linearDepthFromDevice(view, deviceDepth));
}

// And for the pyramid of planes, which has the same levels.
int surfacePyramidLevelCount() { return params.hizLimits.w; }
ivec2 surfacePyramidSize(int level) { return depthPyramidSize(level); }
vec4 fetchSurfaceCell(ivec2 cell, int level)
{
    countFetch();
    ivec4 layoutOfLevel = params.pyramidLevels[level];
    return loadSurfaceCell(layoutOfLevel.x + cell.y * layoutOfLevel.y + cell.x);
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
    float confidence; // of a hit, [0,1]; 1 where the model does not say
};

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

PixelAnswer answerOfProxyHit(View view, RefractionExit ray, ProxyHit hit)
{
    recordProxyHit(hit);
    ScreenPosition end = projectWSToSS(view, hit.positionWS);
    bool success = hit.hit && end.inFront;
    int reason = hit.hit ? (end.inFront ? kHitReasonNone : kHitReasonBehindCamera) : hit.reason;
    return PixelAnswer(success ? kHitClassHit : kHitClassMiss, reason, ray.positionWS, ray.dirWS, ray.pathLength,
                       end.positionSS, success ? end.linearDepth : 0.0, 0, 0, 0, success ? 1.0 : 0.0);
}

PixelAnswer answerByProxy(View view, RefractionExit ray)
{
    return answerOfProxyHit(view, ray, projectOnProxy(ray.positionWS, ray.dirWS));
}

PixelAnswer answerByHiz(View view, RefractionExit ray)
{
    HizSettings settings =
        HizSettings(params.hizLimits.x, params.hizLimits.y, params.hizLimits.z, params.tracing.x);
    TraceResult result = traceHiz(view, ray.positionWS, ray.dirWS, settings);
    return PixelAnswer(result.hitClass, result.reason, ray.positionWS, ray.dirWS, ray.pathLength, result.positionSS,
                       result.hitClass == kHitClassHit ? result.linearDepth : 0.0, result.iterations,
                       result.maxUsedLevel, result.intersectionKind,
                       result.hitClass == kHitClassHit ? 1.0 : 0.0);
}

PixelAnswer answerByLinear(View view, RefractionExit ray)
{
    LinearSettings settings = LinearSettings(params.linearTracing.x, params.linearLimits.x, params.linearLimits.y,
                                             params.linearTracing.y, params.linearLimits.z);
    LinearResult result = traceLinear(view, ray.positionWS, ray.dirWS, settings);
    return PixelAnswer(result.hitClass, result.reason, ray.positionWS, ray.dirWS, ray.pathLength, result.positionSS,
                       result.hitClass == kHitClassHit ? result.linearDepth : 0.0, result.iterations, 0,
                       result.intersectionKind, result.hitClass == kHitClassHit ? 1.0 : 0.0);
}

PixelAnswer answerByPatches(View view, RefractionExit ray)
{
    PatchTracerSettings settings =
        PatchTracerSettings(params.hizLimits.y, params.hizLimits.z, params.patches.x, params.patches.y);
    PatchTraceResult result = tracePatches(view, ray.positionWS, ray.dirWS, settings);
    return PixelAnswer(result.hitClass, result.reason, ray.positionWS, ray.dirWS, ray.pathLength, result.positionSS,
                       result.hitClass == kHitClassHit ? result.linearDepth : 0.0, result.iterations,
                       result.maxUsedLevel, result.intersectionKind, result.confidence);
}

#ifdef CROSSRAY_OWN_TRACER
#include "pass/own_tracer.glsl"
#endif

// What the ray of a pixel meets, by the variant's model. `positionSS` is the pixel's own, where a ray that is not cast ends.
PixelAnswer projectRay(View view, RefractionExit ray, vec2 positionSS)
{
    if (ray.status != kHitReasonNone) {
        return PixelAnswer(kHitClassNoRaycast, ray.status, ray.positionWS, ray.dirWS, ray.pathLength, positionSS, 0.0, 0,
                           0, 0, 0.0);
    }
    if (kProjectionModel == kTracingModelHiz) return answerByHiz(view, ray);
    if (kProjectionModel == kTracingModelLinear) return answerByLinear(view, ray);
    if (kProjectionModel == kTracingModelPatches) return answerByPatches(view, ray);
#ifdef CROSSRAY_OWN_TRACER
    if (kProjectionModel == kTracingModelOwn) return answerByOwn(view, ray, positionSS);
#endif
    if (kProjectionModel != kTracingModelNone) return answerByProxy(view, ray);
    // Only the ray is asked for: nothing is cast, so nothing is hit or missed.
    return PixelAnswer(kHitClassNoRaycast, kHitReasonNone, ray.positionWS, ray.dirWS, ray.pathLength, positionSS,
                       0.0, 0, 0, 0, 0.0);
}

#endif
