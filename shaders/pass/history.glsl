// The colour that the previous frame holds for what a pixel's ray has met: reprojected, and blurred by the roughness.
// Hooks: fetchMotionUV, loadColorCell, and the block params.
#ifndef PASS_HISTORY_GLSL
#define PASS_HISTORY_GLSL

#include "crossray/project/color_pyramid.glsl"
#include "crossray/project/reprojection.glsl"
#include "pass/pixel_ray.glsl"
#include "pass/view_of_params.glsl"

// Values of kColorSource.
const int kColorSourceCurrent = 0;
const int kColorSourceMotion = 1;
const int kColorSourceView = 2;

// The colour pyramid has the levels of the depth pyramid, as both images are of one size.
ivec2 colorPyramidSize(int level) { return ivec2(params.pyramidLevels[level].y, params.pyramidLevels[level].z); }
vec4 fetchColorPyramid(ivec2 cell, int level)
{
    ivec4 layoutOfLevel = params.pyramidLevels[level];
    return loadColorCell(layoutOfLevel.x + cell.y * layoutOfLevel.y + cell.x);
}

struct HistoryColor {
    vec3 color;       // 0 where there is none
    bool isFound;
    vec2 positionUV;  // in the previous frame; 0 where it has none
    float level;      // of the colour pyramid
};

// The previous camera, as far as projecting asks for it.
View loadPreviousView()
{
    return View(params.previousViewFromWorld, mat4(1.0), mat4(1.0), params.imageSizeAndSlope.xy,
                params.history.xy, params.depthTerms.x, params.depthTerms.y, params.depthTerms.z, params.depthTerms.w,
                kOrthographic == 1, kReversedDepth == 1);
}

Reprojection reprojectHit(View view, vec2 positionSS, float linearDepth)
{
    if (kColorSource == kColorSourceView) {
        return reprojectByView(loadPreviousView(), positionWSFromSS(view, positionSS, linearDepth));
    }
    ivec2 pixel = clamp(ivec2(floor(positionSS)), ivec2(0, 0), ivec2(view.imageSize) - ivec2(1, 1));
    // Off screen nothing is known of the motion.
    vec2 motionUV = fetchMotionUV(pixel);
    Reprojection previous = reprojectByMotion(positionSS / view.imageSize, motionUV);
    return isOnScreen(view, positionSS) ? previous : Reprojection(vec2(0.0, 0.0), false);
}

float computeHistoryLevel()
{
    int levels = int(params.history.z);
    if (kEffect == kEffectRefraction) return computeRefractionColorLevel(params.material.z, levels);
    return computeReflectionColorLevel(params.material.z, levels);
}

HistoryColor lookUpHistory(View view, vec2 positionSS, float linearDepth)
{
    Reprojection previous = reprojectHit(view, positionSS, linearDepth);
    float level = computeHistoryLevel();
    ColorSample found = sampleColorPyramid(previous.positionUV, level, int(params.history.z));
    bool isFound = previous.isOnScreen && found.isValid;
    return HistoryColor(choose(isFound, found.color, vec3(0.0)), isFound, previous.positionUV, level);
}

#endif
