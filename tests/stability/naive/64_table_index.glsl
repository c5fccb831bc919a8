// Replaces: crossray/probe/roughness.glsl computeBuiltInMip
// On: osmesa
// Fails: beyond a roughness of 1 the index is past the table's end.
float computeBuiltInMip(float perceptualRoughness)
{
    const float levels[7] = float[7](0.0, 1.5833333, 2.9333334, 4.05, 4.9333334, 5.5833335, 6.0);
    return levels[int(perceptualRoughness * 6.0)];
}
