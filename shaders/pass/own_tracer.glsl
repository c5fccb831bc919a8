// The projection by a person's own tracer, which the entry includes last. Hooks: traceOwn (the person's),
// loadOwnStatus, storeOwnStatus, the invocation's own ints ownEndlessLine, ownRounds and ownCoarsestLevel, and those of
// pass/own_interface.glsl.
#ifndef PASS_OWN_TRACER_GLSL
#define PASS_OWN_TRACER_GLSL

#include "pass/own_interface.glsl"

OwnHit traceOwn(OwnRay ray);

// Once a loop was cut that did not end, every other pixel gives up at once, and the case ends with that loop's line.
PixelAnswer answerByOwn(View view, RefractionExit ray, vec2 positionSS)
{
    ivec2 pixel = ivec2(floor(positionSS));
    OwnHit hit = ownEnd(kHitReasonIterationCap, positionSS);
    if (loadOwnStatus().w < 0.5) {
        hit = traceOwn(
            OwnRay(ray.positionWS, ray.dirWS, pixel, ivec2(view.imageSize), params.tracing.x, params.hizLimits.z));
    }
    if (ownEndlessLine != 0) {
        storeOwnStatus(vec4(float(ownEndlessLine), vec2(pixel), 1.0));
        hit = ownEnd(kHitReasonIterationCap, hit.positionSS);
    }
    bool isHit = hit.hitClass == kHitClassHit;
    return PixelAnswer(hit.hitClass, hit.reason, ray.positionWS, ray.dirWS, ray.pathLength, hit.positionSS,
                       choose(isHit, hit.linearDepth, 0.0), ownRounds, ownCoarsestLevel,
                       choose(isHit, kIntersectionDepth, kIntersectionNone), choose(isHit, hit.confidence, 0.0));
}

#endif
