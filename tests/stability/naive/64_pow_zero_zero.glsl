// Replaces: crossray/probe/rgbm.glsl decodeRgbmLinear
// Fails: pow(0, 0) is what the driver makes of 0 times the logarithm of 0.
vec3 decodeRgbmLinear(vec4 encoded, vec4 decode)
{
    float alpha = max(decode.w * (encoded.w - 1.0) + 1.0, 0.0);
    return encoded.xyz * (decode.x * pow(alpha, decode.y));
}
