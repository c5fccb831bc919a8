#version 450
#extension GL_GOOGLE_include_directive : require
// A water surface, as an engine would write it: screen-space reflection that falls back to a room's proxy, then to the sky.
#include "crossray/core/reflection.glsl"
#include "crossray/hierarchy/screen_weight.glsl"
#include "crossray/project/hiz.glsl"
#include "crossray/project/proxy.glsl"

layout(binding = 0, std140) uniform Frame {
    mat4 viewFromWorld;
    mat4 worldFromView;
    mat4 clipFromView;
    vec4 imageSizeAndSlope;
    vec4 depthTerms;
    vec4 roomCenterWS;
    vec4 roomHalfExtents;
};
layout(binding = 1) uniform sampler2D depthPyramid; // rg: nearest, farthest linear depth
layout(binding = 2) uniform sampler2D sceneColor;
layout(binding = 3) uniform samplerCube roomProbe;

layout(location = 0) in vec3 positionWS;
layout(location = 1) in vec3 normalWS;
layout(location = 0) out vec4 color;

vec2 fetchDepthPyramid(ivec2 cell, int level) { return texelFetch(depthPyramid, cell, level).rg; }
ivec2 depthPyramidSize(int level) { return textureSize(depthPyramid, level); }
int depthPyramidLevelCount() { return textureQueryLevels(depthPyramid); }
void recordHizStep(HizStep step) {}

void main()
{
    View view = View(viewFromWorld, worldFromView, clipFromView, imageSizeAndSlope.xy, imageSizeAndSlope.zw, depthTerms.x,
                     depthTerms.y, depthTerms.z, depthTerms.w, false, true);
    vec3 dirWS = computeReflectionDirection(normalize(normalWS), viewDirectionWS(view, positionWS));
    TraceResult hit = traceHiz(view, positionWS, dirWS, HizSettings(0, 6, 128, 0.2));
    vec2 hitUV = hit.positionSS / view.imageSize;
    float weight = hit.hitClass == kHitClassHit ? computeScreenWeight(hitUV, 0.1, kScreenWeightSmooth2018) : 0.0;

    ProxyHit room = projectProxyBox(positionWS, dirWS, roomCenterWS.xyz, mat3(1.0), roomHalfExtents.xyz);
    vec3 fallback = texture(roomProbe, room.positionWS - roomCenterWS.xyz).rgb;
    color = vec4(mix(fallback, texture(sceneColor, hitUV).rgb, weight), 1.0);
}
