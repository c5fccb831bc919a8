// The sky as a gradient over the direction; what every hierarchy ends with, at weight 1 and without parallax.
// Hooks: none. Source: Unity HDRP gradient sky documentation (2018).
#ifndef CROSSRAY_PROBE_SKY_GLSL
#define CROSSRAY_PROBE_SKY_GLSL

#include "crossray/core/math.glsl"

struct GradientSky {
    vec3 zenith; // linear radiance
    vec3 horizon;
    vec3 nadir;
    vec3 upWS;       // any length
    float sharpness; // 1: linear in the elevation's sine; above, the ends are reached sooner; 0 and below: horizon
                     // everywhere
};

// Radiance towards dirWS (any length). Without direction, or without an up: the horizon's.
vec3 evaluateGradientSky(GradientSky sky, vec3 dirWS)
{
    float sine = dot(safeNormalize(dirWS, vec3(0.0)), safeNormalize(sky.upWS, vec3(0.0)));
    float sharpness = sky.sharpness > 0.0 ? min(sky.sharpness, kFarAway) : 0.0;
    float height = clamp(sine * sharpness, -1.0, 1.0);
    return height >= 0.0 ? mix(sky.horizon, sky.zenith, height) : mix(sky.horizon, sky.nadir, -height);
}

#endif
