// Replaces: crossray/project/reprojection.glsl makeReprojection
// Fails: the place is clamped to the border of the previous frame, whose colour is smeared over all that was not in sight.
Reprojection makeReprojection(vec2 positionUV, bool isPlaced)
{
    return Reprojection(clamp(positionUV, vec2(0.0), vec2(1.0)), isPlaced);
}
