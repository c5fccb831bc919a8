// One pixel of the pass screen_trace: the reflected or refracted ray, its projection by one of the models, the screen weight, and
// the debug modes. The variant constants select the code; what a variant does not use is not in it.
// Hooks: fetchDeviceDepth, fetchNormalWS, fetchColor, fetchTraced, fetchThickness, fetchMotionUV, fetchProbeAtlas, loadPyramidCell,
// loadSurfaceCell, loadColorCell, storeOutputValue, storeRecordValue, the blocks params and probeParams, and fetchCount;
// bindings/screen_trace.glsl.
#ifndef PASS_SCREEN_TRACE_GLSL
#define PASS_SCREEN_TRACE_GLSL

#include "pass/output_slots.glsl"
#include "pass/view_of_params.glsl"

#include "pass/pixel_surface.glsl"
#include "pass/pixel_ray.glsl"
#include "pass/projection.glsl"

#include "pass/composite.glsl"
#include "pass/pixel_color.glsl"
#include "pass/hierarchy.glsl"
#include "pass/probe_projection.glsl"
#include "pass/store_outputs.glsl"

PixelAnswer answerPixel(View view, PixelSurface surface, float thickness)
{
    RefractionExit ray = computePixelRay(surface.positionWS, surface.normalWS, surface.viewDirWS, thickness);
    recordRay(view, ray.positionWS, ray.dirWS, ray.pathLength);
    if (kProjectionModel == kTracingModelProxyProbe && ray.status == kHitReasonNone) {
        return answerByProbeProxy(view, surface, ray);
    }
    return projectRay(view, ray, surface.positionSS);
}

PixelAnswer answerUntraced()
{
    vec3 none = vec3(0.0, 0.0, 0.0);
    return PixelAnswer(kHitClassNoRaycast, kHitReasonNone, none, none, 0.0, vec2(0.0, 0.0), 0.0, 0, 0, 0, 0.0);
}

void recordAnswer(bool isTraced, PixelAnswer answer, ScreenColor screen)
{
    if (kRecordPixel != 1) return;
    storeRecordValue(kRecordClass, vec4(float(kProjectionModel), float(answer.hitClass), float(answer.reason),
                                        isTraced ? 1.0 : 0.0));
    storeRecordValue(kRecordEnd, vec4(answer.positionSS, answer.linearDepth, screen.weight));
    storeRecordValue(kRecordColor, vec4(screen.color, screen.weight));
    storeRecordValue(kRecordCounts, vec4(float(answer.iterations), float(answer.maxUsedLevel),
                                         float(answer.intersectionKind), answer.confidence));
}

// The variant that records a pixel traces it in its first invocation, and nothing in the others.
void traceScreenPixel(ivec2 invocation)
{
    bool isFirst = invocation.x == 0 && invocation.y == 0;
    if (kRecordPixel == 1 && !isFirst) return;
    ivec2 pixel = kRecordPixel == 1 ? ivec2(params.record.x, params.record.y) : invocation;
    View view = loadView();
    if (float(pixel.x) >= view.imageSize.x || float(pixel.y) >= view.imageSize.y) return;
    if (!fetchTraced(pixel)) {
        recordAnswer(false, answerUntraced(), noScreenColor());
        storeAnswer(view, pixel, answerUntraced(), noScreenColor(), answerNothing(), noPixelShare());
        return;
    }
    PixelSurface surface = loadPixelSurface(view, pixel);
    PixelAnswer answer = answerPixel(view, surface, computePixelThickness(pixel));
    ScreenColor screen = computeScreenColor(view, surface, answer);
    HierarchyAnswer tiers = answerNothing();
    if (wantsHierarchy()) tiers = askTiers(view, surface, answer, screen);
    recordAnswer(true, answer, screen);
    storeAnswer(view, pixel, answer, screen, tiers, computePixelShare(surface, answer));
    if (kProjectionModel == kTracingModelProxyProbe && wantsOutput(kOutputTracingModel)) {
        storeOutput(kOutputTracingModel, pixel, vec4(float(findProxyModel(surface, answer.rayDirWS)), 0.0, 0.0, 0.0));
    }
}

#endif
