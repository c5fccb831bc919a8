// Replaces: crossray/refract/absorption.glsl computeTransmittance
// Fails: at thickness 0 and distance 0 the power is 0/0, and a colour above 1 makes thick glass shine.
vec3 computeTransmittance(vec3 transmittanceColor, float absorptionDistance, float pathLength)
{
    return pow(transmittanceColor, vec3(pathLength / absorptionDistance));
}
