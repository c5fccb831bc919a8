// Replaces: crossray/probe/rgbm.glsl decodeRgbmLinear
// Fails: abs keeps the power from being NaN, and makes a negative alpha as bright as its mirror image.
vec3 decodeRgbmLinear(vec4 encoded, vec4 decode)
{
    float alpha = decode.w * (encoded.w - 1.0) + 1.0;
    return encoded.xyz * (decode.x * pow(abs(alpha), decode.y));
}
