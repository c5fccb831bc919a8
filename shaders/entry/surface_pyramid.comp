#version 450
// Some levels of the pyramid of planes, a cell of the coarsest an invocation.
#include "bindings/surface_pyramid.glsl"
#include "pass/surface_pyramid.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

void main()
{
    buildSurfaceCells(ivec2(gl_GlobalInvocationID.xy));
}
