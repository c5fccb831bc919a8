// Resources of the pass surface_pyramid.
#ifndef BINDINGS_SURFACE_PYRAMID_GLSL
#define BINDINGS_SURFACE_PYRAMID_GLSL

#include "crossray/shared/pass_params.glsl"
#include "bindings/binding_numbers.glsl"
#include "bindings/variants.glsl"

layout(std140, binding = kParamsBinding) uniform SurfaceParamsBlock { SurfaceParams surfaceParams; };
layout(binding = kDepthBinding) uniform sampler2D deviceDepthImage; // r: [0,1]
layout(binding = kNormalBinding) uniform sampler2D normalImage; // rgb: unit normal, world space
layout(std430, binding = kSurfaceBinding) buffer SurfaceBlock { vec4 surfaceCells[]; }; // packed, level after level

float fetchDeviceDepth(ivec2 pixel) { return texelFetch(deviceDepthImage, pixel, 0).r; }
vec3 fetchNormalWS(ivec2 pixel) { return texelFetch(normalImage, pixel, 0).rgb; }
vec4 loadSurfaceCell(int index) { return surfaceCells[index]; }
void storeSurfaceCell(int index, vec4 value) { surfaceCells[index] = value; }

#endif
