// Replaces: crossray/project/patch_tracer.glsl makePatchWalk
// Fails: the march starts three pixels along the ray, so as not to hit its own surface, and so misses what is nearer than that.
PatchWalk makePatchWalk(ScreenRay ray, ivec2 startPixel, float depthError)
{
    float skipped = min(3.0 * ray.pixelLength, 1.0);
    float end = ray.startAffineDepth + ray.deltaAffineDepth;
    ScreenRay moved = ray;
    moved.startSS = screenRayPositionSS(ray, skipped);
    moved.deltaSS = ray.deltaSS * (1.0 - skipped);
    moved.startAffineDepth = screenRayAffineDepth(ray, skipped);
    moved.deltaAffineDepth = end - moved.startAffineDepth;
    ScreenRay lifted = moved;
    lifted.startAffineDepth = liftAffineDepth(moved.startAffineDepth, depthError);
    lifted.deltaAffineDepth = liftAffineDepth(end, depthError) - lifted.startAffineDepth;
    return PatchWalk(moved, lifted, ivec2(floor(moved.startSS)), true, depthError);
}
