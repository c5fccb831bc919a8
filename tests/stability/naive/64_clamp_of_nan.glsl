// Replaces: crossray/project/color_pyramid.glsl makeColorPyramidTexel
// Fails: max and min make a NaN 0 or 65504 by their order, and it is counted as a colour.
vec4 makeColorPyramidTexel(vec3 color)
{
    return vec4(max(min(color, vec3(65504.0)), vec3(0.0)), 1.0);
}
