// Resources of the pass depth_pyramid.
#ifndef BINDINGS_DEPTH_PYRAMID_GLSL
#define BINDINGS_DEPTH_PYRAMID_GLSL

#include "crossray/shared/pass_params.glsl"
#include "bindings/binding_numbers.glsl"
#include "bindings/variants.glsl"

layout(std140, binding = kParamsBinding) uniform PyramidParamsBlock { PyramidParams pyramidParams; };
layout(binding = kDepthBinding) uniform sampler2D deviceDepthImage; // r: [0,1]
layout(std430, binding = kPyramidBinding) buffer PyramidBlock { vec2 pyramidCells[]; }; // nearest, farthest linear depth

float fetchDeviceDepth(ivec2 pixel) { return texelFetch(deviceDepthImage, pixel, 0).r; }
vec2 loadPyramidCell(int index) { return pyramidCells[index]; }
void storePyramidCell(int index, vec2 value) { pyramidCells[index] = value; }

#endif
