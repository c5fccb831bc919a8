// How much a reflection probe counts at a surface point: its influence volume, box or sphere, with what fades it.
// Hooks: none. Source: Unity HDRP reflection probe documentation (2018): influence, blend and blend-normal volumes.
//
// Influence space has its origin at the volume's centre and is rotated, not scaled. Answers to the borders:
// - a blend distance below 1e-4 m, or NaN, counts as 1e-4 m: a step, 0.1 mm wide. For a box it lies inside the faces,
// for a
//   sphere outside its surface, as the formulas have it;
// - a blend distance beyond half the extent: the weight nowhere reaches 1;
// - negative and NaN extents, a position that is not finite, a shape that is neither box nor sphere: weight 0;
// - a point at the capture position, to 1e-4 m, or a normal without direction: nothing faces away, and the blend normal
//   is 1; nearer, the way between the two is rounding, and its direction noise;
// - a reflection direction without direction: the faces of a box give 0;
// - face fades and the weight are clamped to [0,1]; NaN counts as 0.
#ifndef CROSSRAY_PROBE_INFLUENCE_GLSL
#define CROSSRAY_PROBE_INFLUENCE_GLSL

#include "crossray/core/math.glsl"
#include "crossray/probe/shapes.glsl"

const float kSmallestBlend = 1e-4; // metres

struct ProbeInfluence {
    int shape;                // kProbeShapeBox or kProbeShapeSphere
    vec3 centerWS;            // metres
    mat3 worldFromInfluence;  // a rotation
    vec3 halfExtents;         // metres; a sphere's radius is x
    vec3 blendPositive;       // metres inwards from the faces at +x, +y, +z; a sphere's is x
    vec3 blendNegative;       // from those at -x, -y, -z
    vec3 blendNormalPositive; // metres inwards: beyond it the normal counts; a sphere's is x
    vec3 blendNormalNegative;
    vec3 facePositive; // [0,1]: how far reflections towards +x, +y, +z are let through; boxes alone
    vec3 faceNegative; // towards -x, -y, -z
    vec3 capturePositionWS;
    float weight; // [0,1]
};

// What a probe gets at a point, step by step: weight = S(volume * blendNormal * faceFade) * the probe's weight. All
// [0,1].
struct ProbeWeight {
    float volume;
    float blendNormal;
    float faceFade;
    float weight;
};

float usableBlend(float blend)
{
    return blend > kSmallestBlend ? min(blend, kFarAway) : kSmallestBlend;
}

vec3 usableBlend(vec3 blend)
{
    return vec3(usableBlend(blend.x), usableBlend(blend.y), usableBlend(blend.z));
}

// A length as it is used: NaN and below 0 are 0.
float usableLength(float metres)
{
    return metres > 0.0 ? min(metres, kFarAway) : 0.0;
}

vec3 usableLength(vec3 metres)
{
    return vec3(usableLength(metres.x), usableLength(metres.y), usableLength(metres.z));
}

// 1 inside, 0 from `radius` on (metres), linear over the outermost `blend` metres.
float computeSphereInfluence(vec3 positionIS, float radius, float blend)
{
    float beyond = max(length(positionIS) - (min(radius, kFarAway) - usableLength(blend)), 0.0);
    bool isSized = radius >= 0.0 && isFinite(positionIS);
    return isSized ? saturate(1.0 - beyond / usableBlend(blend)) : 0.0;
}

// 1 inside, 0 at the faces and beyond, linear over each face's own blend distance: the smallest of the six.
float computeBoxInfluence(vec3 positionIS, vec3 halfExtents, vec3 blendPositive, vec3 blendNegative)
{
    vec3 extents = usableLength(halfExtents);
    float positive = minComponent((extents - positionIS) / usableBlend(blendPositive));
    float negative = minComponent((extents + positionIS) / usableBlend(blendNegative));
    bool isSized = halfExtents.x >= 0.0 && halfExtents.y >= 0.0 && halfExtents.z >= 0.0 && isFinite(positionIS);
    return isSized ? saturate(min(positive, negative)) : 0.0;
}

// What is left of a probe whose surface point lies outside the blend-normal volume, by the cosine between the normal
// and the way from the capture position to the point: all up to 0.2, nothing from 0.6 on, where the surface faces away.
float computeBlendNormalFade(vec3 normalWS, vec3 fromCaptureWS)
{
    vec3 n = safeNormalize(normalWS, vec3(0.0));
    vec3 away = safeNormalize(fromCaptureWS, vec3(0.0));
    bool isAway = maxComponent(abs(fromCaptureWS)) > kSmallestBlend;
    return saturate(1.5 - 2.5 * choose(isAway, dot(n, away), 0.0));
}

// How much of a reflection a box's faces let through; dirIS is normalised here. 0 with all faces at 0, 1 with all at 1.
float computeFaceFade(vec3 dirIS, vec3 facePositive, vec3 faceNegative)
{
    vec3 d = safeNormalize(dirIS, vec3(0.0));
    vec3 sum = saturate((d * 4.0 - vec3(1.0)) * saturate(facePositive)) +
               saturate((d * -4.0 - vec3(1.0)) * saturate(faceNegative));
    return saturate(sum.x + sum.y + sum.z);
}

// True inside the blend-normal volume, its surface included; there the normal does not matter.
bool isInsideBlendNormal(ProbeInfluence probe, vec3 positionIS)
{
    if (probe.shape == kProbeShapeSphere) {
        return length(positionIS) <= probe.halfExtents.x - usableLength(probe.blendNormalPositive.x);
    }
    vec3 positive = probe.halfExtents - positionIS - usableLength(probe.blendNormalPositive);
    vec3 negative = probe.halfExtents + positionIS - usableLength(probe.blendNormalNegative);
    return minComponent(positive) >= 0.0 && minComponent(negative) >= 0.0;
}

// Share of the probe at a surface point with that normal, for a reflection in that direction (both of any length).
ProbeWeight computeProbeWeight(ProbeInfluence probe, vec3 positionWS, vec3 normalWS, vec3 reflectionDirWS)
{
    vec3 positionIS = (positionWS - probe.centerWS) * probe.worldFromInfluence; // v * M: by the transpose
    bool isSphere = probe.shape == kProbeShapeSphere;
    bool isBox = probe.shape == kProbeShapeBox;
    float volume = 0.0;
    if (isSphere) volume = computeSphereInfluence(positionIS, probe.halfExtents.x, probe.blendPositive.x);
    if (isBox) {
        volume = computeBoxInfluence(positionIS, probe.halfExtents, probe.blendPositive, probe.blendNegative);
    }
    bool inside = isInsideBlendNormal(probe, positionIS);
    float blendNormal = inside ? 1.0 : computeBlendNormalFade(normalWS, positionWS - probe.capturePositionWS);
    vec3 dirIS = safeNormalize(reflectionDirWS, vec3(0.0)) * probe.worldFromInfluence;
    float faceFade = isBox ? computeFaceFade(dirIS, probe.facePositive, probe.faceNegative) : 1.0;
    float alpha = volume * blendNormal * faceFade;
    return ProbeWeight(volume, blendNormal, faceFade, smoothRamp(alpha) * saturate(probe.weight));
}

// One channel of a probe's colour as it may be used: not negative, at most 65504; NaN and infinity are 0.
float usableProbeColor(float value)
{
    return value > 0.0 && isFinite(value) ? min(value, kFarAway) : 0.0;
}

// A probe's colour times its multiplier (>= 0; NaN counts as 0).
vec3 multiplyProbeColor(vec3 color, float multiplier)
{
    float factor = usableLength(multiplier);
    return vec3(usableProbeColor(usableProbeColor(color.x) * factor),
                usableProbeColor(usableProbeColor(color.y) * factor),
                usableProbeColor(usableProbeColor(color.z) * factor));
}

#endif
