// Replaces: crossray/probe/roughness.glsl computeBuiltInMip
// Fails: above a roughness of 1.2 the parabola falls again, and the roughest surfaces are sharp.
float computeBuiltInMip(float perceptualRoughness)
{
    return perceptualRoughness * (1.7 - 0.7 * perceptualRoughness) * kBuiltInMipSteps;
}
