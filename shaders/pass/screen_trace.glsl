// One pixel of the pass screen_trace: the reflected or refracted ray, its projection by one of the models, the screen weight, and
// the debug modes. The variant constants select the code; what a variant does not use is not in it.
// Hooks: fetchDeviceDepth, fetchNormalWS, fetchColor, fetchTraced, loadPyramidCell, storeOutputValue, and the block params;
// bindings/screen_trace.glsl.
#ifndef PASS_SCREEN_TRACE_GLSL
#define PASS_SCREEN_TRACE_GLSL

#include "pass/output_slots.glsl"
#include "pass/view_of_params.glsl"

#include "pass/pixel_ray.glsl"
#include "pass/projection.glsl"

#include "pass/pixel_color.glsl"
#include "pass/store_outputs.glsl"

PixelAnswer answerPixel(View view, ivec2 pixel)
{
    vec2 positionSS = vec2(pixel) + vec2(0.5, 0.5);
    float linearDepth = linearDepthFromDevice(view, fetchDeviceDepth(pixel));
    vec3 positionWS = positionWSFromSS(view, positionSS, linearDepth);
    vec3 viewDirWS = viewDirectionWS(view, positionWS);
    return projectRay(view, computePixelRay(positionWS, fetchNormalWS(pixel), viewDirWS), positionSS);
}

PixelAnswer answerUntraced()
{
    vec3 none = vec3(0.0, 0.0, 0.0);
    return PixelAnswer(kHitClassNoRaycast, kHitReasonNone, none, none, 0.0, vec2(0.0, 0.0), 0.0, 0, 0, 0);
}

void traceScreenPixel(ivec2 pixel)
{
    View view = loadView();
    if (float(pixel.x) >= view.imageSize.x || float(pixel.y) >= view.imageSize.y) return;
    if (!fetchTraced(pixel)) {
        storeAnswer(view, pixel, answerUntraced(), ScreenColor(vec3(0.0, 0.0, 0.0), 0.0));
        return;
    }
    PixelAnswer answer = answerPixel(view, pixel);
    storeAnswer(view, pixel, answer, computeScreenColor(view, answer));
}

#endif
