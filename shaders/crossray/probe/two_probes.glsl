// Two probes of one object, as the Built-in pipeline mixes them.
// Hooks: none. Source: Unity manual and shader listing: the first probe's weight travels in the w of its box's minimum.
//
// Each probe's texel is decoded with its own constants (rgbm.glsl) before it comes here; the listing decodes the second
// with the first's.
#ifndef CROSSRAY_PROBE_TWO_PROBES_GLSL
#define CROSSRAY_PROBE_TWO_PROBES_GLSL

#include "crossray/core/math.glsl"

const float kSingleProbeWeight = 0.99999;

// False where the first probe stands alone, so that the second need not be fetched; NaN counts as 1.
bool needsSecondProbe(float firstWeight)
{
    return firstWeight < kSingleProbeWeight;
}

struct TwoProbeWeights {
    float first;
    float second; // 0: not fetched
};

// Shares of the two, 1 in sum.
TwoProbeWeights computeTwoProbeWeights(float firstWeight)
{
    float first = choose(needsSecondProbe(firstWeight), saturate(firstWeight), 1.0);
    return TwoProbeWeights(first, 1.0 - first);
}

// Mixed colour. A probe that has no weight is left out, not multiplied by 0: a NaN in it does not spread. The second
// alone answers for weights of 0 and below.
vec3 blendTwoProbes(vec3 first, vec3 second, float firstWeight)
{
    if (!needsSecondProbe(firstWeight)) return first;
    if (firstWeight > 0.0) return mix(second, first, firstWeight);
    return second;
}

#endif
