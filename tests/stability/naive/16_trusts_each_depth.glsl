// Replaces: pass/surface_pyramid.glsl buildSurfaceLevel
// Replaces: pass/projection.glsl answerByPatches
// Fails: planes and rays are compared as if depth were exact: the floor is a flight of rounded steps, and a ray that
// leaves it is behind the next one at once.
void buildSurfaceLevel(View view, CellRect cells, int level)
{
    for (int y = cells.begin.y; y < cells.end.y; ++y) {
        for (int x = cells.begin.x; x < cells.end.x; ++x) {
            ivec2 cell = ivec2(x, y);
            vec4 packedCell;
            if (level == 0) {
                packedCell = buildSurfacePixel(view, cell, 0.0);
            } else {
                packedCell = reduceSurfaceCell(cell, level - 1, ivec2(view.imageSize));
            }
            storeSurfaceCell(surfaceCellIndex(cell, level), packedCell);
        }
    }
}

PixelAnswer answerByPatches(View view, RefractionExit ray)
{
    PatchTracerSettings settings = PatchTracerSettings(params.hizLimits.y, params.hizLimits.z, params.patches.x, 0.0);
    PatchTraceResult result = tracePatches(view, ray.positionWS, ray.dirWS, settings);
    return PixelAnswer(result.hitClass, result.reason, ray.positionWS, ray.dirWS, ray.pathLength, result.positionSS,
                       result.hitClass == kHitClassHit ? result.linearDepth : 0.0, result.iterations,
                       result.maxUsedLevel, result.intersectionKind, result.confidence);
}
