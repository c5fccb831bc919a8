// Cubemaps without a cubemap sampler: from a direction to a face and its coordinates and back, and across edges.
// Hooks: none. Source: the cube map tables of the OpenGL and Vulkan specifications (faces +x, -x, +y, -y, +z, -z; the
// image's row 0 at v = 0).
#ifndef CROSSRAY_PROBE_CUBEMAP_GLSL
#define CROSSRAY_PROBE_CUBEMAP_GLSL

#include "crossray/core/math.glsl"

struct CubePosition {
    int face;   // 0 to 5
    vec2 uv;    // [0,1], v down
    bool valid; // false: no direction; face 0, uv in its middle
};

// Where a direction of any length points to. Of equal components z wins over y, and y over x, as Vulkan has it.
CubePosition cubePositionFromDirection(vec3 dir)
{
    vec3 d = safeNormalize(dir, vec3(1.0, 0.0, 0.0));
    vec3 size = abs(d);
    bool beatsX = size.z >= size.x;
    bool beatsY = size.z >= size.y;
    bool isZ = beatsX && beatsY;
    bool isY = size.y >= size.x; // where it is not z
    float major = choose(isZ, d.z, choose(isY, d.y, d.x));
    float side = choose(major > 0.0, 1.0, -1.0);
    vec2 onX = vec2(-side * d.z, -d.y);
    vec2 onY = vec2(d.x, side * d.z);
    vec2 onZ = vec2(side * d.x, -d.y);
    vec2 st = choose(isZ, onZ, choose(isY, onY, onX));
    int face = choose(isZ, 4, choose(isY, 2, 0)) + choose(major > 0.0, 0, 1);
    return CubePosition(face, saturate((st / abs(major) + vec2(1.0)) * 0.5), hasDirection(dir));
}

// The point of the unit cube (components up to 1) at s to the right, t down, on the plane of that face pushed to
// `major`. Faces outside 0 to 5 count as the nearest.
vec3 cubePoint(int face, float s, float t, float major)
{
    int known = clamp(face, 0, 5);
    float side = choose((known & 1) == 0, 1.0, -1.0);
    vec3 onX = vec3(side * major, -t, -side * s);
    vec3 onY = vec3(s, side * major, side * t);
    vec3 onZ = vec3(side * s, -t, side * major);
    return choose(known >= 4, onZ, choose(known >= 2, onY, onX));
}

// Unit direction of a face's point; uv beyond [0,1] stays on the face's plane.
vec3 directionFromCubePosition(int face, vec2 uv)
{
    vec2 st = uv * 2.0 - vec2(1.0);
    return safeNormalize(cubePoint(face, st.x, st.y, 1.0), cubePoint(face, 0.0, 0.0, 1.0));
}

// The position that a point beyond a face's edge has on the neighbour, folded over the edge: texel centres fall on
// texel centres, so that a filter's footprint stays whole. Beyond a corner no third face waits: the nearer side's
// excess is dropped. An excess of more than a face folds as one face; NaN counts as the middle.
CubePosition foldCubePosition(int face, vec2 uv)
{
    bool isUsable = isFinite(uv);
    vec2 st = choose(isUsable, uv * 2.0 - vec2(1.0), vec2(0.0));
    vec2 excess = clamp(abs(st) - vec2(1.0), 0.0, 2.0);
    bool isBeyondX = excess.x > 0.0;
    bool isBeyondY = excess.y > 0.0;
    bool isWider = excess.x >= excess.y;
    bool overSide = isBeyondX && isWider;
    bool overEnd = isBeyondY && !overSide;
    vec2 inside = clamp(st, -1.0, 1.0);
    float major = 1.0 - choose(overSide, excess.x, choose(overEnd, excess.y, 0.0));
    vec3 point = cubePoint(face, inside.x, inside.y, major);
    // The neighbour is the face that the crossed edge belongs to besides this one.
    vec3 edge = cubePoint(face, choose(overSide, inside.x, 0.0), choose(overEnd, inside.y, 0.0), 0.0);
    int neighbour = cubePositionFromDirection(edge).face;
    vec3 right = cubePoint(neighbour, 1.0, 0.0, 0.0);
    vec3 down = cubePoint(neighbour, 0.0, 1.0, 0.0);
    vec2 folded = vec2(dot(point, right), dot(point, down));
    bool isFolded = overSide || overEnd;
    vec2 result = choose(isFolded, folded, inside);
    return CubePosition(choose(isFolded, neighbour, clamp(face, 0, 5)), saturate((result + vec2(1.0)) * 0.5), isUsable);
}

#endif
