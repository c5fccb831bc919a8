// Parameters of the harness's passes, as C++ and GLSL both see them. Only vec4, ivec4 and mat4 members, so that std140
// and the C++ struct have the same layout without padding.
#ifndef CROSSRAY_SHARED_PASS_PARAMS_GLSL
#define CROSSRAY_SHARED_PASS_PARAMS_GLSL

#define CROSSRAY_MAX_PYRAMID_LEVELS 16

struct PassParams {
    mat4 viewFromWorld;
    mat4 worldFromView;
    mat4 clipFromView;
    mat4 worldFromProxy; // rotation only
    mat4 previousViewFromWorld;
    vec4 imageSizeAndSlope; // xy: pixels; zw: View.slope
    vec4 depthTerms;        // View.depthA, View.depthB, near and far distance in metres
    vec4 material;          // index of refraction, thickness in metres, perceptual roughness, thickness multiplier
    vec4 absorption;        // xyz: transmittance colour; w: distance at which white light has it, metres
    vec4 history;           // xy: slope of the previous view, z: levels of the colour pyramid, w: unused
    vec4 proxyCenterWS;     // xyz: metres
    vec4 proxyExtents;      // xyz: half extents of the box, w: radius of the sphere; metres
    vec4 tracing;           // depth bias in metres, screen weight distance in UV, unused, unused
    vec4 linearTracing;     // stride in pixels, depth bias in metres, unused, unused
    ivec4 hizLimits;        // min level, max level, max iterations, levels in the pyramid
    ivec4 linearLimits;     // steps, max iterations, bisections, unused
    vec4 patches;           // caution, error of affine depth, unused, unused
    ivec4 record;           // pixel (x, y) that is recorded, steps that its record holds, unused
    ivec4 pyramidLevels[CROSSRAY_MAX_PYRAMID_LEVELS]; // first cell's index, width, height, unused
};

// Parameters of one reduction of the depth pyramid, or of the colour pyramid.
struct PyramidParams {
    vec4 depthTerms;   // as in PassParams
    ivec4 sourceLevel; // first cell's index, width, height, level number; unused for target level 0
    ivec4 targetLevel; // first cell's index, width, height, level number; level 0 reads the image
    ivec4 imageSize;   // width, height, unused, unused
};

// Parameters of one pass over the pyramid of planes.
struct SurfaceParams {
    mat4 viewFromWorld;
    vec4 imageSizeAndSlope; // as in PassParams
    vec4 depthTerms;
    vec4 patches;
    ivec4 range;                               // first and last level that it builds, unused, unused
    ivec4 levels[CROSSRAY_MAX_PYRAMID_LEVELS]; // as PassParams.pyramidLevels
};

#endif
