#version 450
// Rays over one image, by the hierarchical walk or by the walk over every pixel; exact_walk_test.cpp compares the two.
#include "bindings/screen_trace.glsl"
#include "pass/view_of_params.glsl"
#include "pass/projection.glsl"
#include "walks/every_pixel_walk.glsl"

layout(constant_id = 30) const int kWalk = 0;    // 0: by the pyramid's levels; 1: every pixel
layout(binding = 15) uniform sampler2D rayImage; // row 0: origin, max level; row 1: direction, caution or bias

layout(local_size_x = 8, local_size_y = 8) in;

// Two vectors a ray: class, reason, position; depth, confidence, iterations.
void storeTrace(int ray, vec4 first, vec4 second)
{
    storeOutputValue(2 * ray, first);
    storeOutputValue(2 * ray + 1, second);
}

void tracePatchRay(View view, int ray, vec4 origin, vec4 dir)
{
    PatchTracerSettings settings = PatchTracerSettings(int(origin.w), params.hizLimits.z, dir.w, params.patches.y);
    PatchTraceResult result;
    if (kWalk == 0) {
        result = tracePatches(view, origin.xyz, dir.xyz, settings);
    } else {
        result = traceEveryPixel(view, origin.xyz, dir.xyz, settings);
    }
    storeTrace(ray, vec4(float(result.hitClass), float(result.reason), result.positionSS),
               vec4(result.linearDepth, result.confidence, float(result.iterations), 0.0));
}

void traceHizRay(View view, int ray, vec4 origin, vec4 dir)
{
    int minLevel = ray % 4 == 3 ? 2 : 0;
    int maxLevel = kWalk == 0 ? int(origin.w) : minLevel;
    TraceResult result =
        traceHiz(view, origin.xyz, dir.xyz, HizSettings(minLevel, maxLevel, params.hizLimits.z, dir.w));
    storeTrace(ray, vec4(float(result.hitClass), float(result.reason), result.positionSS),
               vec4(result.linearDepth, 0.0, float(result.iterations), 0.0));
}

void main()
{
    ivec2 size = textureSize(rayImage, 0);
    int ray = int(gl_GlobalInvocationID.y) * 8 + int(gl_GlobalInvocationID.x);
    if (ray >= size.x) return;
    View view = loadView();
    vec4 origin = texelFetch(rayImage, ivec2(ray, 0), 0);
    vec4 dir = texelFetch(rayImage, ivec2(ray, 1), 0);
    if (kProjectionModel == kTracingModelPatches) {
        tracePatchRay(view, ray, origin, dir);
    } else {
        traceHizRay(view, ray, origin, dir);
    }
}
