// Replaces: crossray/project/screen_ray.glsl makeScreenRay
// Fails: a start that does not lie strictly between the near and the far plane is taken for cut off by them.
ScreenRay makeScreenRay(View view, vec3 originWS, vec3 dirWS)
{
    vec3 dir = normalize(directionVSFromWS(view, dirWS));
    vec3 origin = positionVSFromWS(view, originWS);
    float startDepth = -origin.z;
    float range = dir.z > 0.0 ? min(kFarAway, (startDepth - view.nearDistance) / dir.z) : kFarAway;
    vec3 endVS = origin + dir * range;
    ScreenPosition start = projectVSToSS(view, origin);
    ScreenPosition end = projectVSToSS(view, endVS);
    vec2 deltaSS = end.positionSS - start.positionSS;
    deltaSS = vec2(awayFromZero(deltaSS.x, 1e-20), awayFromZero(deltaSS.y, 1e-20));
    float startAffine = affineDepthFromLinear(view.orthographic, startDepth);
    int status = startDepth > view.nearDistance ? kHitReasonNone : kHitReasonNearPlane;
    status = startDepth < view.farDistance ? status : kHitReasonSky;
    return ScreenRay(start.positionSS, deltaSS, 1.0 / max(abs(deltaSS.x), abs(deltaSS.y)), startAffine,
                     affineDepthFromLinear(view.orthographic, -endVS.z) - startAffine,
                     dir.z > 0.0 ? kHitReasonNearPlane : kHitReasonSky, status);
}
