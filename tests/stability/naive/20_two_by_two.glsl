// Replaces: crossray/project/depth_pyramid.glsl reduceDepthPyramidCell
// Fails: of an odd size the last row or column is in no cell of the next level; what stands there is never found.
vec2 reduceDepthPyramidCell(ivec2 cell)
{
    vec2 a = fetchFinerDepth(cell * 2);
    vec2 b = fetchFinerDepth(min(cell * 2 + ivec2(1, 0), finerDepthSize() - ivec2(1)));
    vec2 c = fetchFinerDepth(min(cell * 2 + ivec2(0, 1), finerDepthSize() - ivec2(1)));
    vec2 d = fetchFinerDepth(min(cell * 2 + ivec2(1, 1), finerDepthSize() - ivec2(1)));
    return vec2(min(min(a.x, b.x), min(c.x, d.x)), max(max(a.y, b.y), max(c.y, d.y)));
}
