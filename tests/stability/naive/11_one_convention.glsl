// Replaces: crossray/core/view.glsl isClearedDepth
// Replaces: crossray/core/view.glsl linearDepthFromDevice
// Fails: written for depth from 0 at the near plane to 1 at the far one; a reversed buffer reads near as far.
bool isClearedDepth(View view, float deviceDepth)
{
    return deviceDepth >= 1.0;
}

float linearDepthFromDevice(View view, float deviceDepth)
{
    float near = view.nearDistance;
    float far = view.farDistance;
    return near * far / (far - deviceDepth * (far - near));
}
