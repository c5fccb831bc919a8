// Replaces: crossray/probe/urp.glsl computeUrpSize
// Fails: by its diagonal a long box of little volume is larger than the cubes, and is left out.
float computeUrpSize(UrpProbe probe, int profile)
{
    vec3 side = probe.boxMaxWS - probe.boxMinWS;
    return dot(side, side);
}
