// Replaces: crossray/probe/influence.glsl computeBoxInfluence
// Fails: at a blend distance of 0 all inside is 0/0, and beyond half the extent the inner box is clamped to a point.
float computeBoxInfluence(vec3 positionIS, vec3 halfExtents, vec3 blendPositive, vec3 blendNegative)
{
    vec3 inner = max(halfExtents - blendPositive, vec3(0.0));
    vec3 beyond = max(abs(positionIS) - inner, vec3(0.0));
    return 1.0 - clamp(maxComponent(beyond / blendPositive), 0.0, 1.0);
}
