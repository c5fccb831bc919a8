// Resources of the pass color_pyramid.
#ifndef BINDINGS_COLOR_PYRAMID_GLSL
#define BINDINGS_COLOR_PYRAMID_GLSL

#include "crossray/shared/pass_params.glsl"
#include "bindings/binding_numbers.glsl"
#include "bindings/variants.glsl"

layout(std140, binding = kParamsBinding) uniform PyramidParamsBlock { PyramidParams pyramidParams; };
layout(binding = kHistoryColorBinding) uniform sampler2D historyColorImage; // rgb: linear radiance, as it came
layout(std430, binding = kColorPyramidBinding) buffer ColorPyramidBlock { vec4 colorCells[]; }; // colour, coverage

vec3 fetchHistoryColor(ivec2 pixel) { return texelFetch(historyColorImage, pixel, 0).rgb; }
vec4 loadColorCell(int index) { return colorCells[index]; }
void storeColorCell(int index, vec4 value) { colorCells[index] = value; }

#endif
