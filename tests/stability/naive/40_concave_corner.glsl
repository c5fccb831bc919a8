// Replaces: crossray/project/patch_tracer.glsl doesSurfaceGoOn
// Fails: each pixel's plane is asked alone, and a ray that meets the other wall between two pixels of the corner has passed both.
bool doesSurfaceGoOn(PatchWalk walk, PatchCell cell, ivec2 pixel, PixelEntry entry)
{
    return false;
}
