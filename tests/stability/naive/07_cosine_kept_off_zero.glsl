// Replaces: crossray/core/reflection.glsl computeReflectionDirection
// Fails: a cosine that is kept above a hundredth, as lighting does to divide by it, lifts every grazing ray off its mirror.
vec3 computeReflectionDirection(vec3 normalWS, vec3 viewDirWS)
{
    vec3 n = safeNormalize(normalWS, vec3(0.0));
    vec3 v = safeNormalize(viewDirWS, vec3(0.0));
    if (dot(n, n) < 0.5 || dot(v, v) < 0.5) return vec3(0.0);
    return safeNormalize(n * (2.0 * max(dot(n, v), 0.01)) - v, -v);
}
