// How the tiers of a hierarchy share a pixel: the first that answer take what they can, the sky takes the rest.
// Hooks: none. Source: Unity HDRP reflection documentation (2018), reflection and refraction hierarchies.
#ifndef CROSSRAY_HIERARCHY_WEIGHTS_GLSL
#define CROSSRAY_HIERARCHY_WEIGHTS_GLSL

#include "crossray/core/math.glsl"

struct TierWeight {
    float hierarchyWeight; // sum of all tiers so far, [0,1]
    float weight;          // what this tier got, [0,1]
};

// Adds a tier that asks for `weight` to tiers that hold `hierarchyWeight`: it gets that, less what would exceed 1.
// Values outside [0,1] are clamped; NaN counts as 0.
TierWeight addTier(float hierarchyWeight, float weight)
{
    float before = saturate(hierarchyWeight);
    float got = min(saturate(weight), 1.0 - before);
    return TierWeight(min(before + got, 1.0), got);
}

// The last tier: all that is left.
TierWeight addSky(float hierarchyWeight)
{
    return addTier(hierarchyWeight, 1.0);
}

#endif
