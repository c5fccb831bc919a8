// Replaces: crossray/project/hiz.glsl enterHizCell
// Fails: a border is crossed in x where it comes before that in y, and in y where it comes before that in x; in a corner
// neither does, and the ray stays.
HizCell enterHizCell(ScreenFrame frame, ScreenRay ray, HizState state, bool isFinest)
{
    ivec2 cells = depthPyramidSize(state.level);
    ivec2 cell = computeDepthPyramidCell(state.pixel, state.level, cells);
    CellSpan x = computeCellSpan(cell.x, state.level, cells.x, frame.imageSize.x);
    CellSpan y = computeCellSpan(cell.y, state.level, cells.y, frame.imageSize.y);
    bool runsLeft = ray.deltaSS.x < 0.0;
    bool runsUp = ray.deltaSS.y < 0.0;
    float leaveX = borderTime(ray.startSS.x, ray.deltaSS.x, runsLeft ? x.begin : x.end);
    float leaveY = borderTime(ray.startSS.y, ray.deltaSS.y, runsUp ? y.begin : y.end);
    float leave = max(min(leaveX, leaveY), state.s);
    vec2 atBorder = screenRayPositionSS(ray, leave);
    ivec2 next = state.level == 0 ? state.pixel : ivec2(floor(atBorder));
    if (leaveX < leaveY) next.x = runsLeft ? x.begin - 1 : x.end;
    if (leaveY < leaveX) next.y = runsUp ? y.begin - 1 : y.end;
    bool staysInside = all(equal(next, clamp(next, ivec2(0), frame.imageSize - ivec2(1))));
    float enterDepth = linearDepthFromAffine(frame.orthographic, screenRayAffineDepth(ray, state.s));
    float leaveDepth = linearDepthFromAffine(frame.orthographic, screenRayAffineDepth(ray, min(leave, 1.0)));
    return HizCell(cell, ivec2(x.begin, y.begin), ivec2(x.end, y.end), fetchDepthPyramid(cell, state.level), state.s,
                   min(leave, 1.0), next, leave < 1.0 && !staysInside, !(leave < 1.0), min(enterDepth, leaveDepth),
                   max(enterDepth, leaveDepth));
}
