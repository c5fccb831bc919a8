// Replaces: crossray/project/hiz.glsl testHizCell
// Fails: whatever is nearer than the ray is hit, however far the ray passes behind it.
HizTest testHizCell(ScreenFrame frame, ScreenRay ray, HizState state, HizCell cell, HizSettings settings)
{
    bool isSky = isSkyDepth(cell.depths.x);
    bool isBehind = !isSky && !state.isStart && cell.rayFarthest > cell.depths.x * 1.0001;
    bool isFinest = state.level == settings.minLevel;
    int kind = isBehind ? (isFinest ? kIntersectionDepth : kIntersectionCell) : kIntersectionNone;
    return HizTest(kind, isFinest ? cell.enter : state.s, screenRayAffineDepth(ray, cell.enter), true, true, false);
}
