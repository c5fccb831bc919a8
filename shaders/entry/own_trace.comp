#version 450
// The pass screen_trace with a person's own tracer: own/tracer.glsl is no file of this folder, a person's stands in for
// it.
#define CROSSRAY_OWN_TRACER
#include "bindings/screen_trace.glsl"
#include "pass/screen_trace.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

void main()
{
    traceScreenPixel(ivec2(gl_GlobalInvocationID.xy));
}

// Last, so that a name that is taken is an error of that file, and nothing here can be changed by its macros.
#include "own/tracer.glsl"
