// Replaces: pass/pixel_surface.glsl loadPixelSurface
// Fails: the middle of four pixels is a corner that has no depth; with that of one of them the ray starts beside the
// surface.
PixelSurface loadPixelSurface(View view, ivec2 pixel)
{
    vec2 positionSS = (vec2(pixel / 2) + vec2(0.5)) * 2.0;
    float linearDepth = linearDepthFromDevice(view, fetchDeviceDepth(pixel));
    vec3 positionWS = positionWSFromSS(view, positionSS, linearDepth);
    return PixelSurface(positionSS, linearDepth, positionWS, fetchNormalWS(pixel), viewDirectionWS(view, positionWS));
}
