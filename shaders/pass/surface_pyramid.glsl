// Builds one cell of one level of the pyramid of planes: level 0 from depth and normal, each later one from the level before.
// Hooks: fetchDeviceDepth, fetchNormalWS, loadSurfaceCell, storeSurfaceCell, and the block surfaceParams;
// bindings/surface_pyramid.glsl.
#ifndef PASS_SURFACE_PYRAMID_GLSL
#define PASS_SURFACE_PYRAMID_GLSL

#define CROSSRAY_BUILD_SURFACE_PYRAMID
#include "crossray/core/view.glsl"
#include "crossray/project/surface_pyramid.glsl"

ivec2 finerSurfaceSize() { return ivec2(surfaceParams.sourceLevel.y, surfaceParams.sourceLevel.z); }
vec4 fetchFinerSurface(ivec2 cell)
{
    return loadSurfaceCell(surfaceParams.sourceLevel.x + cell.y * surfaceParams.sourceLevel.y + cell.x);
}

// Planes are made in view space: where the eye is in the world is not asked for.
View loadSurfaceView()
{
    vec4 size = surfaceParams.imageSizeAndSlope;
    vec4 terms = surfaceParams.depthTerms;
    return View(surfaceParams.viewFromWorld, mat4(1.0), mat4(1.0), size.xy, size.zw, terms.x, terms.y, terms.z, terms.w,
                kOrthographic == 1, kReversedDepth == 1);
}

void buildSurfaceCell(ivec2 cell)
{
    ivec4 target = surfaceParams.targetLevel;
    if (cell.x >= target.y || cell.y >= target.z) return;
    int index = target.x + cell.y * target.y + cell.x;
    View view = loadSurfaceView();
    if (target.w == 0) {
        storeSurfaceCell(index, buildSurfacePixel(view, cell, surfaceParams.patches.y));
    } else {
        storeSurfaceCell(index, reduceSurfaceCell(cell, surfaceParams.sourceLevel.w, ivec2(view.imageSize)));
    }
}

#endif
