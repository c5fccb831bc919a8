// Replaces: crossray/project/screen_ray.glsl makeScreenRay
// Fails: a ray that keeps its depth never meets the near or the far plane; the distance there is infinite, and so is its
// end.
ScreenRay makeScreenRay(View view, vec3 originWS, vec3 dirWS)
{
    vec3 dir = normalize(directionVSFromWS(view, dirWS));
    vec3 origin = positionVSFromWS(view, originWS);
    float plane = dir.z > 0.0 ? -view.nearDistance : -view.farDistance;
    vec3 endVS = origin + dir * ((plane - origin.z) / dir.z);
    ScreenPosition start = projectVSToSS(view, origin);
    ScreenPosition end = projectVSToSS(view, endVS);
    vec2 deltaSS = end.positionSS - start.positionSS;
    deltaSS = vec2(awayFromZero(deltaSS.x, 1e-20), awayFromZero(deltaSS.y, 1e-20));
    float startAffine = affineDepthFromLinear(view.orthographic, -origin.z);
    return ScreenRay(start.positionSS, deltaSS, 1.0 / max(abs(deltaSS.x), abs(deltaSS.y)), startAffine,
                     affineDepthFromLinear(view.orthographic, -endVS.z) - startAffine,
                     dir.z > 0.0 ? kHitReasonNearPlane : kHitReasonSky, kHitReasonNone);
}
