// Parameters of planar probes, beside those that they share with other probes (probe_params.glsl), as C++ and GLSL both see them.
// Only vec4 and ivec4 members, so that std140 and the C++ struct have the same layout without padding.
#ifndef CROSSRAY_SHARED_PLANAR_PARAMS_GLSL
#define CROSSRAY_SHARED_PLANAR_PARAMS_GLSL

#define CROSSRAY_MAX_PLANAR_PROBES 8

struct PlanarItem {
    vec4 pointWS;  // xyz: of the mirror plane, metres
    vec4 normalWS; // xyz: the side from which the mirror is seen, any length
    vec4 field;    // full vertical field of view in radians, width over height, 1: this field of view and not the camera's own
    ivec4 image;   // first row in the atlas, width, height, 1: between the four nearest pixels
};

struct PlanarParams {
    ivec4 settings; // planar probes in use, and where in ProbeParams.items the first of them stands
    PlanarItem items[CROSSRAY_MAX_PLANAR_PROBES]; // in the order in which they are asked
};

#endif
