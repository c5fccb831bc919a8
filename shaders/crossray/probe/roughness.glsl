// What roughness does to the look-up in a prefiltered environment: mip level, direction, and the probe's distance.
// Hooks: none. Source: Unity HDRP reflection documentation (2018) for the exponents; distance-based roughness and the
// dominant direction: Lagarde and de Rousiers 2014; the Built-in approximation: Unity manual and shader listing.
//
// Roughness is perceptual, clamped to [0,1]; NaN counts as 0. Nothing here is NaN or infinite for any input.
#ifndef CROSSRAY_PROBE_ROUGHNESS_GLSL
#define CROSSRAY_PROBE_ROUGHNESS_GLSL

#include "crossray/core/math.glsl"

const float kReflectionMipExponent = 0.8;
const float kRefractionMipExponent = 1.3;
const float kBuiltInMipSteps = 6.0;                  // the Built-in pipeline's levels above the first
const float kBuiltInSmallestSquare = 1.192092896e-7; // of roughness^4, in the exact form

// Mip level in [0, lods - 1] of a chain of `lods` levels; 0 where there is one level or none.
float computeRoughnessMip(float perceptualRoughness, int lods, float exponent)
{
    float r = saturate(perceptualRoughness);
    float level = r > 0.0 ? pow(r, exponent) : 0.0;
    return level * float(max(lods - 1, 0));
}

float computeReflectionMip(float perceptualRoughness, int lods)
{
    return computeRoughnessMip(perceptualRoughness, lods, kReflectionMipExponent);
}

float computeRefractionMip(float perceptualRoughness, int lods)
{
    return computeRoughnessMip(perceptualRoughness, lods, kRefractionMipExponent);
}

// Mip level in [0, lods - 1] of a prefiltered probe of `lods` levels; 0 where there is one level or none.
float computeProbeMip(float perceptualRoughness, int lods)
{
    float r = saturate(perceptualRoughness);
    return r * (1.7 - 0.7 * r) * float(max(lods - 1, 0));
}

// Mip level in [0, 6] as the Built-in pipeline has it: a parabola through the exact form's ends.
float computeBuiltInMip(float perceptualRoughness)
{
    float r = saturate(perceptualRoughness);
    return r * (1.7 - 0.7 * r) * kBuiltInMipSteps;
}

// What the parabola stands for: the specular power of that roughness, a quarter of it (reflection against half vector),
// and back to a roughness. Roughness 0 gives level 0.158, not 0: the power is kept finite.
float computeBuiltInMipExact(float perceptualRoughness)
{
    float m = saturate(perceptualRoughness) * saturate(perceptualRoughness);
    float power = (2.0 / max(kBuiltInSmallestSquare, m * m) - 2.0) / 4.0;
    return sqrt(sqrt(2.0 / (power + 2.0))) * kBuiltInMipSteps;
}

// Roughness of a look-up whose hit is `hitDistance` metres from the surface and `captureDistance` metres from the
// capture position: sharper where the surface is nearer to the hit than the capture was, never rougher, and unchanged
// at roughness
// 1. Distances below 0 count as 0; both 0, NaN or infinite: unchanged.
float computeDistanceBasedRoughness(float perceptualRoughness, float hitDistance, float captureDistance)
{
    float r = saturate(perceptualRoughness);
    bool known = isFinite(hitDistance) && isFinite(captureDistance);
    float ratio = known ? safeDivide(max(hitDistance, 0.0), max(captureDistance, 0.0), 1.0) : 1.0;
    return mix(clamp(ratio * r, 0.0, r), r, r);
}

// How the dominant direction takes the angle of view: not at all (the mirror direction stays), by the cosine N.V, or by
// its square, as HDRP's code has it.
const int kDominantOff = 0;
const int kDominantPlain = 1;
const int kDominantSquared = 2;

// Unit direction of the middle of a rough reflection's lobe: between the normal and the mirror direction (at a middling
// roughness a little beyond the latter, as the fit has it). Inputs are normalised; without a normal or a view direction
// the mirror direction, without that the normal, without both the zero vector.
vec3 computeDominantDirection(vec3 normalWS, vec3 reflectionDirWS, vec3 viewDirWS, float perceptualRoughness, int form)
{
    vec3 n = safeNormalize(normalWS, vec3(0.0));
    vec3 reflected = safeNormalize(reflectionDirWS, n);
    if (form == kDominantOff || !hasDirection(normalWS) || !hasDirection(viewDirWS)) return reflected;
    float cosine = saturate(dot(n, safeNormalize(viewDirWS, n)));
    float angle = form == kDominantPlain ? cosine : cosine * cosine;
    float squared = saturate(perceptualRoughness) * saturate(perceptualRoughness);
    float smoothness = 1.0 - squared;
    float factor = (sqrt(smoothness) + squared) * saturate(smoothness * smoothness + smoothness * angle);
    return safeNormalize(mix(n, reflected, factor), reflected);
}

#endif
