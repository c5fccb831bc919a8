// The tier of reflection probes as the Built-in pipeline and URP have it: which probes an object or a pixel uses, what each of
// them gets, and how it is read. The probes stand in the block in the order of the case; these pipelines' own order is found here.
// Hooks: those of pass/probe_tier.glsl.
#ifndef PASS_PROBE_PROFILES_GLSL
#define PASS_PROBE_PROFILES_GLSL

#include "crossray/probe/box_projection.glsl"
#include "crossray/probe/rgbm.glsl"
#include "crossray/probe/two_probes.glsl"
#include "crossray/probe/urp.glsl"
#include "pass/probe_tier.glsl"

// Values of kProbeProfile.
const int kProfileHdrp = 0;
const int kProfileBuiltIn = 1;
const int kProfileUrpUnity = 3;

// Bits of kProfileSwitches.
const int kSwitchBlending = 1;
const int kSwitchBoxProjection = 2;
const int kSwitchForwardPlus = 4;
const int kSwitchHalfPrecision = 8;
const int kSwitchExactMip = 16;
const int kSwitchGammaSpace = 32;
const int kSwitchSelectFace = 64;

bool hasSwitch(int bit) { return (kProfileSwitches & bit) != 0; }
bool asksEveryProbe() { return hasSwitch(kSwitchForwardPlus) && hasSwitch(kSwitchBlending); }

// Whose rules order and share: the Built-in pipeline's are the manual's.
int rulesOfProfile()
{
    int unity = hasSwitch(kSwitchHalfPrecision) ? kUrpUnityHalf : kUrpUnity;
    return kProbeProfile == kProfileUrpUnity ? unity : kUrpDoc;
}

UrpProbe loadUrpProbe(int index)
{
    vec4 boxMin = probeParams.items[index].boxMinWS;
    vec4 boxMax = probeParams.items[index].boxMaxWS;
    return UrpProbe(boxMin.xyz, boxMax.xyz, boxMin.w, boxMax.w, probeParams.items[index].lookUp.x, index);
}

// True where a probe is among those that the object may use: Built-in, where it reaches the middle of the object's bounds; URP, where
// it touches them.
bool isOfObject(UrpProbe probe)
{
    vec3 low = probeParams.objectMinWS.xyz;
    vec3 high = probeParams.objectMaxWS.xyz;
    bool reaches = computeUrpWeight(probe, low + (high - low) * 0.5) > 0.0;
    float gap = max(maxComponent(probe.boxMinWS - high), maxComponent(low - probe.boxMaxWS));
    bool touches = gap <= 0.0;
    return kProbeProfile == kProfileBuiltIn ? reaches : touches;
}

UrpPair chooseObjectPair(int count)
{
    UrpPair pair = makeUrpPair();
    for (int index = 0; index < count; ++index) {
        UrpProbe probe = loadUrpProbe(index);
        UrpPair offered = offerUrpProbe(pair, probe, index, rulesOfProfile());
        bool isOffered = isOfObject(probe);
        pair = UrpPair(choose(isOffered, offered.first, pair.first), choose(isOffered, offered.second, pair.second),
                       chooseUrpProbe(isOffered, offered.firstProbe, pair.firstProbe),
                       chooseUrpProbe(isOffered, offered.secondProbe, pair.secondProbe));
    }
    return pair;
}

// Built-in: two probes share all in the ratio of what they ask for at the middle of the object; a single one shares with the sky.
UrpWeights computeObjectShares(UrpPair pair)
{
    vec3 low = probeParams.objectMinWS.xyz;
    vec3 centerWS = low + (probeParams.objectMaxWS.xyz - low) * 0.5;
    UrpWeights asked = computeUrpPairShares(pair, centerWS, kUrpDoc);
    bool isPair = pair.second != kUrpNoProbe;
    float total = asked.first + asked.second;
    TwoProbeWeights shares = computeTwoProbeWeights(choose(isPair, safeDivide(asked.first, total, 1.0), asked.first));
    return UrpWeights(shares.first, choose(isPair, shares.second, 0.0), choose(isPair, 0.0, shares.second));
}

UrpWeights computePairShares(UrpPair pair, vec3 positionWS)
{
    if (pair.first == kUrpNoProbe) return UrpWeights(0.0, 0.0, 1.0);
    if (!hasSwitch(kSwitchBlending)) return UrpWeights(1.0, 0.0, 0.0);
    if (kProbeProfile == kProfileBuiltIn) return computeObjectShares(pair);
    return computeUrpPairShares(pair, positionWS, rulesOfProfile());
}

// Forward+: what the probes before this one ask for counts, whatever the order in which it is added up.
float computeForwardPlusShare(UrpProbe probe, int count, vec3 positionWS)
{
    float total = 0.0;
    for (int other = 0; other < count; ++other) {
        UrpProbe before = loadUrpProbe(other);
        bool isBefore = urpProbeComesFirst(before, probe, rulesOfProfile());
        total = total + choose(isBefore, computeUrpWeight(before, positionWS), 0.0);
    }
    return stepUrpForwardPlus(total, computeUrpWeight(probe, positionWS)).weight;
}

float computeProfileMip(float roughness, int levels)
{
    float mipLevel = hasSwitch(kSwitchExactMip) ? computeBuiltInMipExact(roughness) : computeBuiltInMip(roughness);
    return min(mipLevel, float(max(levels - 1, 0)));
}

vec3 computeProfileDirection(int index, vec3 originWS, vec3 dirWS)
{
    if (!hasSwitch(kSwitchBoxProjection)) return dirWS;
    ProbeBox box = ProbeBox(probeParams.items[index].boxMinWS.xyz, probeParams.items[index].boxMaxWS.xyz,
                            vec4(probeParams.items[index].capturePositionWS.xyz, probeParams.items[index].lookUp.y));
    if (hasSwitch(kSwitchSelectFace)) return computeBoxProjectionSelect(originWS, dirWS, box).dirWS;
    return computeBoxProjectionDivision(originWS, dirWS, box).dirWS;
}

// With the probe's own constants, whichever of the two it is.
vec3 decodeProbeTexel(int index, vec3 texel)
{
    vec4 encoded = vec4(texel, probeParams.items[index].lookUp.w);
    vec4 decode = probeParams.items[index].decode;
    vec3 decoded = hasSwitch(kSwitchGammaSpace) ? decodeRgbmGamma(encoded, decode) : decodeRgbmLinear(encoded, decode);
    return choose(probeParams.items[index].lookUp.z > 0.0, decoded, texel);
}

ProbeView readProfileProbe(int index, vec3 originWS, vec3 dirWS)
{
    vec3 seenDirWS = computeProfileDirection(index, originWS, dirWS);
    float mipLevel = computeProfileMip(params.material.z, probeCubeLevelCount(index));
    vec3 texel = sampleProbeCubemap(index, seenDirWS, mipLevel);
    vec3 color = multiplyProbeColor(decodeProbeTexel(index, texel), probeParams.items[index].influenceExtents.w);
    return ProbeView(color, seenDirWS, mipLevel);
}

// Asks the probes for what the tiers before have left. A probe without a share is not read.
ProbeTier askProfileProbes(PixelSurface surface, vec3 originWS, vec3 dirWS, float hierarchyWeight)
{
    int count = min(probeParams.settings.x, CROSSRAY_MAX_PROBES);
    float left = 1.0 - saturate(hierarchyWeight);
    UrpPair pair = makeUrpPair();
    UrpWeights shares = UrpWeights(0.0, 0.0, 1.0);
    if (!asksEveryProbe()) {
        pair = chooseObjectPair(count);
        shares = computePairShares(pair, surface.positionWS);
    }
    float total = shares.first + shares.second;
    ProbeTier tier = ProbeTier(hierarchyWeight, 0.0, vec3(0.0), vec4(0.0), vec3(0.0), 0.0);
    for (int index = 0; index < count; ++index) {
        float share = choose(index == pair.first, shares.first, choose(index == pair.second, shares.second, 0.0));
        if (asksEveryProbe()) {
            share = computeForwardPlusShare(loadUrpProbe(index), count, surface.positionWS);
            total = min(total + share, 1.0);
        }
        float got = share * left;
        if (got > 0.0) {
            ProbeView seen = readProfileProbe(index, originWS, dirWS);
            bool isFirst = !(tier.weight > 0.0);
            vec4 one = vec4(choose(index == 0, got, 0.0), choose(index == 1, got, 0.0), choose(index == 2, got, 0.0),
                            choose(index == 3, got, 0.0));
            tier = ProbeTier(hierarchyWeight, tier.weight + got, tier.color + seen.color * got, tier.weights + one,
                             choose(isFirst, seen.dirWS, tier.firstDirWS),
                             choose(isFirst, seen.mipLevel, tier.firstMipLevel));
        }
    }
    // The code leaves the sky nothing from 0.99 on.
    bool isFull = computeUrpSkyWeight(total, rulesOfProfile()) <= 0.0;
    float taken = choose(isFull, 1.0, saturate(hierarchyWeight + left * total));
    return ProbeTier(taken, tier.weight, tier.color, tier.weights, tier.firstDirWS, tier.firstMipLevel);
}

#endif
