// Replaces: crossray/project/hiz.glsl enterHizCell
// Fails: the ray is moved over a border by 2^-12 px; from 4096 px on a float has no such part of a pixel left, and the ray
// comes back into the cell that it leaves.
HizCell enterHizCell(ScreenFrame frame, ScreenRay ray, HizState state, bool isFinest)
{
    ivec2 cells = depthPyramidSize(state.level);
    ivec2 cell = computeDepthPyramidCell(state.pixel, state.level, cells);
    CellSpan x = computeCellSpan(cell.x, state.level, cells.x, frame.imageSize.x);
    CellSpan y = computeCellSpan(cell.y, state.level, cells.y, frame.imageSize.y);
    vec2 border = vec2(ray.deltaSS.x < 0.0 ? x.begin : x.end, ray.deltaSS.y < 0.0 ? y.begin : y.end);
    vec2 times = (border - ray.startSS) / ray.deltaSS;
    float leave = max(min(times.x, times.y), state.s);
    vec2 nudge = vec2(ray.deltaSS.x < 0.0 ? -1.0 : 1.0, ray.deltaSS.y < 0.0 ? -1.0 : 1.0) * 0.000244140625;
    ivec2 next = ivec2(floor(screenRayPositionSS(ray, leave) + nudge));
    bool staysInside = all(equal(next, clamp(next, ivec2(0), frame.imageSize - ivec2(1))));
    float enterDepth = linearDepthFromAffine(frame.orthographic, screenRayAffineDepth(ray, state.s));
    float leaveDepth = linearDepthFromAffine(frame.orthographic, screenRayAffineDepth(ray, min(leave, 1.0)));
    return HizCell(cell, ivec2(x.begin, y.begin), ivec2(x.end, y.end), fetchDepthPyramid(cell, state.level), state.s,
                   min(leave, 1.0), next, leave < 1.0 && !staysInside, !(leave < 1.0), min(enterDepth, leaveDepth),
                   max(enterDepth, leaveDepth));
}
