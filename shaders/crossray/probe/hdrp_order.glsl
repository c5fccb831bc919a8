// The order in which HDRP's hierarchy asks reflection probes: the smaller first, importance plays no part.
// Hooks: none. Source: Unity HDRP (2018): light list sorting by the logarithm of the influence's volume, in 20 bits.
#ifndef CROSSRAY_PROBE_HDRP_ORDER_GLSL
#define CROSSRAY_PROBE_HDRP_ORDER_GLSL

#include "crossray/core/math.glsl"

const int kLargestProbeKey = 1048575;          // 20 bits
const float kProbeKeySteps = 20495.9343142878; // 1000 / ln(1.05)

// Sort key in [0, 2^20 - 1] of an influence with these half extents (metres): volume V in cubic metres of the box
// around it (a sphere's: all three its radius), as 1000 log(1 + V) to the base 1.05, truncated. Volumes within about
// 5e-5 share a key. Extents below 0 count as 0; NaN and infinity give the largest key.
int computeHdrpProbeKey(vec3 halfExtents)
{
    vec3 side = max(halfExtents, 0.0) * 2.0;
    float volume = side.x * side.y * side.z;
    float steps = log(1.0 + (isFinite(volume) ? volume : 0.0)) * kProbeKeySteps;
    bool isKey = isFinite(halfExtents) && isFinite(volume) && steps < float(kLargestProbeKey);
    return isKey ? int(steps) : kLargestProbeKey;
}

// True where the first probe is asked before the second: by key, and by index where the keys are equal.
bool hdrpProbeComesFirst(int keyA, int indexA, int keyB, int indexB)
{
    return keyA == keyB ? indexA < indexB : keyA < keyB;
}

#endif
