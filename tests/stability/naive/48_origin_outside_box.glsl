// Replaces: crossray/project/proxy.glsl projectProxyBox
// Fails: the smallest distance to the faces ahead is no point of the box where the ray starts outside it.
ProxyHit projectProxyBox(vec3 originWS, vec3 dirWS, vec3 centerWS, mat3 worldFromProxy, vec3 halfExtents)
{
    vec3 originPS = (originWS - centerWS) * worldFromProxy;
    vec3 dirPS = normalize(dirWS) * worldFromProxy;
    vec3 toPositive = (halfExtents - originPS) / dirPS;
    vec3 toNegative = (-halfExtents - originPS) / dirPS;
    vec3 ahead = max(toPositive, toNegative);
    return makeProxyHit(originWS, normalize(dirWS), min(ahead.x, min(ahead.y, ahead.z)));
}
