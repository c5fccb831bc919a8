// What a pixel shows: the surface that its ray starts from. Hooks: fetchDeviceDepth, fetchNormalWS.
#ifndef PASS_PIXEL_SURFACE_GLSL
#define PASS_PIXEL_SURFACE_GLSL

#include "crossray/core/view.glsl"

struct PixelSurface {
    vec2 positionSS; // the pixel's centre
    float linearDepth; // metres
    vec3 positionWS;
    vec3 normalWS; // as the G-buffer has it
    vec3 viewDirWS;
};

PixelSurface loadPixelSurface(View view, ivec2 pixel)
{
    vec2 positionSS = vec2(pixel) + vec2(0.5, 0.5);
    float linearDepth = linearDepthFromDevice(view, fetchDeviceDepth(pixel));
    vec3 positionWS = positionWSFromSS(view, positionSS, linearDepth);
    return PixelSurface(positionSS, linearDepth, positionWS, fetchNormalWS(pixel), viewDirectionWS(view, positionWS));
}

#endif
