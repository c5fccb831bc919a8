// Replaces: crossray/project/reprojection.glsl makeReprojection
// Fails: step of a NaN is 1 where the driver asks for "not less", and a place that is none is on screen.
Reprojection makeReprojection(vec2 positionUV, bool isPlaced)
{
    vec2 inside = step(vec2(0.0), positionUV) * step(positionUV, vec2(1.0));
    return Reprojection(positionUV, isPlaced && inside.x * inside.y > 0.0);
}
