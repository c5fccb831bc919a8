// Replaces: crossray/project/depth_patch.glsl fitDepthPatch
// Fails: a cell counts as a block at its nearest depth; a floor is a flight of stairs, with risers that rays hit.
DepthPatch fitDepthPatch(ScreenFrame frame, ivec2 cell, int level, float nearestLinearDepth, vec2 favourSS)
{
    return DepthPatch((vec2(cell) + 0.5) * float(1 << level),
                      affineDepthFromLinear(frame.orthographic, nearestLinearDepth), vec2(0.0));
}
