// A world-space ray as a straight way over the screen.
// Hooks: none. Source: McGuire and Mara 2014, "Efficient GPU Screen-Space Ray Tracing" (1/z is linear over the screen).
//
// Affine depth: 1/linearDepth in perspective, -linearDepth in orthographic views. Over the screen it is an affine
// function on any plane and on any ray, and of two depths the nearer one's is larger in both kinds of view. A point of
// the ray is startSS + s*deltaSS with affine depth start + s*delta, s in [0,1].
#ifndef CROSSRAY_PROJECT_SCREEN_RAY_GLSL
#define CROSSRAY_PROJECT_SCREEN_RAY_GLSL

#include "crossray/core/math.glsl"
#include "crossray/core/view.glsl"
#include "crossray/shared/outputs.glsl"

struct ScreenRay {
    vec2 startSS; // pixels
    vec2 deltaSS; // pixels to the end of the ray, which may lie off screen
    float startAffineDepth;
    float deltaAffineDepth;
    int endReason; // what the end of the ray is: kHitReasonNearPlane or kHitReasonSky
    int status;    // kHitReasonNone, or why there is nothing to march; all else is then 0
};

float affineDepthFromLinear(View view, float linearDepth)
{
    return view.orthographic ? -linearDepth : 1.0 / max(linearDepth, 1e-30);
}

// Perspective: affine depths of 0 and less lie at infinity or beyond, and give 1e30 m.
float linearDepthFromAffine(View view, float affineDepth)
{
    float fromPerspective = affineDepth > 1e-30 ? 1.0 / affineDepth : 1e30;
    return view.orthographic ? -affineDepth : fromPerspective;
}

ScreenRay makeEmptyScreenRay(int status)
{
    return ScreenRay(vec2(0.0), vec2(0.0), 0.0, 0.0, kHitReasonNone, status);
}

// The ray from its origin to the near plane, the far plane, or 65504 m, whichever comes first. Status:
// kHitReasonDegenerateRay for input that is not finite or has no direction; kHitReasonNearPlane when it starts at or
// before the near plane and does not run away from the eye, or starts behind the eye; kHitReasonSky when it starts
// beyond the far plane, not coming back.
ScreenRay makeScreenRay(View view, vec3 originWS, vec3 dirWS)
{
    vec3 dir = safeNormalize(directionVSFromWS(view, dirWS), vec3(0.0));
    vec3 origin = positionVSFromWS(view, originWS);
    if (!hasDirection(dir) || !isFinite(origin)) return makeEmptyScreenRay(kHitReasonDegenerateRay);

    float startDepth = -origin.z;
    float depthRate = -dir.z; // metres of depth a metre of ray
    bool isAhead = startDepth > 0.0;
    if (!isAhead) return makeEmptyScreenRay(kHitReasonNearPlane);
    float toNear = depthRate < 0.0 ? safeDivide(view.nearDistance - startDepth, depthRate, kFarAway) : kFarAway;
    float toFar = depthRate > 0.0 ? safeDivide(view.farDistance - startDepth, depthRate, kFarAway) : kFarAway;
    if (toNear <= 0.0) return makeEmptyScreenRay(kHitReasonNearPlane);
    if (toFar <= 0.0) return makeEmptyScreenRay(kHitReasonSky);
    float range = min(kFarAway, min(toNear, toFar));
    bool meetsNear = toNear < toFar && toNear < kFarAway;
    float endDepth = meetsNear ? view.nearDistance : startDepth + range * depthRate;

    // The difference of the two projections, in the form that does not cancel: the lateral part that perspective
    // leaves.
    vec2 scale = screenScale(view);
    vec2 lateral = dir.xy * startDepth - origin.xy * depthRate;
    vec2 deltaPerspective = scale * lateral * (range / (startDepth * endDepth));
    vec2 deltaSS = view.orthographic ? scale * dir.xy * range : deltaPerspective;
    vec2 startSS = 0.5 * view.imageSize + scale * origin.xy / (view.orthographic ? 1.0 : startDepth);
    float startAffine = affineDepthFromLinear(view, startDepth);
    float deltaAffine = view.orthographic ? startDepth - endDepth : (startDepth - endDepth) / (startDepth * endDepth);
    if (!isFinite(startSS) || !isFinite(deltaSS) || !isFinite(vec2(startAffine, deltaAffine))) {
        return makeEmptyScreenRay(kHitReasonDegenerateRay);
    }
    int endReason = meetsNear ? kHitReasonNearPlane : kHitReasonSky;
    return ScreenRay(startSS, deltaSS, startAffine, deltaAffine, endReason, kHitReasonNone);
}

vec2 screenRayPositionSS(ScreenRay ray, float s)
{
    return ray.startSS + ray.deltaSS * s;
}

float screenRayAffineDepth(ScreenRay ray, float s)
{
    return ray.startAffineDepth + ray.deltaAffineDepth * s;
}

#endif
