// Replaces: crossray/project/depth_patch.glsl fitSlope
// Fails: the mean of both neighbours runs from the ball to what is behind it, so that its outline grows a skirt.
float fitSlope(ScreenFrame frame, ivec2 cell, int axis, int level, float depth, float bend, float favour)
{
    ivec2 cells = depthPyramidSize(level);
    ivec2 along = choose(axis == 0, ivec2(1, 0), ivec2(0, 1));
    ivec2 before = max(cell - along, ivec2(0));
    ivec2 after = min(cell + along, cells - ivec2(1));
    float rise = affineDepthFromLinear(frame.orthographic, fetchNearest(after, level, cells)) -
                 affineDepthFromLinear(frame.orthographic, fetchNearest(before, level, cells));
    int steps = (after.x - before.x) + (after.y - before.y);
    return rise / float(max(steps << level, 1));
}
