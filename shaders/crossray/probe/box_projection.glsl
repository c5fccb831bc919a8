// The direction in which a Built-in or URP probe with box projection is read.
// Hooks: none. Source: Unity manual and shader listing, box projection; two ways to the same point, of which the first
// divides by both faces of an axis and the second chooses the face first and divides once.
//
// A second form that circulates chooses the face behind the ray instead; it is not here. Answers to the borders, of
// both:
// - a probe that does not enable it (w not above 0, NaN): the direction unchanged, not applied;
// - a component of +0, -0 or below kParallelDirection: its two faces are never met;
// - a position on a face with the ray pointing out: the position itself (to kProxyTolerance of the size);
// - a position outside: the far face where the ray meets the box, else unchanged and not applied;
// - a box without size in a direction is a plane; one whose ends are swapped or not finite: not applied;
// - a point that is the capture position: the direction unchanged; no direction: the zero vector, not applied.
#ifndef CROSSRAY_PROBE_BOX_PROJECTION_GLSL
#define CROSSRAY_PROBE_BOX_PROJECTION_GLSL

#include "crossray/core/math.glsl"
#include "crossray/project/proxy.glsl"

struct ProbeBox {
    vec3 minWS; // metres
    vec3 maxWS;
    vec4 capturePositionWS; // w > 0 enables box projection
};

struct BoxProjection {
    vec3 dirWS;     // unit
    float distance; // metres to the box along the ray; 0 where not applied
    bool applied;
};

// An axis that the ray does not move along never meets its faces.
float distanceToFace(float toFace, float dir)
{
    bool isParallel = abs(dir) < kParallelDirection;
    return choose(isParallel, 1e30, toFace / choose(isParallel, 1.0, dir));
}

// Takes the distance if the point there lies on the box, ahead.
BoxProjection finishBoxProjection(vec3 dir, vec3 positionWS, ProbeBox box, float distance)
{
    vec3 extent = box.maxWS - box.minWS;
    bool hasMin = isFinite(box.minWS);
    bool hasMax = isFinite(box.maxWS);
    bool hasSize = minComponent(extent) >= 0.0;
    bool isAsked = box.capturePositionWS.w > 0.0;
    bool hasCapture = isFinite(box.capturePositionWS.xyz);
    bool hasRay = hasDirection(dir);
    float margin = kProxyTolerance * maxComponent(extent);
    bool isForward = distance >= -margin;
    bool isMet = distance < 1e29;
    bool isAhead = isForward && isMet;
    float used = choose(isAhead, max(distance, 0.0), 0.0);
    vec3 hitWS = positionWS + dir * used;
    bool isAboveMin = minComponent(hitWS - box.minWS) >= -margin;
    bool isBelowMax = minComponent(box.maxWS - hitWS) >= -margin;
    bool isPoint = isFinite(hitWS);
    bool isBox = hasMin && hasMax && hasSize;
    bool applied = isBox && isAsked && hasCapture && hasRay && isAhead && isAboveMin && isBelowMax && isPoint;
    vec3 seenDir = safeNormalize(hitWS - box.capturePositionWS.xyz, dir);
    return BoxProjection(choose(applied, seenDir, dir), choose(applied, used, 0.0), applied);
}

// Both faces of each axis by division, the one ahead chosen by the direction's sign.
BoxProjection computeBoxProjectionDivision(vec3 positionWS, vec3 dirWS, ProbeBox box)
{
    vec3 dir = safeNormalize(dirWS, vec3(0.0));
    vec3 toMax = box.maxWS - positionWS;
    vec3 toMin = box.minWS - positionWS;
    vec3 byMax = vec3(distanceToFace(toMax.x, dir.x), distanceToFace(toMax.y, dir.y), distanceToFace(toMax.z, dir.z));
    vec3 byMin = vec3(distanceToFace(toMin.x, dir.x), distanceToFace(toMin.y, dir.y), distanceToFace(toMin.z, dir.z));
    vec3 ahead =
        vec3(dir.x > 0.0 ? byMax.x : byMin.x, dir.y > 0.0 ? byMax.y : byMin.y, dir.z > 0.0 ? byMax.z : byMin.z);
    return finishBoxProjection(dir, positionWS, box, minComponent(ahead));
}

// The face ahead chosen by step and mix, then one division an axis.
BoxProjection computeBoxProjectionSelect(vec3 positionWS, vec3 dirWS, ProbeBox box)
{
    vec3 dir = safeNormalize(dirWS, vec3(0.0));
    vec3 faceWS = mix(box.minWS, box.maxWS, step(vec3(0.0), dir));
    vec3 toFace = faceWS - positionWS;
    vec3 ahead =
        vec3(distanceToFace(toFace.x, dir.x), distanceToFace(toFace.y, dir.y), distanceToFace(toFace.z, dir.z));
    return finishBoxProjection(dir, positionWS, box, minComponent(ahead));
}

#endif
