// Resources of the pass screen_trace.
#ifndef BINDINGS_SCREEN_TRACE_GLSL
#define BINDINGS_SCREEN_TRACE_GLSL

#include "crossray/shared/pass_params.glsl"
#include "crossray/shared/probe_params.glsl"
#include "crossray/shared/planar_params.glsl"
#include "bindings/binding_numbers.glsl"
#include "bindings/variants.glsl"

layout(std140, binding = kParamsBinding) uniform PassParamsBlock { PassParams params; };
layout(binding = kDepthBinding) uniform sampler2D deviceDepthImage; // r: [0,1]
layout(binding = kNormalBinding) uniform sampler2D normalImage; // rgb: unit normal, world space
layout(binding = kColorBinding) uniform sampler2D colorImage; // rgb: linear radiance
layout(binding = kMaskBinding) uniform sampler2D traceMaskImage; // r: above 0.5 where the pixel traces a ray
layout(binding = kMotionBinding) uniform sampler2D motionImage; // rg: UV now less UV then
layout(binding = kThicknessBinding) uniform sampler2D thicknessImage; // r: metres
layout(std430, binding = kPyramidBinding) readonly buffer PyramidBlock { vec2 pyramidCells[]; }; // nearest, farthest linear depth
layout(std430, binding = kSurfaceBinding) readonly buffer SurfaceBlock { vec4 surfaceCells[]; }; // packed, level after level
layout(std430, binding = kOutputBinding) writeonly buffer OutputBlock { vec4 outputValues[]; }; // plane after plane
layout(std430, binding = kRecordBinding) writeonly buffer RecordBlock { vec4 recordValues[]; }; // pass/record_layout.glsl
layout(std140, binding = kProbeParamsBinding) uniform ProbeParamsBlock { ProbeParams probeParams; };
layout(std140, binding = kPlanarParamsBinding) uniform PlanarParamsBlock { PlanarParams planarParams; };
layout(binding = kPlanarAtlasBinding) uniform sampler2D planarAtlasImage; // rgb: linear radiance; pass/planar_tier.glsl
layout(binding = kProbeAtlasBinding) uniform sampler2D probeAtlasImage; // rgb: linear radiance; pass/probe_tier.glsl
layout(std430, binding = kColorPyramidBinding) readonly buffer ColorPyramidBlock { vec4 colorCells[]; }; // colour, coverage

int fetchCount = 0; // reads by the tracer; counted where the output is asked for

#ifdef CROSSRAY_OWN_TRACER
layout(std430, binding = kOwnStatusBinding) buffer OwnStatusBlock { vec4 ownStatus; }; // line of an endless loop, pixel, 1
int ownRounds = 0;        // of the tracer's loops; harness/compile/confine.h adds what counts them, ...
int ownEndlessLine = 0;   // ... and the line of the first loop that it had to cut
int ownCoarsestLevel = 0; // that the tracer read
vec4 loadOwnStatus() { return ownStatus; }
void storeOwnStatus(vec4 status) { ownStatus = status; }
#endif

float fetchDeviceDepth(ivec2 pixel) { return texelFetch(deviceDepthImage, pixel, 0).r; }
vec3 fetchNormalWS(ivec2 pixel) { return texelFetch(normalImage, pixel, 0).rgb; }
vec3 fetchColor(ivec2 pixel) { return texelFetch(colorImage, pixel, 0).rgb; }
bool fetchTraced(ivec2 pixel) { return texelFetch(traceMaskImage, pixel, 0).r > 0.5; }
vec2 fetchMotionUV(ivec2 pixel) { return texelFetch(motionImage, pixel, 0).rg; }
float fetchThickness(ivec2 pixel) { return texelFetch(thicknessImage, pixel, 0).r; }
vec4 loadColorCell(int index) { return colorCells[index]; }
vec2 loadPyramidCell(int index) { return pyramidCells[index]; }
vec4 loadSurfaceCell(int index) { return surfaceCells[index]; }
void storeOutputValue(int index, vec4 value) { outputValues[index] = value; }
void storeRecordValue(int index, vec4 value) { recordValues[index] = value; }
vec3 fetchPlanarAtlas(ivec2 texel) { return texelFetch(planarAtlasImage, texel, 0).rgb; }
vec3 fetchProbeAtlas(ivec2 texel) { return texelFetch(probeAtlasImage, texel, 0).rgb; }

#endif
