// What the screen shows where a pixel's ray ended, and how far it is to be trusted: in this frame's colour, or in the previous
// frame's. Hooks: fetchColor, wantsOutput, those of pass/history.glsl, and the block params.
#ifndef PASS_PIXEL_COLOR_GLSL
#define PASS_PIXEL_COLOR_GLSL

#include "crossray/hierarchy/screen_weight.glsl"
#include "pass/history.glsl"
#include "pass/pixel_ray.glsl"
#include "pass/pixel_surface.glsl"
#include "pass/projection.glsl"

struct ScreenColor {
    vec3 color;     // linear radiance; 0 where nothing was hit
    float weight;   // share that the screen asks for, [0,1]
    vec2 historyUV; // where the previous frame was read; 0 where it was not
    float mipLevel; // of the colour pyramid
};

// Where the colour is looked up.
struct ColorPlace {
    vec2 positionSS;
    float linearDepth; // metres
};

ScreenColor noScreenColor() { return ScreenColor(vec3(0.0, 0.0, 0.0), 0.0, vec2(0.0, 0.0), 0.0); }

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
bool wantsHistory() { return wantsOutput(kOutputHistoryUV) || wantsOutput(kOutputColorMipLevel); }
bool wantsScreenColor() { return wantsOutput(kOutputSampledColor) || wantsOutput(kOutputColor); }

// The hit; for a refraction whose hit lies in front of the refracting surface the pixel itself: what is before the glass is
// not seen through it.
ColorPlace chooseColorPlace(PixelSurface surface, PixelAnswer answer)
{
    if (kEffect != kEffectRefraction) return ColorPlace(answer.positionSS, answer.linearDepth);
    bool isBefore = answer.linearDepth < surface.linearDepth;
    return ColorPlace(choose(isBefore, surface.positionSS, answer.positionSS),
                      choose(isBefore, surface.linearDepth, answer.linearDepth));
}

// Without a place in the previous frame the hit is none for the colour: its weight is 0.
ScreenColor computeHistoryColor(View view, ColorPlace place, float weight)
{
    HistoryColor found = lookUpHistory(view, place.positionSS, place.linearDepth);
    return ScreenColor(found.color, found.isFound ? weight : 0.0, found.positionUV, found.level);
}

ScreenColor computeScreenColor(View view, PixelSurface surface, PixelAnswer answer)
{
    if (answer.hitClass != kHitClassHit) return noScreenColor();
    float weight = 0.0;
    if (wantsScreenWeight()) {
        weight = computeScreenWeight(answer.positionSS / view.imageSize, params.tracing.y, kScreenWeightForm);
    }
    ColorPlace place = chooseColorPlace(surface, answer);
    if (kColorSource != kColorSourceCurrent) {
        if (wantsScreenWeight() || wantsScreenColor() || wantsHistory()) return computeHistoryColor(view, place, weight);
        return noScreenColor();
    }
    vec3 color = vec3(0.0, 0.0, 0.0);
    if (wantsScreenColor() && isOnScreen(view, place.positionSS)) color = fetchColorAt(place.positionSS);
    return ScreenColor(color, weight, vec2(0.0, 0.0), 0.0);
}

#endif
