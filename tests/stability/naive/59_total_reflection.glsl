// Replaces: crossray/refract/refraction.glsl enterRefractor
// Fails: beyond the critical angle refract() gives the zero vector, and nobody looks.
RefractionEntry enterRefractor(vec3 normalWS, vec3 viewDirWS, float indexOfRefraction, float thickness)
{
    vec3 n = normalize(normalWS);
    vec3 v = normalize(viewDirWS);
    vec3 dirWS = refract(-v, n, 1.0 / indexOfRefraction);
    return RefractionEntry(n, v, dirWS, dot(n, v), -dot(n, dirWS), indexOfRefraction, thickness, kHitReasonNone);
}
