// Replaces: crossray/core/ray_ndc.glsl computeRayDirNDC
// Fails: the ray straight at the eye has a way of 0 on screen, and 0/0 is no number.
vec3 computeRayDirNDC(View view, vec3 originWS, vec3 dirWS)
{
    vec3 originVS = positionVSFromWS(view, originWS);
    vec3 dirVS = directionVSFromWS(view, dirWS);
    ScreenPosition begin = projectVSToSS(view, originVS);
    float depth = -originVS.z;
    vec2 change = (dirVS.xy + originVS.xy * (dirVS.z / depth)) / (view.slope * depth);
    return vec3(change / length(change), dirVS.z / (depth * depth * length(change)));
}
