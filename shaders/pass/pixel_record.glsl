// All that one pixel's ray did: a header and every step of the march, for `crossray trace`. A variant with kRecordPixel traces
// that pixel alone; in any other variant the hooks are empty, and nothing of this file is in its code.
// Hooks: storeRecordValue, and the block params.
#ifndef PASS_PIXEL_RECORD_GLSL
#define PASS_PIXEL_RECORD_GLSL

#include "crossray/core/view.glsl"
#include "crossray/project/hiz.glsl"
#include "crossray/project/linear.glsl"
#include "crossray/project/patch_tracer.glsl"
#include "crossray/project/proxy.glsl"
#include "crossray/project/screen_ray.glsl"
#include "pass/record_layout.glsl"

// One iteration of a march, whichever it is.
struct RecordedStep {
    int iteration; // from 0; beyond the record's capacity (params.record.z) a step is counted by the iterations alone
    int level;
    ivec2 cell;
    ivec2 cellSizeSS;
    vec2 positionSS;
    float rayLinearDepth;
    float nearestLinearDepth;
    float farthestLinearDepth;
    float thickLinearDepth;
    int intersectionKind;
};

void recordStep(RecordedStep step)
{
    if (kRecordPixel != 1 || step.iteration < 0 || step.iteration >= params.record.z) return;
    int first = kRecordHeaderSize + step.iteration * kRecordStepSize;
    storeRecordValue(first + kRecordStepPlace, vec4(step.positionSS, step.rayLinearDepth, float(step.level)));
    storeRecordValue(first + kRecordStepDepth, vec4(step.nearestLinearDepth, step.farthestLinearDepth,
                                                    step.thickLinearDepth, float(step.intersectionKind)));
    storeRecordValue(first + kRecordStepCell, vec4(vec2(step.cell), vec2(step.cellSizeSS)));
}

// The library's hooks.
void recordHizStep(HizStep step)
{
    recordStep(RecordedStep(step.iteration, step.level, step.cell, step.cellSizeSS, step.positionSS,
                            step.rayLinearDepth, step.nearestLinearDepth, step.farthestLinearDepth,
                            step.thickLinearDepth, step.intersectionKind));
}

void recordLinearStep(LinearStep step)
{
    recordStep(RecordedStep(step.iteration, 0, ivec2(floor(step.positionSS)), ivec2(1, 1), step.positionSS,
                            step.rayLinearDepth, step.surfaceLinearDepth, step.surfaceLinearDepth,
                            step.surfaceLinearDepth + params.linearTracing.y, step.intersectionKind));
}

// A plane is not thick: where the ray is behind its nearest bound it is behind it.
void recordPatchStep(PatchStep step)
{
    recordStep(RecordedStep(step.iteration, step.level, step.cell, step.rect.end - step.rect.begin, step.positionSS,
                            step.rayLinearDepth, step.nearLinearDepth, step.farLinearDepth, step.nearLinearDepth,
                            step.intersectionKind));
}

void recordProxyHit(ProxyHit hit)
{
    if (kRecordPixel == 1) storeRecordValue(kRecordProxy, vec4(hit.distance, hit.hit ? 1.0 : 0.0, 0.0, 0.0));
}

// The ray as it set out.
void recordRay(View view, vec3 originWS, vec3 dirWS, float pathLength)
{
    if (kRecordPixel != 1) return;
    ScreenPosition start = projectWSToSS(view, originWS);
    ScreenRay ray = makeScreenRay(view, originWS, dirWS);
    float way = length(ray.deltaSS);
    bool runs = ray.status == kHitReasonNone && way > 1e-12;
    float share = runs ? 1.0 / way : 0.0;
    storeRecordValue(kRecordStart, vec4(start.positionSS, start.linearDepth, pathLength));
    storeRecordValue(kRecordDirSS, vec4(ray.deltaSS * share, ray.deltaAffineDepth * share, runs ? way : 0.0));
    storeRecordValue(kRecordOriginWS, vec4(originWS, 0.0));
    storeRecordValue(kRecordDirWS, vec4(dirWS, 0.0));
    bool isLinear = kProjectionModel == kTracingModelLinear;
    storeRecordValue(kRecordLimits, isLinear ? vec4(0.0, 0.0, float(params.linearLimits.y), params.linearTracing.y)
                                             : vec4(float(params.hizLimits.x), float(params.hizLimits.y),
                                                    float(params.hizLimits.z), params.tracing.x));
}

#endif
