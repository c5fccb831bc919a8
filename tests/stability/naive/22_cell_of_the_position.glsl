// Replaces: crossray/project/hiz.glsl enterHizCell
// Fails: the cell is that of the position at the border; of an edge that is the one to the right, and a ray to the left
// never leaves it.
HizCell enterHizCell(ScreenFrame frame, ScreenRay ray, HizState state, bool isFinest)
{
    ivec2 cells = depthPyramidSize(state.level);
    ivec2 cell = computeDepthPyramidCell(state.pixel, state.level, cells);
    CellSpan x = computeCellSpan(cell.x, state.level, cells.x, frame.imageSize.x);
    CellSpan y = computeCellSpan(cell.y, state.level, cells.y, frame.imageSize.y);
    vec2 border = vec2(ray.deltaSS.x < 0.0 ? x.begin : x.end, ray.deltaSS.y < 0.0 ? y.begin : y.end);
    vec2 times = (border - ray.startSS) / ray.deltaSS;
    float leave = max(min(times.x, times.y), state.s);
    ivec2 next = ivec2(floor(screenRayPositionSS(ray, leave)));
    bool staysInside = all(equal(next, clamp(next, ivec2(0), frame.imageSize - ivec2(1))));
    float enterDepth = linearDepthFromAffine(frame.orthographic, screenRayAffineDepth(ray, state.s));
    float leaveDepth = linearDepthFromAffine(frame.orthographic, screenRayAffineDepth(ray, min(leave, 1.0)));
    return HizCell(cell, ivec2(x.begin, y.begin), ivec2(x.end, y.end), fetchDepthPyramid(cell, state.level), state.s,
                   min(leave, 1.0), next, leave < 1.0 && !staysInside, !(leave < 1.0), min(enterDepth, leaveDepth),
                   max(enterDepth, leaveDepth));
}
