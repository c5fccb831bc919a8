// How much light a way inside a coloured material leaves.
// Hooks: none. Source: Beer-Lambert law, set by a colour and the distance at which white light has it (Unity HDRP
// refraction documentation, 2018).
#ifndef CROSSRAY_REFRACT_ABSORPTION_GLSL
#define CROSSRAY_REFRACT_ABSORPTION_GLSL

#include "crossray/core/math.glsl"

const float kSmallestTransmittance = 1e-4;      // darker colours count as this, so that the logarithm is finite
const float kSmallestAbsorptionDistance = 1e-5; // metres

// A channel's transmittance as it is used: in [1e-4, 1]; above 1 nothing is amplified, and NaN counts as 1.
float usableTransmittance(float transmittance)
{
    return transmittance < 1.0 ? max(transmittance, kSmallestTransmittance) : 1.0;
}

// Share of light, per channel in [0,1], left after `pathLength` metres; `transmittanceColor` after `absorptionDistance`
// metres (at least 1e-5, NaN counts as that). A path below 0 or NaN counts as 0 and leaves all.
vec3 computeTransmittance(vec3 transmittanceColor, float absorptionDistance, float pathLength)
{
    vec3 color = vec3(usableTransmittance(transmittanceColor.x), usableTransmittance(transmittanceColor.y),
                      usableTransmittance(transmittanceColor.z));
    bool isUsable = absorptionDistance > kSmallestAbsorptionDistance;
    float path = pathLength > 0.0 ? min(pathLength, kFarAway) : 0.0;
    return exp(log(color) * (path / (isUsable ? absorptionDistance : kSmallestAbsorptionDistance)));
}

#endif
