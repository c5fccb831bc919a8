#version 450
// One level of the pyramid of planes, a cell an invocation.
#include "bindings/surface_pyramid.glsl"
#include "pass/surface_pyramid.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

void main()
{
    buildSurfaceCell(ivec2(gl_GlobalInvocationID.xy));
}
