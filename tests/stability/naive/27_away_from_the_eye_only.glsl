// Replaces: crossray/project/screen_ray.glsl makeScreenRay
// Fails: the march is written for rays that grow deeper; one that comes nearer is given up at once.
ScreenRay makeScreenRay(View view, vec3 originWS, vec3 dirWS)
{
    vec3 dir = normalize(directionVSFromWS(view, dirWS));
    vec3 origin = positionVSFromWS(view, originWS);
    vec3 endVS = origin + dir * kFarAway;
    ScreenPosition start = projectVSToSS(view, origin);
    ScreenPosition end = projectVSToSS(view, endVS);
    vec2 deltaSS = end.positionSS - start.positionSS;
    deltaSS = vec2(awayFromZero(deltaSS.x, 1e-20), awayFromZero(deltaSS.y, 1e-20));
    float startAffine = affineDepthFromLinear(view.orthographic, -origin.z);
    return ScreenRay(start.positionSS, deltaSS, 1.0 / max(abs(deltaSS.x), abs(deltaSS.y)), startAffine,
                     affineDepthFromLinear(view.orthographic, -endVS.z) - startAffine, kHitReasonSky,
                     dir.z >= 0.0 ? kHitReasonNearPlane : kHitReasonNone);
}
