// Replaces: pass/pixel_surface.glsl loadPixelSurface
// Fails: the inverse projection wants the z of clip space, which is the stored depth in one kind of API and not in the
// other.
PixelSurface loadPixelSurface(View view, ivec2 pixel)
{
    vec2 positionSS = vec2(pixel) + vec2(0.5, 0.5);
    vec4 clip = vec4(positionNDCFromSS(view, positionSS), fetchDeviceDepth(pixel), 1.0);
    vec4 positionVS = inverse(view.clipFromView) * clip;
    vec3 positionWS = positionWSFromVS(view, positionVS.xyz / positionVS.w);
    return PixelSurface(positionSS, -positionVS.z / positionVS.w, positionWS, fetchNormalWS(pixel),
                        viewDirectionWS(view, positionWS));
}
