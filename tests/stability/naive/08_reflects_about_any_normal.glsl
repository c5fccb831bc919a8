// Replaces: crossray/core/reflection.glsl computeReflectionDirection
// Fails: about a normal that faces away from the eye the ray is reflected into the surface.
vec3 computeReflectionDirection(vec3 normalWS, vec3 viewDirWS)
{
    return reflect(-viewDirWS, safeNormalize(normalWS, vec3(0.0, 0.0, 1.0)));
}
