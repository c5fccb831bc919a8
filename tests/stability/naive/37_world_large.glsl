// Replaces: crossray/project/patch_tracer.glsl liftAffineDepth
// Fails: the tolerance is one number for all worlds; where depths are a hundred times as large it is more than the depth itself.
float liftAffineDepth(float affineDepth, float depthError)
{
    return affineDepth + 0.001 + depthError;
}
