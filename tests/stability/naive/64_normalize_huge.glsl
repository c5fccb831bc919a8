// Replaces: crossray/core/reflection.glsl computeReflectionDirection
// Fails: the square of 1e20 is no float, that of 1e-25 is 0, and normalize divides by its root.
vec3 computeReflectionDirection(vec3 normalWS, vec3 viewDirWS)
{
    return reflect(-normalize(viewDirWS), normalize(normalWS));
}
