// Replaces: crossray/project/depth_pyramid.glsl reduceDepthPyramidCell
// Fails: the mean of a thin pole's depth and the wall's is nearly the wall's: the ray passes before it, and skips the cell.
vec2 reduceDepthPyramidCell(ivec2 cell)
{
    ivec2 last = finerDepthSize() - ivec2(1);
    vec2 sum = fetchFinerDepth(min(cell * 2, last)) + fetchFinerDepth(min(cell * 2 + ivec2(1, 0), last)) +
               fetchFinerDepth(min(cell * 2 + ivec2(0, 1), last)) + fetchFinerDepth(min(cell * 2 + ivec2(1, 1), last));
    return sum / 4.0;
}
