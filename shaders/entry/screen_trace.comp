#version 450
// Reflection or refraction ray of each pixel, projected by one of the models; writes the debug modes as raw planes.
#include "bindings/screen_trace.glsl"
#include "pass/screen_trace.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

void main()
{
    traceScreenPixel(ivec2(gl_GlobalInvocationID.xy));
}
