// Radiance from a probe's 8-bit RGBM texels.
// Hooks: none. Source: Unity Built-in shader listing of HDR decoding: x range, y exponent, w how much alpha counts.
#ifndef CROSSRAY_PROBE_RGBM_GLSL
#define CROSSRAY_PROBE_RGBM_GLSL

#include "crossray/core/math.glsl"

// One channel as it may be used: in [0, 65504]; NaN and what is below 0 are 0, infinity is 65504.
float containRadiance(float value)
{
    return value > 0.0 ? min(value, kFarAway) : 0.0;
}

vec3 containRadiance(vec3 color)
{
    return vec3(containRadiance(color.x), containRadiance(color.y), containRadiance(color.z));
}

// The alpha that multiplies: w*(a - 1) + 1, so that it counts in full at w = 1 and not at all at w = 0. Below 0, or
// NaN: 0.
float computeRgbmAlpha(float alpha, float w)
{
    return containRadiance(w * (alpha - 1.0) + 1.0);
}

// In linear colour space: x * alpha^y * rgb. An alpha of 0 is black; at an exponent of 0 (below, or NaN: 0) alpha does
// not count. Channels in [0, 65504].
vec3 decodeRgbmLinear(vec4 encoded, vec4 decode)
{
    float alpha = computeRgbmAlpha(encoded.w, decode.w);
    float exponent = containRadiance(decode.y);
    float power = alpha > 0.0 ? pow(alpha, exponent) : 0.0;
    float factor = containRadiance(containRadiance(decode.x) * (exponent > 0.0 ? power : 1.0));
    return containRadiance(containRadiance(encoded.xyz) * factor);
}

// In gamma colour space: x * alpha * rgb.
vec3 decodeRgbmGamma(vec4 encoded, vec4 decode)
{
    float factor = containRadiance(containRadiance(decode.x) * computeRgbmAlpha(encoded.w, decode.w));
    return containRadiance(containRadiance(encoded.xyz) * factor);
}

#endif
