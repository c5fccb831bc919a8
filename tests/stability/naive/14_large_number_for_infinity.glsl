// Replaces: crossray/core/view.glsl linearDepthFromDevice
// Fails: the formula of a finite far plane with a large number for it: the depths are short by their share of that number.
float linearDepthFromDevice(View view, float deviceDepth)
{
    float near = view.nearDistance;
    float far = view.farDistance;
    float standard = view.reversedDepth ? deviceDepth : 1.0 - deviceDepth;
    return near * far / (near + standard * (far - near));
}
