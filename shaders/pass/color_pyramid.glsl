// Builds one cell of one level of the colour pyramid: level 0 from the previous frame's colour, each later one from the
// level before.
// Hooks: fetchHistoryColor, loadColorCell, storeColorCell, and the block pyramidParams; bindings/color_pyramid.glsl.
#ifndef PASS_COLOR_PYRAMID_GLSL
#define PASS_COLOR_PYRAMID_GLSL

#define CROSSRAY_REDUCE_COLOR_PYRAMID
#include "crossray/project/color_pyramid.glsl"

ivec2 finerColorSize() { return ivec2(pyramidParams.sourceLevel.y, pyramidParams.sourceLevel.z); }
int finerColorLevel() { return pyramidParams.sourceLevel.w; }
ivec2 colorImageSize() { return ivec2(pyramidParams.imageSize.x, pyramidParams.imageSize.y); }
vec4 fetchFinerColor(ivec2 cell)
{
    return loadColorCell(pyramidParams.sourceLevel.x + cell.y * pyramidParams.sourceLevel.y + cell.x);
}

void buildColorCell(ivec2 cell)
{
    ivec4 target = pyramidParams.targetLevel;
    if (cell.x >= target.y || cell.y >= target.z) return;
    int index = target.x + cell.y * target.y + cell.x;
    if (target.w == 0) {
        storeColorCell(index, makeColorPyramidTexel(fetchHistoryColor(cell)));
    } else {
        storeColorCell(index, reduceColorPyramidCell(cell));
    }
}

#endif
