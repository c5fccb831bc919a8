// Replaces: crossray/project/patch_tracer.glsl computeClearance
// Fails: a ray that comes out from behind something goes on as if it had passed, also where it ended on the underside.
float computeClearance(View view, PatchWalk walk, HiddenStart hidden, ivec2 last, float s)
{
    return kNoClearance;
}
