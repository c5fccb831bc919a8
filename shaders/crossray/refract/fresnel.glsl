// How much light a smooth surface reflects, and with the transmittance the share that a refraction lets through.
// Hooks: none. Source: Fresnel's equations for unpolarised light between two dielectrics; Schlick 1994, "An Inexpensive
// BRDF Model for Physically-based Rendering".
//
// Inputs: the cosine of normal and view direction, and the index of refraction of the inside relative to the outside.
// Cosines below kGrazingCosine (normals that face away, NaN) count as that, above 1 as 1, as the refraction models take
// them. An index that is not above 0, or NaN, reflects all: nothing is refracted there. Otherwise it is taken into
// [0.001, 1000].
#ifndef CROSSRAY_REFRACT_FRESNEL_GLSL
#define CROSSRAY_REFRACT_FRESNEL_GLSL

#include "crossray/core/math.glsl"
#include "crossray/refract/refraction.glsl"
#include "crossray/shared/outputs.glsl"

float usableCosine(float cosine)
{
    return cosine > kGrazingCosine ? min(cosine, 1.0) : kGrazingCosine;
}

// Reflected share in [0,1], exact: the mean of both polarisations; 1 at total reflection.
float computeFresnelExact(float cosine, float indexOfRefraction)
{
    bool hasIndex = indexOfRefraction > 0.0 && indexOfRefraction < 1e30;
    float index = hasIndex ? clamp(indexOfRefraction, 0.001, 1000.0) : 1.0;
    float outside = usableCosine(cosine);
    // index times the inner cosine, squared: grouped so that an index of 1 gives back the cosine.
    float insideSquared = (index - 1.0) * (index + 1.0) + outside * outside;
    bool enters = hasIndex && insideSquared > 0.0;
    float inside = sqrt(max(insideSquared, 0.0));
    float across = (outside - inside) / (outside + inside);
    float steep = index * index * outside;
    float along = (steep - inside) / (steep + inside);
    return enters ? saturate(0.5 * (across * across + along * along)) : 1.0;
}

// Schlick's approximation, by the cosine on the thinner side; 1 at total reflection.
float computeFresnelSchlick(float cosine, float indexOfRefraction)
{
    bool hasIndex = indexOfRefraction > 0.0 && indexOfRefraction < 1e30;
    float index = hasIndex ? clamp(indexOfRefraction, 0.001, 1000.0) : 1.0;
    float outside = usableCosine(cosine);
    float insideSquared = (index - 1.0) * (index + 1.0) + outside * outside;
    bool enters = hasIndex && insideSquared > 0.0;
    float inside = sqrt(max(insideSquared, 0.0)) / index;
    float atNormal = (index - 1.0) / (index + 1.0);
    float base = atNormal * atNormal;
    float rest = saturate(1.0 - (index < 1.0 ? inside : outside));
    float restSquared = rest * rest;
    return enters ? saturate(base + (1.0 - base) * restSquared * restSquared * rest) : 1.0;
}

// By number (kFresnel...); an unknown number and kFresnelNone reflect nothing.
float computeFresnel(int model, float cosine, float indexOfRefraction)
{
    if (model == kFresnelExact) return computeFresnelExact(cosine, indexOfRefraction);
    if (model == kFresnelSchlick) return computeFresnelSchlick(cosine, indexOfRefraction);
    return 0.0;
}

#endif
