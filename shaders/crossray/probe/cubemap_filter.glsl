// A cubemap read through texel fetches alone: bilinear across the edges of faces, linear between mip levels. The same
// result on every device, in float and in double, where samplers differ by their fixed-point weights and their seams.
// Hooks: fetchProbeTexel(cubemap, face, texel, level) (linear radiance; the texel is inside the face),
// probeCubeSize(cubemap) (texels a side of level 0; level l has max(1, size >> l)), probeCubeLevelCount(cubemap).
// Source: seamless cube map filtering of the OpenGL and Vulkan specifications; at a corner, where three faces meet, the
// fourth texel is that of the nearer side instead of their mean.
//
// 8 fetches. A direction without direction reads the middle of face 0, a level beyond the chain its last one, NaN level
// 0. Texels below 0, NaN or infinite count as 0, above 65504 as 65504.
#ifndef CROSSRAY_PROBE_CUBEMAP_FILTER_GLSL
#define CROSSRAY_PROBE_CUBEMAP_FILTER_GLSL

#include "crossray/probe/cubemap.glsl"

vec3 fetchProbeTexel(int cubemap, int face, ivec2 texel, int level);
int probeCubeSize(int cubemap);
int probeCubeLevelCount(int cubemap);

float usableRadiance(float value)
{
    bool isPositive = value > 0.0;
    bool isNumber = isFinite(value);
    return choose(isPositive && isNumber, min(value, kFarAway), 0.0);
}

// The texel at column x, row y of a face of `size` texels a side; one beyond an edge is the neighbour's.
vec3 fetchFoldedTexel(int cubemap, int face, ivec2 texel, int level, int size)
{
    vec2 uv = (vec2(texel) + vec2(0.5)) / float(size);
    CubePosition position = foldCubePosition(face, uv);
    ivec2 inside = clamp(ivec2(floor(position.uv * float(size))), 0, size - 1);
    vec3 radiance = fetchProbeTexel(cubemap, position.face, inside, level);
    return vec3(usableRadiance(radiance.x), usableRadiance(radiance.y), usableRadiance(radiance.z));
}

// Radiance of a cubemap towards a direction of any length, at a mip level between 0 and the last.
vec3 sampleProbeCubemap(int cubemap, vec3 dir, float level)
{
    int last = max(probeCubeLevelCount(cubemap) - 1, 0);
    float used = min(choose(level > 0.0, level, 0.0), float(last));
    int finer = int(used);
    float coarseness = used - float(finer);
    CubePosition position = cubePositionFromDirection(dir);
    vec3 sum = vec3(0.0);
    for (int tap = 0; tap < 8; ++tap) {
        int tapLevel = min(finer + (tap >> 2), last);
        int size = max(probeCubeSize(cubemap) >> tapLevel, 1);
        vec2 corner = position.uv * float(size) - vec2(0.5);
        vec2 base = floor(corner);
        vec2 share = corner - base;
        ivec2 offset = ivec2(tap & 1, (tap >> 1) & 1);
        float weightX = choose(offset.x == 1, share.x, 1.0 - share.x);
        float weightY = choose(offset.y == 1, share.y, 1.0 - share.y);
        float weightLevel = choose(tap >= 4, coarseness, 1.0 - coarseness);
        vec3 radiance = fetchFoldedTexel(cubemap, position.face, ivec2(base) + offset, tapLevel, size);
        sum = sum + radiance * (weightX * weightY * weightLevel);
    }
    return sum;
}

#endif
