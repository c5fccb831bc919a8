// The tier of reflection probes: which of them count at a surface, in which order, and what they show. They stand in the block in
// the order in which they are asked, so that no pixel sorts. Hooks: fetchProbeAtlas, and the block probeParams.
#ifndef PASS_PROBE_TIER_GLSL
#define PASS_PROBE_TIER_GLSL

#include "crossray/hierarchy/weights.glsl"
#include "crossray/probe/cubemap_filter.glsl"
#include "crossray/probe/influence.glsl"
#include "crossray/probe/parallax.glsl"
#include "crossray/probe/roughness.glsl"
#include "crossray/shared/probe_params.glsl"
#include "pass/pixel_surface.glsl"

// All cubemaps lie in one image: level below level, in each the six faces beside one another.
int probeCubeSize(int cubemap) { return probeParams.cubemaps[cubemap].y; }
int probeCubeLevelCount(int cubemap) { return probeParams.cubemaps[cubemap].z; }
vec3 fetchProbeTexel(int cubemap, int face, ivec2 texel, int level)
{
    ivec4 place = probeParams.cubemaps[cubemap];
    int size = max(place.y >> level, 1);
    return fetchProbeAtlas(ivec2(face * size + texel.x, place.x + 2 * (place.y - size) + texel.y));
}

ProbeInfluence loadProbeInfluence(int index)
{
    return ProbeInfluence(
        probeParams.items[index].kind.x, probeParams.items[index].influenceCenterWS.xyz,
        mat3(probeParams.items[index].worldFromInfluence), probeParams.items[index].influenceExtents.xyz,
        probeParams.items[index].blendPositive.xyz, probeParams.items[index].blendNegative.xyz,
        probeParams.items[index].blendNormalPositive.xyz, probeParams.items[index].blendNormalNegative.xyz,
        probeParams.items[index].facePositive.xyz, probeParams.items[index].faceNegative.xyz,
        probeParams.items[index].capturePositionWS.xyz, probeParams.items[index].influenceCenterWS.w);
}

ProbeProxy loadProbeProxy(int index)
{
    return ProbeProxy(probeParams.items[index].kind.y, probeParams.items[index].proxyCenterWS.xyz,
                      mat3(probeParams.items[index].worldFromProxy), probeParams.items[index].proxyExtents.xyz,
                      probeParams.items[index].proxyCenterWS.w);
}

// What one probe shows to a ray.
struct ProbeView {
    vec3 color; // linear radiance, multiplied
    vec3 dirWS; // in which its cubemap is read
    float mipLevel;
};

ProbeView readProbe(int index, vec3 originWS, vec3 dirWS, float roughness)
{
    ParallaxRay seen =
        computeParallax(originWS, dirWS, loadProbeProxy(index), probeParams.items[index].capturePositionWS.xyz);
    float sharper = computeDistanceBasedRoughness(roughness, seen.distance, seen.distanceFromCapture);
    float used = choose(probeParams.items[index].kind.w == 1, sharper, saturate(roughness));
    float mipLevel = computeProbeMip(used, probeCubeLevelCount(index));
    vec3 color = sampleProbeCubemap(index, seen.dirWS, mipLevel);
    return ProbeView(multiplyProbeColor(color, probeParams.items[index].influenceExtents.w), seen.dirWS, mipLevel);
}

// What the first four probes of a case got, of which this one, by its place in the case, got a weight.
vec4 weightOfProbe(int number, float weight)
{
    return vec4(choose(number == 0, weight, 0.0), choose(number == 1, weight, 0.0), choose(number == 2, weight, 0.0),
                choose(number == 3, weight, 0.0));
}

struct ProbeTier {
    float hierarchyWeight; // of all tiers up to here
    float weight;          // of all probes
    vec3 color;            // what they show, each times its weight
    vec4 weights;          // what the first four probes of the case got
    vec3 firstDirWS;       // in which the first that got something is read; 0 without one
    float firstMipLevel;
};

// Asks the probes one after another until the hierarchy is full. A surface counts by its own position, also where the ray leaves
// its solid elsewhere; what a probe shows is looked up along the ray.
ProbeTier askProbes(PixelSurface surface, vec3 originWS, vec3 dirWS, float hierarchyWeight)
{
    float roughness = params.material.z;
    vec3 lookUpDirWS = dirWS;
    if (kEffect != kEffectRefraction) {
        lookUpDirWS = computeDominantDirection(surface.normalWS, dirWS, surface.viewDirWS, roughness,
                                               probeParams.settings.y);
    }
    ProbeTier tier = ProbeTier(hierarchyWeight, 0.0, vec3(0.0), vec4(0.0), vec3(0.0), 0.0);
    int count = min(probeParams.settings.x, CROSSRAY_MAX_PROBES);
    for (int index = 0; index < count; ++index) {
        float asked =
            computeProbeWeight(loadProbeInfluence(index), surface.positionWS, surface.normalWS, dirWS).weight;
        TierWeight added = addTier(tier.hierarchyWeight, asked);
        if (added.weight > 0.0) {
            ProbeView seen = readProbe(index, originWS, lookUpDirWS, roughness);
            bool isFirst = !(tier.weight > 0.0);
            vec4 got = weightOfProbe(probeParams.items[index].kind.z, added.weight);
            tier = ProbeTier(added.hierarchyWeight, tier.weight + added.weight,
                             tier.color + seen.color * added.weight, tier.weights + got,
                             choose(isFirst, seen.dirWS, tier.firstDirWS),
                             choose(isFirst, seen.mipLevel, tier.firstMipLevel));
        }
    }
    return tier;
}

#endif
