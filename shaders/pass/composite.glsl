// What a refracting surface lets through of the colour behind it: (1 - F) times the transmittance of the way inside. A mirror's
// share is 1. Hooks: the block params.
#ifndef PASS_COMPOSITE_GLSL
#define PASS_COMPOSITE_GLSL

#include "crossray/refract/absorption.glsl"
#include "crossray/refract/fresnel.glsl"
#include "pass/pixel_ray.glsl"
#include "pass/pixel_surface.glsl"
#include "pass/projection.glsl"

struct PixelShare {
    vec3 transmittance; // of the way inside, [0,1]; 0 where no ray is
    vec3 composite;     // factor on the colour, [0,1]
};

PixelShare noPixelShare() { return PixelShare(vec3(0.0, 0.0, 0.0), vec3(0.0, 0.0, 0.0)); }

PixelShare computePixelShare(PixelSurface surface, PixelAnswer answer)
{
    vec3 all = vec3(1.0, 1.0, 1.0);
    if (kEffect != kEffectRefraction) return PixelShare(all, all);
    vec3 transmittance = computeTransmittance(params.absorption.xyz, params.absorption.w, answer.pathLength);
    float cosine = dot(safeNormalize(surface.normalWS, vec3(0.0)), surface.viewDirWS);
    float reflected = computeFresnel(kFresnel, cosine, params.material.x);
    return PixelShare(transmittance, transmittance * (1.0 - reflected));
}

#endif
