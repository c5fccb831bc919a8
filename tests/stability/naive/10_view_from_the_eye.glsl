// Replaces: crossray/core/view.glsl viewDirectionWS
// Fails: an orthographic camera looks along parallel lines; its position is no eye.
vec3 viewDirectionWS(View view, vec3 positionWS)
{
    return normalize(view.worldFromView[3].xyz - positionWS);
}
