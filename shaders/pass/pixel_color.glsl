// What the screen shows where a pixel's ray ended, and how far it is to be trusted. Hooks: fetchColor, wantsOutput, and the block params.
#ifndef PASS_PIXEL_COLOR_GLSL
#define PASS_PIXEL_COLOR_GLSL

#include "crossray/hierarchy/screen_weight.glsl"
#include "pass/projection.glsl"

struct ScreenColor {
    vec3 color;   // linear radiance; 0 where nothing was hit
    float weight; // share that the screen asks for, [0,1]
};

vec3 fetchColorAt(vec2 positionSS)
{
    ivec2 size = ivec2(int(params.imageSizeAndSlope.x), int(params.imageSizeAndSlope.y));
    return fetchColor(clamp(ivec2(floor(positionSS)), ivec2(0, 0), size - ivec2(1, 1)));
}

bool wantsScreenWeight()
{
    bool byTiers = kHierarchy != 0 && (wantsOutput(kOutputTierWeights) || wantsOutput(kOutputProbeWeights) ||
                                       wantsOutput(kOutputProbeDirWS) || wantsOutput(kOutputProbeMipLevel));
    return wantsOutput(kOutputHitWeight) || wantsOutput(kOutputColor) || byTiers;
}
bool wantsScreenColor() { return wantsOutput(kOutputSampledColor) || wantsOutput(kOutputColor); }

ScreenColor computeScreenColor(View view, PixelAnswer answer)
{
    bool hit = answer.hitClass == kHitClassHit;
    float weight = 0.0;
    if (wantsScreenWeight()) {
        weight = hit ? computeScreenWeight(answer.positionSS / view.imageSize, params.tracing.y, kScreenWeightForm) : 0.0;
    }
    vec3 color = vec3(0.0, 0.0, 0.0);
    if (wantsScreenColor()) {
        bool onScreen = all(greaterThanEqual(answer.positionSS, vec2(0.0, 0.0))) &&
                        all(lessThanEqual(answer.positionSS, view.imageSize));
        if (hit && onScreen) color = fetchColorAt(answer.positionSS);
    }
    return ScreenColor(color, weight);
}

#endif
