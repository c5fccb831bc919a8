// Replaces: crossray/project/proxy.glsl projectProxySphere
// Fails: from outside most rays miss, and the root of the negative discriminant is NaN.
ProxyHit projectProxySphere(vec3 originWS, vec3 dirWS, vec3 centerWS, float radius)
{
    vec3 originPS = originWS - centerWS;
    float along = dot(originPS, dirWS);
    float leave = sqrt(along * along - dot(originPS, originPS) + radius * radius) - along;
    return ProxyHit(originWS + dirWS * leave, leave, true, kHitReasonNone);
}
