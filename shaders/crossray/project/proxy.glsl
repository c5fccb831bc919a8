// Where a ray meets a proxy: a box or a sphere that stands for the surroundings, or the infinite one.
// Hooks: none. Source: Unity HDRP reflection documentation (2018), proxy volumes; slab test: Kay and Kajiya 1986.
//
// A proxy is seen from inside: the hit is the far face, for rays from outside too (those that meet it). Answers to the
// borders:
// - no meeting: no hit, kHitReasonNoProxyHit, position the origin, distance 0;
// - an origin on a face (to kProxyTolerance of the size): inside; if the ray points outwards the hit is at distance 0;
// - direction components of +0, -0 or below kParallelDirection never meet their two faces; between or on them the other
// axes decide, outside is no hit;
// - a ray that touches a sphere in one point or a box along an edge: a hit there;
// - a zero, NaN or infinite direction, or an origin that is not finite: kHitReasonDegenerateRay;
// - negative, NaN or infinite sizes: kHitReasonDegenerateInput.
#ifndef CROSSRAY_PROJECT_PROXY_GLSL
#define CROSSRAY_PROJECT_PROXY_GLSL

#include "crossray/core/math.glsl"
#include "crossray/core/view.glsl"
#include "crossray/shared/outputs.glsl"

const float kProxyTolerance = 1e-5;
// A unit direction's component that is no more than its rounding: a ray that runs along a face to that, and starts on
// it, would else leave the box there by the sign of the rounding.
const float kParallelDirection = 1e-7;

struct ProxyHit {
    vec3 positionWS;
    float distance; // metres along the ray, >= 0
    bool hit;
    int reason; // kHitReasonNone with a hit
};

ProxyHit makeProxyMiss(vec3 originWS, int reason)
{
    return ProxyHit(isFinite(originWS) ? originWS : vec3(0.0), 0.0, false, reason);
}

// The hit at that distance; a negative distance within the tolerance is 0.
ProxyHit makeProxyHit(vec3 originWS, vec3 dirWS, float distance)
{
    float clamped = max(distance, 0.0);
    vec3 positionWS = originWS + dirWS * clamped;
    if (isFinite(positionWS)) return ProxyHit(positionWS, clamped, true, kHitReasonNone);
    return makeProxyMiss(originWS, kHitReasonDegenerateRay);
}

// Where the ray is between two faces at -extent and +extent of one axis: x from, y to, in metres along the ray.
// Parallel rays are between them always or never (an empty interval).
vec2 intersectSlab(float origin, float dir, float extent)
{
    float margin = kProxyTolerance * extent;
    bool between = abs(origin) <= extent + margin;
    vec2 parallel = between ? vec2(-1e30, 1e30) : vec2(1e30, -1e30);
    bool isParallel = abs(dir) < kParallelDirection;
    float inverse = 1.0 / (isParallel ? 1.0 : dir);
    float a = (-extent - origin) * inverse;
    float b = (extent - origin) * inverse;
    return isParallel ? parallel : vec2(min(a, b), max(a, b));
}

// From where the way along one axis ends to the face that it leaves by; 0 for the axes that the ray does not leave by.
float computeFaceGap(float origin, float dir, float extent, float to, float leave)
{
    float gap = choose(dir < 0.0, -extent, extent) - (origin + dir * leave);
    return choose(to <= leave, gap, 0.0);
}

// A box of half extents (metres) about a centre; worldFromProxy is a rotation. The hit is put on its face: the sum of
// origin and way is as exact as they are long, and a face may be nearer to the eye's plane than that.
ProxyHit projectProxyBox(vec3 originWS, vec3 dirWS, vec3 centerWS, mat3 worldFromProxy, vec3 halfExtents)
{
    vec3 dir = safeNormalize(dirWS, vec3(0.0));
    if (!hasDirection(dir) || !isFinite(originWS)) return makeProxyMiss(originWS, kHitReasonDegenerateRay);
    bool isSized = halfExtents.x >= 0.0 && halfExtents.y >= 0.0 && halfExtents.z >= 0.0 && isFinite(halfExtents);
    if (!isSized) return makeProxyMiss(originWS, kHitReasonDegenerateInput);

    vec3 originPS = (originWS - centerWS) * worldFromProxy; // v * M: by the transpose
    vec3 dirPS = dir * worldFromProxy;
    vec2 x = intersectSlab(originPS.x, dirPS.x, halfExtents.x);
    vec2 y = intersectSlab(originPS.y, dirPS.y, halfExtents.y);
    vec2 z = intersectSlab(originPS.z, dirPS.z, halfExtents.z);
    float enter = max(x.x, max(y.x, z.x));
    float leave = min(x.y, min(y.y, z.y));
    float margin = kProxyTolerance * maxComponent(halfExtents);
    bool meets = leave >= enter - margin && leave >= -margin && leave < 1e29;
    if (!meets) return makeProxyMiss(originWS, kHitReasonNoProxyHit);
    ProxyHit onRay = makeProxyHit(originWS, dir, leave);
    vec3 gapPS = vec3(computeFaceGap(originPS.x, dirPS.x, halfExtents.x, x.y, leave),
                      computeFaceGap(originPS.y, dirPS.y, halfExtents.y, y.y, leave),
                      computeFaceGap(originPS.z, dirPS.z, halfExtents.z, z.y, leave));
    vec3 onFaceWS = onRay.positionWS + worldFromProxy * gapPS;
    bool isOutside = leave <= 0.0; // by the tolerance: the hit is the origin
    bool staysPut = isOutside || !onRay.hit;
    return ProxyHit(choose(staysPut, onRay.positionWS, onFaceWS), onRay.distance, onRay.hit, onRay.reason);
}

// A sphere of `radius` metres about a centre. The distance comes from the product of the roots where their difference
// would cancel, so that origins on the sphere are exact.
ProxyHit projectProxySphere(vec3 originWS, vec3 dirWS, vec3 centerWS, float radius)
{
    vec3 dir = safeNormalize(dirWS, vec3(0.0));
    if (!hasDirection(dir) || !isFinite(originWS)) return makeProxyMiss(originWS, kHitReasonDegenerateRay);
    bool isSized = radius >= 0.0 && isFinite(radius);
    if (!isSized) return makeProxyMiss(originWS, kHitReasonDegenerateInput);

    vec3 originPS = originWS - centerWS;
    float along = dot(originPS, dir);
    vec3 perpendicular = originPS - dir * along;
    float halfChordSquared = radius * radius - dot(perpendicular, perpendicular);
    float margin = kProxyTolerance * radius;
    bool touches = halfChordSquared >= -1e-6 * radius * radius;
    float halfChord = sqrt(max(halfChordSquared, 0.0));
    float range = length(originPS);
    float inside = range <= radius + margin ? max(radius - range, 0.0) : radius - range;
    float product = inside * (radius + range);
    // A product that overflows stays infinite: below 0 the sphere is far behind, above it its end is beyond all numbers.
    float leave = along > 0.0 ? safeDivide(product, along + halfChord, product) : halfChord - along;
    bool meets = touches && leave >= -margin;
    if (meets) return makeProxyHit(originWS, dir, leave);
    return makeProxyMiss(originWS, kHitReasonNoProxyHit);
}

// No proxy at all: 65504 m along the ray.
ProxyHit projectProxyInfinite(vec3 originWS, vec3 dirWS)
{
    vec3 dir = safeNormalize(dirWS, vec3(0.0));
    if (!hasDirection(dir) || !isFinite(originWS)) return makeProxyMiss(originWS, kHitReasonDegenerateRay);
    return makeProxyHit(originWS, dir, kFarAway);
}

#endif
