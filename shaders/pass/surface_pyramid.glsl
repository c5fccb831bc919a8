// Builds some levels of the pyramid of planes: a cell of the coarsest of them, and all cells below it that are of these
// levels. No two cells share one below, so that nothing is to be waited for. Level 0 is made from depth and normal.
// Hooks: fetchDeviceDepth, fetchNormalWS, loadSurfaceCell, storeSurfaceCell, and the block surfaceParams;
// bindings/surface_pyramid.glsl.
#ifndef PASS_SURFACE_PYRAMID_GLSL
#define PASS_SURFACE_PYRAMID_GLSL

#define CROSSRAY_BUILD_SURFACE_PYRAMID
#include "crossray/core/view.glsl"
#include "crossray/project/surface_pyramid.glsl"

ivec2 finerSurfaceSize(int level) { return ivec2(surfaceParams.levels[level].y, surfaceParams.levels[level].z); }
int surfaceCellIndex(ivec2 cell, int level)
{
    return surfaceParams.levels[level].x + cell.y * surfaceParams.levels[level].y + cell.x;
}
vec4 fetchFinerSurface(ivec2 cell, int level) { return loadSurfaceCell(surfaceCellIndex(cell, level)); }

// Planes are made in view space: where the eye is in the world is not asked for.
View loadSurfaceView()
{
    vec4 size = surfaceParams.imageSizeAndSlope;
    vec4 terms = surfaceParams.depthTerms;
    return View(surfaceParams.viewFromWorld, mat4(1.0), mat4(1.0), size.xy, size.zw, terms.x, terms.y, terms.z, terms.w,
                kOrthographic == 1, kReversedDepth == 1);
}

void buildSurfaceLevel(View view, CellRect cells, int level)
{
    for (int y = cells.begin.y; y < cells.end.y; ++y) {
        for (int x = cells.begin.x; x < cells.end.x; ++x) {
            ivec2 cell = ivec2(x, y);
            vec4 packedCell;
            if (level == 0) {
                packedCell = buildSurfacePixel(view, cell, surfaceParams.patches.y);
            } else {
                packedCell = reduceSurfaceCell(cell, level - 1, ivec2(view.imageSize));
            }
            storeSurfaceCell(surfaceCellIndex(cell, level), packedCell);
        }
    }
}

void buildSurfaceCells(ivec2 cell)
{
    int first = surfaceParams.range.x;
    int last = min(surfaceParams.range.y, CROSSRAY_MAX_PYRAMID_LEVELS - 1);
    ivec2 size = finerSurfaceSize(last);
    if (cell.x >= size.x || cell.y >= size.y) return;
    View view = loadSurfaceView();
    for (int level = first; level <= last; ++level)
        buildSurfaceLevel(view, computeCellRect(cell, last - level, size, finerSurfaceSize(level)), level);
}

#endif
