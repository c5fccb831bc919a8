// Replaces: crossray/probe/influence.glsl computeBlendNormalFade
// Fails: the angle to a way of no length is atan(0, 0), and as 0 it says that the surface faces away.
float computeBlendNormalFade(vec3 normalWS, vec3 fromCaptureWS)
{
    float angle = atan(length(cross(normalWS, fromCaptureWS)), dot(normalWS, fromCaptureWS));
    return clamp(1.5 - 2.5 * cos(angle), 0.0, 1.0);
}
