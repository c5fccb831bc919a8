// Replaces: crossray/project/surface_pyramid.glsl packSurfaceCell
// Fails: a half float has 11 bits of a depth.
vec4 packSurfaceCell(SurfaceCell cell)
{
    vec2 depthAndSlack = unpackHalf2x16(packHalf2x16(vec2(cell.affineDepth, cell.slack)));
    vec2 gradient = unpackHalf2x16(packHalf2x16(cell.gradient));
    return vec4(depthAndSlack.x, gradient, depthAndSlack.y);
}
