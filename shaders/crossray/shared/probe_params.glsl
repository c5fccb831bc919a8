// Parameters of reflection probes and of the sky behind them, as C++ and GLSL both see them. Only vec4, ivec4 and mat4
// members, so that std140 and the C++ struct have the same layout without padding.
#ifndef CROSSRAY_SHARED_PROBE_PARAMS_GLSL
#define CROSSRAY_SHARED_PROBE_PARAMS_GLSL

#define CROSSRAY_MAX_PROBES 8

struct ProbeItem {
    mat4 worldFromInfluence; // rotation only
    mat4 worldFromProxy;     // rotation only
    ivec4 kind; // influence shape, proxy shape (probe/shapes.glsl), index in the case, 1: distance-based roughness
    vec4 influenceCenterWS;   // xyz: metres; w: the probe's weight
    vec4 influenceExtents;    // xyz: half extents, a sphere's radius is x; metres; w: multiplier of the colour
    vec4 blendPositive;       // xyz: metres
    vec4 blendNegative;       // xyz: metres
    vec4 blendNormalPositive; // xyz: metres
    vec4 blendNormalNegative; // xyz: metres
    vec4 facePositive;        // xyz: [0,1]
    vec4 faceNegative;        // xyz: [0,1]
    vec4 proxyCenterWS;       // xyz: metres; w: smallest projection distance, metres
    vec4 proxyExtents;        // xyz: half extents, a sphere's radius is x; metres
    vec4 capturePositionWS;   // xyz: metres
    vec4 boxMinWS; // of the Built-in and the URP profile, as all below. xyz: metres; w: blend distance, metres
    vec4 boxMaxWS; // xyz: metres; w: importance
    vec4 lookUp;   // covered area of the object (square metres), 1: box projection, 1: RGBM texels, their alpha
    vec4 decode;   // of RGBM texels: range, exponent, unused, weight of the alpha
};

struct ProbeParams {
    ivec4 settings;   // standard probes in use, form of the dominant direction (probe/roughness.glsl), unused, unused
    vec4 skyZenith;   // xyz: linear radiance
    vec4 skyHorizon;  // xyz: linear radiance
    vec4 skyNadir;    // xyz: linear radiance
    vec4 skyUpWS;     // xyz: direction
    vec4 objectMinWS; // xyz: bounds of what traces, metres
    vec4 objectMaxWS; // xyz: metres
    ivec4 cubemaps[CROSSRAY_MAX_PROBES + 1]; // first row in the atlas, size, levels, unused; the sky's is the last
    ProbeItem items[CROSSRAY_MAX_PROBES];    // in the order in which they are asked, planar ones last
};

#endif
