// Reflection probes as URP weighs, orders and mixes them: what its manual says (`doc`), what its code does (`unity`).
// Hooks: none. Source: Unity URP manual, reflection probes; the public behaviour of its shaders and of Forward+.
//
// Where they part: the size by which probes of equal importance are ordered (volume; squared diagonal, which overflows
// in half precision), whether size also decides which of two probes is the stronger at a pixel (no; yes), and what the
// sky gets (the remainder; the remainder only below a sum of 0.99). Weights are in [0,1]; a NaN counts as 0.
#ifndef CROSSRAY_PROBE_URP_GLSL
#define CROSSRAY_PROBE_URP_GLSL

#include "crossray/core/math.glsl"

const int kUrpDoc = 0;
const int kUrpUnity = 1;
const int kUrpUnityHalf = 2; // the code in half precision, as on mobiles

const float kUrpFull = 0.99;          // the code's sum of weights that leaves the sky nothing
const float kUrpSizeTolerance = 1e-4; // square metres: the code takes nearer diagonals for equal
const float kUrpUnlimitedSize = 1e30; // a size beyond the number format: all such are equal
const int kUrpNoProbe = -1;

struct UrpProbe {
    vec3 boxMinWS; // metres
    vec3 boxMaxWS;
    float blendDistance; // metres
    float importance;    // higher first
    float coveredArea;   // square metres of the surface inside the box: the manual's last rule
    int index;           // the order in the scene, the last tie-break
};

// The two probes of an object or a cluster: positions in the caller's list, or kUrpNoProbe.
struct UrpPair {
    int first;
    int second;
    UrpProbe firstProbe;
    UrpProbe secondProbe;
};

struct UrpWeights {
    float first;
    float second;
    float sky;
};

// One step of the Forward+ loop.
struct UrpStep {
    float weight; // this probe's
    float total;  // of all so far
    bool done;    // no further probe is asked
};

bool isUrpBox(UrpProbe probe)
{
    bool hasMin = isFinite(probe.boxMinWS);
    bool hasMax = isFinite(probe.boxMaxWS);
    return hasMin && hasMax;
}

// Weight of a probe at a point: 0 on a face and outside, linear over the blend distance, 1 deeper than it from every
// face; never 1 where it exceeds half the extent. A blend distance of 0 (below, NaN) has no ramp: 1 inside, 0 on the
// faces.
float computeUrpWeight(UrpProbe probe, vec3 positionWS)
{
    float depth = min(minComponent(positionWS - probe.boxMinWS), minComponent(probe.boxMaxWS - positionWS));
    bool isPoint = isFinite(positionWS);
    bool isBox = isUrpBox(probe);
    bool isInside = depth > 0.0;
    float ramp = saturate(safeDivide(depth, probe.blendDistance, 1.0));
    float weight = choose(probe.blendDistance > 0.0, ramp, 1.0);
    return choose(isPoint && isBox && isInside, weight, 0.0);
}

// What a profile takes for a probe's size: cubic metres, or the square metres of the diagonal, in half precision
// without limit beyond 65504, a diagonal of 255.9 m. A box with swapped ends has size 0, one that is not finite no
// limit.
float computeUrpSize(UrpProbe probe, int profile)
{
    vec3 side = max(probe.boxMaxWS - probe.boxMinWS, 0.0);
    float size = choose(profile == kUrpDoc, side.x * side.y * side.z, dot(side, side));
    bool isBox = isUrpBox(probe);
    bool fits = size <= choose(profile == kUrpUnityHalf, kFarAway, kUrpUnlimitedSize);
    return choose(isBox && fits, size, kUrpUnlimitedSize);
}

// True where a comes before b: more important; else smaller; else (manual) covering more of the surface; else by index.
bool urpProbeComesFirst(UrpProbe a, UrpProbe b, int profile)
{
    float sizeA = computeUrpSize(a, profile);
    float sizeB = computeUrpSize(b, profile);
    bool coversMore = a.coveredArea > b.coveredArea;
    bool coversLess = a.coveredArea < b.coveredArea;
    bool isCovered = profile == kUrpDoc && coversMore != coversLess;
    bool isBefore = a.index < b.index;
    bool byArea = isCovered ? coversMore : isBefore;
    bool isSmaller = sizeA < sizeB;
    bool bySize = sizeA == sizeB ? byArea : isSmaller;
    bool countsMore = a.importance > b.importance;
    bool countsLess = a.importance < b.importance;
    return countsMore != countsLess ? countsMore : bySize;
}

UrpPair makeUrpPair()
{
    UrpProbe none = UrpProbe(vec3(0.0), vec3(0.0), 0.0, 0.0, 0.0, 0);
    return UrpPair(kUrpNoProbe, kUrpNoProbe, none, none);
}

UrpProbe chooseUrpProbe(bool condition, UrpProbe yes, UrpProbe no)
{
    return UrpProbe(choose(condition, yes.boxMinWS, no.boxMinWS), choose(condition, yes.boxMaxWS, no.boxMaxWS),
                    choose(condition, yes.blendDistance, no.blendDistance),
                    choose(condition, yes.importance, no.importance),
                    choose(condition, yes.coveredArea, no.coveredArea), choose(condition, yes.index, no.index));
}

// Offers the probe at `position` of the caller's list (0 and up): the pair keeps the first two of all that were
// offered, in whatever order they come.
UrpPair offerUrpProbe(UrpPair pair, UrpProbe probe, int position, int profile)
{
    bool beatsFirst = urpProbeComesFirst(probe, pair.firstProbe, profile);
    bool beatsSecond = urpProbeComesFirst(probe, pair.secondProbe, profile);
    bool isFirst = pair.first == kUrpNoProbe || beatsFirst;
    bool isSecond = pair.second == kUrpNoProbe || beatsSecond;
    UrpProbe behind = chooseUrpProbe(isSecond, probe, pair.secondProbe);
    int behindPosition = choose(isSecond, position, pair.second);
    return UrpPair(choose(isFirst, position, pair.first), choose(isFirst, pair.first, behindPosition),
                   chooseUrpProbe(isFirst, probe, pair.firstProbe), chooseUrpProbe(isFirst, pair.firstProbe, behind));
}

// Which of two probes holds its whole weight against the other: 1 the first, -1 the second, 0 neither.
int computeUrpDominance(UrpProbe first, UrpProbe second, int profile)
{
    if (first.importance > second.importance) return 1;
    if (first.importance < second.importance) return -1;
    float difference = computeUrpSize(first, profile) - computeUrpSize(second, profile);
    bool bySize = profile != kUrpDoc && abs(difference) > kUrpSizeTolerance;
    return bySize ? (difference < 0.0 ? 1 : -1) : 0;
}

// What the sky gets under a sum of weights. The code gives it nothing from 0.99 on, and does not make up for what is
// missing.
float computeUrpSkyWeight(float total, int profile)
{
    float rest = 1.0 - saturate(total);
    return profile != kUrpDoc && total >= kUrpFull ? 0.0 : rest;
}

// Shares of two probes with those weights at the pixel, and of the sky. The dominant one takes its weight, the other
// what is left of its own; of equals each takes its weight, scaled down where the sum exceeds 1.
UrpWeights computeUrpShares(float firstWeight, float secondWeight, int dominance, int profile)
{
    float first = saturate(firstWeight);
    float second = saturate(secondWeight);
    if (dominance > 0) second = min(second, 1.0 - first);
    if (dominance < 0) first = min(first, 1.0 - second);
    float scale = max(first + second, 1.0);
    first = first / scale;
    second = second / scale;
    return UrpWeights(first, second, computeUrpSkyWeight(first + second, profile));
}

// Shares of a pair at a point; a place that holds no probe has none.
UrpWeights computeUrpPairShares(UrpPair pair, vec3 positionWS, int profile)
{
    float first = pair.first == kUrpNoProbe ? 0.0 : computeUrpWeight(pair.firstProbe, positionWS);
    float second = pair.second == kUrpNoProbe ? 0.0 : computeUrpWeight(pair.secondProbe, positionWS);
    int dominance = 0;
    if (first > 0.0 && second > 0.0) dominance = computeUrpDominance(pair.firstProbe, pair.secondProbe, profile);
    return computeUrpShares(first, second, dominance, profile);
}

// Forward+: the next probe in order takes its weight, at most what is left; the loop ends at a sum of 0.99. Then the
// sky takes computeUrpSkyWeight(total, kUrpUnity).
UrpStep stepUrpForwardPlus(float total, float probeWeight)
{
    float before = saturate(total);
    float asked = min(saturate(probeWeight), 1.0 - before);
    float weight = choose(before >= kUrpFull, 0.0, asked);
    float after = min(before + weight, 1.0);
    return UrpStep(weight, after, after >= kUrpFull);
}

#endif
