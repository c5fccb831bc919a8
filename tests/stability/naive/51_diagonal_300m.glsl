// Replaces: crossray/probe/urp.glsl computeUrpSize
// Fails: in half precision every diagonal beyond 255.9 m is infinite, so that the larger of two counts as much as the smaller.
float computeUrpSize(UrpProbe probe, int profile)
{
    vec3 side = probe.boxMaxWS - probe.boxMinWS;
    return min(unpackHalf2x16(packHalf2x16(vec2(dot(side, side), 0.0))).x, kUrpUnlimitedSize);
}
