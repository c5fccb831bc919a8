// Replaces: crossray/project/hiz.glsl testHizPlane
// Fails: the ray starts behind the pane, within the thickness of the pixels beside it, and claims the pane itself.
HizTest testHizPlane(ScreenFrame frame, ScreenRay ray, HizState state, HizCell cell, float depthBias)
{
    float surfaceDepth = cell.depths.x;
    bool isBehind = cell.rayFarthest > surfaceDepth;
    bool isThick = cell.rayNearest < surfaceDepth + depthBias;
    bool hit = isBehind && isThick && !state.isStart;
    float affine = affineDepthFromLinear(frame.orthographic, surfaceDepth);
    return HizTest(choose(hit, kIntersectionDepth, kIntersectionCell), cell.enter, affine, !isBehind, false, isBehind);
}
