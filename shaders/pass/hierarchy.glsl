// The hierarchy of a reflection or a refraction: the screen, the probes, the sky; each takes what it asks for of what is left.
// Hooks: those of pass/probe_tier.glsl.
#ifndef PASS_HIERARCHY_GLSL
#define PASS_HIERARCHY_GLSL

#include "crossray/hierarchy/weights.glsl"
#include "crossray/probe/sky.glsl"
#include "pass/output_slots.glsl"
#include "pass/planar_tier.glsl"
#include "pass/pixel_color.glsl"
#include "pass/probe_profiles.glsl"
#include "pass/probe_tier.glsl"

// The bits of kHierarchy.
const int kTierScreen = 1;
const int kTierProbes = 2;
const int kTierSky = 4;

// Values of kSkyModel.
const int kSkyNone = 0;
const int kSkyCubemap = 2;

struct HierarchyAnswer {
    vec3 color;         // of all tiers, each times its weight
    vec4 tierWeights;   // screen, standard probes, planar probes, sky
    vec4 probeWeights;  // what the first four probes of the case got
    vec3 probeDirWS;    // in which the first probe that got something is read
    float probeMipLevel;
    PlanarLookup planar; // of the first planar probe that reaches the pixel
};

HierarchyAnswer answerNothing()
{
    return HierarchyAnswer(vec3(0.0), vec4(0.0), vec4(0.0), vec3(0.0), 0.0,
                           PlanarLookup(vec2(0.0), 0.0, kPlanarNotAsked));
}

bool wantsHierarchy()
{
    bool wantsWeights = wantsOutput(kOutputTierWeights) || wantsOutput(kOutputProbeWeights);
    bool wantsLookUp = wantsOutput(kOutputProbeDirWS) || wantsOutput(kOutputProbeMipLevel);
    bool wantsPlanar = wantsOutput(kOutputPlanarUV) || wantsOutput(kOutputPlanarStatus);
    return kHierarchy != 0 && (wantsOutput(kOutputColor) || wantsWeights || wantsLookUp || wantsPlanar);
}

// The sky is read along the ray itself: it is nowhere, so nothing shifts it.
vec3 readSky(vec3 dirWS)
{
    if (kSkyModel == kSkyCubemap) {
        int levels = probeCubeLevelCount(CROSSRAY_MAX_PROBES);
        float mipLevel = kProbeProfile == kProfileHdrp ? computeProbeMip(params.material.z, levels)
                                                       : computeProfileMip(params.material.z, levels);
        return sampleProbeCubemap(CROSSRAY_MAX_PROBES, dirWS, mipLevel);
    }
    return evaluateGradientSky(GradientSky(probeParams.skyZenith.xyz, probeParams.skyHorizon.xyz,
                                           probeParams.skyNadir.xyz, probeParams.skyUpWS.xyz, 1.0),
                               dirWS);
}

// Of a pixel that has a ray. The screen's colour counts with the screen's weight, which is 0 without a hit.
HierarchyAnswer askTiers(View view, PixelSurface surface, PixelAnswer answer, ScreenColor screen)
{
    HierarchyAnswer result = answerNothing();
    float full = 0.0;
    if ((kHierarchy & kTierScreen) != 0) {
        TierWeight added = addTier(full, screen.weight);
        result = HierarchyAnswer(screen.color * added.weight, vec4(added.weight, 0.0, 0.0, 0.0), vec4(0.0), vec3(0.0), 0.0,
                                 result.planar);
        full = added.hierarchyWeight;
    }
    if ((kHierarchy & kTierProbes) != 0 && kPlanarTier == 1) {
        PlanarTier tier = askPlanarProbes(view, surface, answer.rayOriginWS, answer.rayDirWS, full);
        result = HierarchyAnswer(result.color + tier.color, result.tierWeights + vec4(0.0, 0.0, tier.weight, 0.0),
                                 tier.weights, vec3(0.0), 0.0, tier.first);
        full = tier.hierarchyWeight;
    }
    if ((kHierarchy & kTierProbes) != 0) {
        ProbeTier tier = kProbeProfile == kProfileHdrp
                             ? askProbes(surface, answer.rayOriginWS, answer.rayDirWS, full)
                             : askProfileProbes(surface, answer.rayOriginWS, answer.rayDirWS, full);
        result = HierarchyAnswer(result.color + tier.color, result.tierWeights + vec4(0.0, tier.weight, 0.0, 0.0),
                                 result.probeWeights + tier.weights, tier.firstDirWS, tier.firstMipLevel,
                                 result.planar);
        full = tier.hierarchyWeight;
    }
    if ((kHierarchy & kTierSky) != 0 && kSkyModel != kSkyNone) {
        TierWeight added = addSky(full);
        result = HierarchyAnswer(result.color + readSky(answer.rayDirWS) * added.weight,
                                 result.tierWeights + vec4(0.0, 0.0, 0.0, added.weight), result.probeWeights,
                                 result.probeDirWS, result.probeMipLevel, result.planar);
    }
    return result;
}

#endif
