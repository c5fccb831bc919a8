// The ray that a pixel sends out: reflected, or refracted by one of the models. Hooks: fetchThickness, and the block
// params.
#ifndef PASS_PIXEL_RAY_GLSL
#define PASS_PIXEL_RAY_GLSL

#include "crossray/core/reflection.glsl"
#include "crossray/refract/refraction.glsl"
#include "crossray/shared/outputs.glsl"

// A value of kEffect; kRefractionModel has those of crossray/refract/refraction.glsl.
const int kEffectRefraction = 1;

// Metres: value times multiplier, or the map's value times it.
float computePixelThickness(ivec2 pixel)
{
    if (kThicknessMap == 1) return fetchThickness(pixel) * params.material.w;
    return params.material.y;
}

// The ray that the pixel sends out. Reflection about the shading normal; refraction by the model.
RefractionExit computePixelRay(vec3 positionWS, vec3 normalWS, vec3 viewDirWS, float thickness)
{
    float ior = params.material.x;
    if (kEffect == kEffectRefraction) {
        return computeRefraction(kRefractionModel, positionWS, normalWS, viewDirWS, ior, thickness);
    }
    vec3 dirWS = computeReflectionDirection(normalWS, viewDirWS);
    return RefractionExit(positionWS, dirWS, 0.0, dot(dirWS, dirWS) > 0.0 ? kHitReasonNone : kHitReasonDegenerateRay);
}

#endif
