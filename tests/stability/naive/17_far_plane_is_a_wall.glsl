// Replaces: crossray/core/view.glsl isClearedDepth
// Fails: nothing is said to be empty, so that each empty pixel is a surface at the far plane.
bool isClearedDepth(View view, float deviceDepth)
{
    return false;
}
