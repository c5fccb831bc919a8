// Replaces: crossray/project/hiz.glsl testHizPlane
// Fails: the ray is compared with the depth of the pixel in which it starts, and a rounding is a hit.
HizTest testHizPlane(ScreenFrame frame, ScreenRay ray, HizState state, HizCell cell, float depthBias)
{
    float rayDepth = linearDepthFromAffine(frame.orthographic, screenRayAffineDepth(ray, cell.enter));
    bool isBehind = rayDepth >= cell.depths.x;
    bool isThick = rayDepth <= cell.depths.x + depthBias;
    bool hit = isBehind && isThick;
    float affine = affineDepthFromLinear(frame.orthographic, rayDepth);
    return HizTest(choose(hit, kIntersectionDepth, kIntersectionCell), cell.enter, affine, !isBehind, false, isBehind);
}
