#version 450
// One level of the colour pyramid, a cell an invocation.
#include "bindings/color_pyramid.glsl"
#include "pass/color_pyramid.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

void main()
{
    buildColorCell(ivec2(gl_GlobalInvocationID.xy));
}
