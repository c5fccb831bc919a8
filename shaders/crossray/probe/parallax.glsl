// The direction in which a probe's cubemap is read for a reflection that starts away from the capture position.
// Hooks: none. Source: Unity HDRP reflection probe documentation (2018), proxy volume and capture position; box and
// sphere parallax correction: Lagarde and Zanuttini 2012.
//
// Answers to the borders:
// - a ray that does not meet the proxy (it starts outside), or a proxy without size: read as if there were none, 65504
// m
//   away, with the reason; the same holds for a shape that is no proxy's: kHitReasonDegenerateInput;
// - a ray that is answered at the capture position itself: the reflection direction unchanged;
// - a minimum distance below 0 or NaN counts as 0, one above 65504 as 65504;
// - a direction without direction, or a position that is not finite: kHitReasonDegenerateRay; the direction is the
//   normalised input, or the zero vector;
// - a capture position that is not finite: kHitReasonDegenerateInput, the reflection direction unchanged.
#ifndef CROSSRAY_PROBE_PARALLAX_GLSL
#define CROSSRAY_PROBE_PARALLAX_GLSL

#include "crossray/core/math.glsl"
#include "crossray/probe/shapes.glsl"
#include "crossray/project/proxy.glsl"

struct ProbeProxy {
    int shape;                   // kProbeShapeInfinite, kProbeShapeBox or kProbeShapeSphere
    vec3 centerWS;               // metres
    mat3 worldFromProxy;         // a rotation
    vec3 halfExtents;            // metres; a sphere's radius is x
    float minProjectionDistance; // metres; nearer hits are taken as being that far
};

struct ParallaxRay {
    vec3 dirWS;                // unit: from the capture position to what the reflection sees
    float distance;            // metres along the reflection, as used
    float distanceFromCapture; // metres from the capture position to the same point
    bool hit;                  // the proxy was met; always so for the infinite one
    int reason;                // kHitReasonNone with a hit
};

ProxyHit projectProbeProxy(vec3 positionWS, vec3 dirWS, ProbeProxy proxy)
{
    if (proxy.shape == kProbeShapeBox) {
        return projectProxyBox(positionWS, dirWS, proxy.centerWS, proxy.worldFromProxy, proxy.halfExtents);
    }
    if (proxy.shape == kProbeShapeSphere) {
        return projectProxySphere(positionWS, dirWS, proxy.centerWS, proxy.halfExtents.x);
    }
    if (proxy.shape == kProbeShapeInfinite) return projectProxyInfinite(positionWS, dirWS);
    return makeProxyMiss(positionWS, kHitReasonDegenerateInput);
}

// The reflection from positionWS in the direction dirWS (any length), as seen from the capture position.
ParallaxRay computeParallax(vec3 positionWS, vec3 dirWS, ProbeProxy proxy, vec3 capturePositionWS)
{
    vec3 dir = safeNormalize(dirWS, vec3(0.0));
    ProxyHit hit = projectProbeProxy(positionWS, dirWS, proxy);
    bool isRay = hasDirection(dirWS) && isFinite(positionWS) && hit.reason != kHitReasonDegenerateRay;
    if (!isRay) return ParallaxRay(dir, 0.0, 0.0, false, kHitReasonDegenerateRay);
    float nearest = proxy.minProjectionDistance > 0.0 ? min(proxy.minProjectionDistance, kFarAway) : 0.0;
    float distance = hit.hit ? max(hit.distance, nearest) : kFarAway;
    vec3 seenWS = positionWS + dir * distance - capturePositionWS;
    if (!isFinite(seenWS)) return ParallaxRay(dir, distance, kFarAway, false, kHitReasonDegenerateInput);
    // Scaled first: the square of a length of 1e20 m is no float.
    float size = max(maxComponent(abs(seenWS)), kShortestVector);
    float distanceFromCapture = size * length(seenWS / size);
    return ParallaxRay(safeNormalize(seenWS, dir), distance, distanceFromCapture, hit.hit, hit.reason);
}

#endif
