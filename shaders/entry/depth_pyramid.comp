#version 450
// One level of the depth pyramid, a cell an invocation.
#include "bindings/depth_pyramid.glsl"
#include "pass/depth_pyramid.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

void main()
{
    buildPyramidCell(ivec2(gl_GlobalInvocationID.xy));
}
