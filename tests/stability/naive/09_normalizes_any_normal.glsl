// Replaces: crossray/core/reflection.glsl computeReflectionDirection
// Fails: normalize divides by the length: of a normal of length 0 that is 0/0.
vec3 computeReflectionDirection(vec3 normalWS, vec3 viewDirWS)
{
    return reflect(-viewDirWS, normalize(normalWS));
}
