// Replaces: crossray/project/reprojection.glsl makeReprojection
// Fails: a hit that lies on the border of the previous frame is taken for one beside it.
Reprojection makeReprojection(vec2 positionUV, bool isPlaced)
{
    bool isInside = positionUV.x > 0.0 && positionUV.x < 1.0 && positionUV.y > 0.0 && positionUV.y < 1.0;
    return Reprojection(positionUV, isPlaced && isInside);
}
