// Direction of a ray on screen, as the debug mode RayDirNDC shows it.
// Hooks: none. Source: the projection's derivative along the ray, at its origin; no second point is projected, so a ray
// that crosses the eye's plane needs no clipping.
#ifndef CROSSRAY_CORE_RAY_NDC_GLSL
#define CROSSRAY_CORE_RAY_NDC_GLSL

#include "crossray/core/view.glsl"

// xy: unit direction in NDC (y up). z: change of 1/linearDepth (1/m) for a unit of way in NDC. A ray without length on
// screen (straight at the eye or away from it), an origin that is not in front of the camera, and what no number
// expresses (an origin within 1e-12 m or so of the eye's plane, a view without a field) give 0.
vec3 computeRayDirNDC(View view, vec3 originWS, vec3 dirWS)
{
    vec3 originVS = positionVSFromWS(view, originWS);
    vec3 dirVS = directionVSFromWS(view, dirWS);
    float linearDepth = -originVS.z;
    if (!(linearDepth > 0.0)) return vec3(0.0, 0.0, 0.0);
    float depthChange = -dirVS.z; // metres of depth a metre of ray
    vec2 change = view.orthographic
                      ? dirVS.xy / view.slope
                      : (dirVS.xy - originVS.xy * (depthChange / linearDepth)) / (view.slope * linearDepth);
    float way = length(change);
    // Shorter than this is rounding: the direction would be noise.
    if (!(way > 1e-6 / linearDepth)) return vec3(0.0, 0.0, 0.0);
    vec3 found = vec3(change / way, -depthChange / (linearDepth * linearDepth * way));
    return choose(isFinite(found), found, vec3(0.0, 0.0, 0.0));
}

#endif
