// Replaces: crossray/probe/influence.glsl computeBlendNormalFade
// Fails: at the capture position the way to the surface is 0 or rounding, and its direction NaN or noise.
float computeBlendNormalFade(vec3 normalWS, vec3 fromCaptureWS)
{
    return clamp(1.5 - 2.5 * dot(normalWS, normalize(fromCaptureWS)), 0.0, 1.0);
}
