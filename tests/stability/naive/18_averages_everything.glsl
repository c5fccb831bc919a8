// Replaces: crossray/project/color_pyramid.glsl makeColorPyramidTexel
// Fails: each pixel counts as valid, so that a NaN is in the mean of every cell over it.
vec4 makeColorPyramidTexel(vec3 color)
{
    return vec4(color, 1.0);
}
