// Replaces: crossray/refract/refraction.glsl enterRefractor
// Fails: at grazing sight the squared cosine is beyond the digits of 1, and an index of 1 bends light.
RefractionEntry enterRefractor(vec3 normalWS, vec3 viewDirWS, float indexOfRefraction, float thickness)
{
    vec3 n = normalize(normalWS);
    vec3 v = normalize(viewDirWS);
    float eta = 1.0 / indexOfRefraction;
    float cosine = dot(n, v);
    float cosineInside = sqrt(1.0 - eta * eta * (1.0 - cosine * cosine));
    vec3 dirWS = normalize(n * (eta * cosine - cosineInside) - v * eta);
    return RefractionEntry(n, v, dirWS, cosine, cosineInside, indexOfRefraction, thickness, kHitReasonNone);
}
