// A cubemap read through texel fetches alone: bilinear across the edges of faces, linear between mip levels. The same
// result on every device, in float and in double, where samplers differ by their fixed-point weights and their seams.
// Hooks: fetchProbeTexel(cubemap, face, texel, level) (linear radiance; the texel is inside the face),
// probeCubeSize(cubemap) (texels a side of level 0; level l has max(1, size >> l)), probeCubeLevelCount(cubemap).
// Source: seamless cube map filtering of the OpenGL and Vulkan specifications; at a corner, where three faces meet, the
// fourth texel is the mean of the three, so that the edges stay without seams there too.
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

// Along one axis of a footprint of two texels, the first at `base`: what the one beyond the face's edge weighs; 0 where
// both are on the face.
float weightBeyondEdge(float base, float share, int size)
{
    float second = choose(base + 1.0 >= float(size), share, 0.0);
    return choose(base < 0.0, 1.0 - share, second);
}

// What the texel at `offset` (0 or 1 each) of the footprint at `base` weighs. The texel beyond a corner does not exist:
// it leaves a third of its weight to each of the others.
float computeTapWeight(vec2 base, vec2 share, ivec2 offset, int size)
{
    float weightX = choose(offset.x == 1, share.x, 1.0 - share.x);
    float weightY = choose(offset.y == 1, share.y, 1.0 - share.y);
    float missing = weightBeyondEdge(base.x, share.x, size) * weightBeyondEdge(base.y, share.y, size);
    vec2 texel = base + vec2(offset);
    vec2 middle = vec2(0.5 * float(size - 1));
    vec2 beyond = abs(texel - middle) - middle; // above 0 beyond an edge
    bool isMissing = min(beyond.x, beyond.y) > 0.0;
    return choose(isMissing, 0.0, weightX * weightY + missing / 3.0);
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
        float weight = computeTapWeight(base, share, offset, size);
        float weightLevel = choose(tap >= 4, coarseness, 1.0 - coarseness);
        vec3 radiance = fetchFoldedTexel(cubemap, position.face, ivec2(base) + offset, tapLevel, size);
        sum = sum + radiance * (weight * weightLevel);
    }
    return sum;
}

#endif
