// Builds one cell of one level of the depth pyramid: level 0 from the depth buffer, each later one from the level before.
// Hooks: fetchDeviceDepth, loadPyramidCell, storePyramidCell, and the block pyramidParams; bindings/depth_pyramid.glsl.
#ifndef PASS_DEPTH_PYRAMID_GLSL
#define PASS_DEPTH_PYRAMID_GLSL

#define CROSSRAY_REDUCE_DEPTH_PYRAMID
#include "crossray/core/view.glsl"
#include "crossray/project/depth_pyramid.glsl"

ivec2 finerDepthSize() { return ivec2(pyramidParams.sourceLevel.y, pyramidParams.sourceLevel.z); }
vec2 fetchFinerDepth(ivec2 cell)
{
    return loadPyramidCell(pyramidParams.sourceLevel.x + cell.y * pyramidParams.sourceLevel.y + cell.x);
}

// The reduction asks the view for depths alone.
View loadDepthView()
{
    vec4 terms = pyramidParams.depthTerms;
    return View(mat4(1.0), mat4(1.0), mat4(1.0), vec2(1.0), vec2(1.0), terms.x, terms.y, terms.z, terms.w,
                kOrthographic == 1, kReversedDepth == 1);
}

void buildPyramidCell(ivec2 cell)
{
    ivec4 target = pyramidParams.targetLevel;
    if (cell.x >= target.y || cell.y >= target.z) return;
    int index = target.x + cell.y * target.y + cell.x;
    if (target.w == 0) {
        storePyramidCell(index, makeDepthPyramidTexel(loadDepthView(), fetchDeviceDepth(cell)));
    } else {
        storePyramidCell(index, reduceDepthPyramidCell(cell));
    }
}

#endif
