// Replaces: crossray/core/view.glsl positionNDCFromSS
// Fails: row 0 is taken for the lowest one: every position lies mirrored in height.
vec2 positionNDCFromSS(View view, vec2 positionSS)
{
    return positionSS / view.imageSize * 2.0 - 1.0;
}
