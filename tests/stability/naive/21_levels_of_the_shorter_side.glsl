// Replaces: pass/projection.glsl depthPyramidLevelCount
// Fails: levels are counted by the shorter side, so that an image of one row has one, and is walked pixel by pixel.
int depthPyramidLevelCount()
{
    ivec2 size = depthPyramidSize(0);
    return int(log2(float(min(size.x, size.y)))) + 1;
}
