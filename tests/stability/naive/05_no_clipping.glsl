// Replaces: crossray/project/screen_ray.glsl makeScreenRay
// Fails: the ray's end is a point 100 m on, also where that is behind the eye: divided by a depth below 0 it lies on the
// other side of the screen.
ScreenRay makeScreenRay(View view, vec3 originWS, vec3 dirWS)
{
    vec3 dir = normalize(directionVSFromWS(view, dirWS));
    vec3 origin = positionVSFromWS(view, originWS);
    vec3 end = origin + dir * 100.0;
    float startW = view.orthographic ? 1.0 : -origin.z;
    float endW = view.orthographic ? 1.0 : -end.z;
    vec2 startSS = 0.5 * view.imageSize + screenScale(view) * origin.xy / startW;
    vec2 deltaSS = 0.5 * view.imageSize + screenScale(view) * end.xy / endW - startSS;
    deltaSS = vec2(awayFromZero(deltaSS.x, 1e-20), awayFromZero(deltaSS.y, 1e-20));
    float startAffine = view.orthographic ? origin.z : 1.0 / startW;
    float endAffine = view.orthographic ? end.z : 1.0 / endW;
    return ScreenRay(startSS, deltaSS, 1.0 / max(abs(deltaSS.x), abs(deltaSS.y)), startAffine, endAffine - startAffine,
                     kHitReasonSky, kHitReasonNone);
}
