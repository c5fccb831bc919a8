// Replaces: crossray/project/depth_pyramid.glsl computeDepthPyramidCell
// Fails: the pixels that no whole cell covers get a cell beyond the level's last, whose depths are another row's or nothing.
ivec2 computeDepthPyramidCell(ivec2 pixel, int level, ivec2 levelSize)
{
    return ivec2(pixel.x >> level, pixel.y >> level);
}
