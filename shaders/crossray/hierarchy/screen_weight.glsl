// How much an answer from the screen counts near the screen's border.
// Hooks: none. Source: Unity HDRP reflection documentation (2018) for the linear ramp; the smoothed forms after what
// Unity shipped in 2018 and ships today.
#ifndef CROSSRAY_HIERARCHY_SCREEN_WEIGHT_GLSL
#define CROSSRAY_HIERARCHY_SCREEN_WEIGHT_GLSL

#include "crossray/core/math.glsl"
#include "crossray/shared/outputs.glsl"

// One axis: coordinate in [0,1], distance in the same unit. Outside [0,1], and for NaN, 0. A distance that is not above
// 0 means no fade: 1 on [0,1], borders included.
float computeScreenRamp(float coordinate, float distance, int form)
{
    float inside = min(coordinate, 1.0 - coordinate); // to the nearer border
    bool isInside = coordinate >= 0.0 && coordinate <= 1.0;
    float width = form == kScreenWeightSmoothToday ? 0.5 * distance : distance;
    float ramp = distance > 0.0 ? saturate(inside / max(width, 1e-30)) : 1.0;
    float shaped = form == kScreenWeightLinear ? ramp : smoothRamp(ramp);
    return isInside ? shaped : 0.0;
}

// Weight in [0,1] of a position in UV: the product of both axes. `form` is kScreenWeightLinear (the document: 0 at the
// border, 1 from `distance` on), kScreenWeightSmooth2018 (the same, smoothed) or kScreenWeightSmoothToday (smoothed,
// half as wide).
float computeScreenWeight(vec2 positionUV, float distance, int form)
{
    return computeScreenRamp(positionUV.x, distance, form) * computeScreenRamp(positionUV.y, distance, form);
}

#endif
