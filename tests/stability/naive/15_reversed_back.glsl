// Replaces: crossray/core/view.glsl linearDepthFromDevice
// Fails: 1 - d of a small d keeps of it what fits beside the 1: eight digits less of a far surface's depth.
float linearDepthFromDevice(View view, float deviceDepth)
{
    float near = view.nearDistance;
    float far = view.farDistance;
    float standard = view.reversedDepth ? 1.0 - deviceDepth : deviceDepth;
    return near * far / (far - standard * (far - near));
}
