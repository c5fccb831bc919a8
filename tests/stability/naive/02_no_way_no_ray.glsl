// Replaces: crossray/project/screen_ray.glsl makeScreenRay
// Fails: what has no pixel to step over is taken for no ray, and never looks at the pixel it is in.
ScreenRay makeScreenRay(View view, vec3 originWS, vec3 dirWS)
{
    vec3 dir = normalize(directionVSFromWS(view, dirWS));
    vec3 origin = positionVSFromWS(view, originWS);
    float range = dir.z > 0.0 ? min(kFarAway, (-view.nearDistance - origin.z) / dir.z) : kFarAway;
    vec3 endVS = origin + dir * range;
    ScreenPosition start = projectVSToSS(view, origin);
    ScreenPosition end = projectVSToSS(view, endVS);
    vec2 deltaSS = end.positionSS - start.positionSS;
    float pixels = max(abs(deltaSS.x), abs(deltaSS.y));
    int status = pixels < 1.0 ? kHitReasonDegenerateRay : kHitReasonNone;
    deltaSS = vec2(awayFromZero(deltaSS.x, 1e-20), awayFromZero(deltaSS.y, 1e-20));
    float startAffine = affineDepthFromLinear(view.orthographic, -origin.z);
    return ScreenRay(start.positionSS, deltaSS, 1.0 / pixels, startAffine,
                     affineDepthFromLinear(view.orthographic, -endVS.z) - startAffine,
                     dir.z > 0.0 ? kHitReasonNearPlane : kHitReasonSky, status);
}
