// Replaces: crossray/project/hiz.glsl testHizPlane
// Fails: the ray has to be between the depth and the depth plus the thickness, and at thickness 0 nothing is between.
HizTest testHizPlane(ScreenFrame frame, ScreenRay ray, HizState state, HizCell cell, float depthBias)
{
    float surfaceDepth = cell.depths.x;
    float rayDepth = linearDepthFromAffine(frame.orthographic, screenRayAffineDepth(ray, cell.leave));
    bool isBehind = rayDepth > surfaceDepth;
    bool isThick = rayDepth < surfaceDepth + depthBias;
    bool hit = isBehind && isThick && !state.isStart;
    float affine = affineDepthFromLinear(frame.orthographic, surfaceDepth);
    return HizTest(choose(hit, kIntersectionDepth, kIntersectionCell), cell.enter, affine, !isBehind, false, isBehind);
}
