// Replaces: pass/depth_pyramid.glsl buildPyramidCell
// Fails: the depth is read through a filter, as a resolve of a multisampled one does: every edge becomes a row of surfaces
// between the near one and the far one, and rays that pass there are stopped.
void buildPyramidCell(ivec2 cell)
{
    ivec4 target = pyramidParams.targetLevel;
    if (cell.x >= target.y || cell.y >= target.z) return;
    int index = target.x + cell.y * target.y + cell.x;
    if (target.w == 0) {
        float sum = 0.0;
        for (int y = -1; y <= 1; ++y) {
            for (int x = -1; x <= 1; ++x) {
                ivec2 texel = clamp(cell + ivec2(x, y), ivec2(0), ivec2(target.y, target.z) - ivec2(1));
                sum += fetchDeviceDepth(texel) * (x == 0 ? 0.75 : 0.125) * (y == 0 ? 0.75 : 0.125);
            }
        }
        storePyramidCell(index, makeDepthPyramidTexel(loadDepthView(), sum));
    } else {
        storePyramidCell(index, reduceDepthPyramidCell(cell));
    }
}
