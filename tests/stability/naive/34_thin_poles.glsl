// Replaces: crossray/project/patch_tracer.glsl computeClearance
// Fails: a ray that was hidden once is never trusted again, so that each pole throws a wide shadow of lost rays.
float computeClearance(View view, PatchWalk walk, HiddenStart hidden, ivec2 last, float s)
{
    return -1.0;
}
