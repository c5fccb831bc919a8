// Replaces: crossray/probe/roughness.glsl computeProbeMip
// Replaces: pass/probe_tier.glsl readProbe
// Fails: above a roughness of 1.2 the parabola falls again, and the roughest surfaces are sharp.
float computeProbeMip(float perceptualRoughness, int lods)
{
    return perceptualRoughness * (1.7 - 0.7 * perceptualRoughness) * float(lods - 1);
}
ProbeView readProbe(int index, vec3 originWS, vec3 dirWS, float roughness)
{
    ParallaxRay seen =
        computeParallax(originWS, dirWS, loadProbeProxy(index), probeParams.items[index].capturePositionWS.xyz);
    float mipLevel = computeProbeMip(roughness, probeCubeLevelCount(index));
    vec3 color = sampleProbeCubemap(index, seen.dirWS, mipLevel);
    return ProbeView(color * probeParams.items[index].influenceExtents.w, seen.dirWS, mipLevel);
}
