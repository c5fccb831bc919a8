// Where a ray that enters a transparent object leaves it, for three guesses at the object behind the surface: a sphere,
// a slab
// ("box"), a thin slab. Air outside, one material inside.
// Hooks: none. Source: Unity HDRP refraction model documentation (2018): the sphere and plane models; Snell's law.
//
// Inputs of all models: the surface point (metres), its normal, the direction towards the eye, the index of refraction
// of the inside relative to the outside, the thickness in metres. What they do with inputs that are out of bounds:
// - the normal and the view direction are normalised; one without direction gives status kHitReasonDegenerateRay;
// - a normal that faces away from the eye (normal maps) is tilted, in the plane of the two, until its cosine with the
// view
//   direction is kGrazingCosine; one opposite to the view direction has no such plane: kHitReasonDegenerateRay;
// - an index that is not above 0, or NaN: kHitReasonDegenerateInput; otherwise it is taken into [0.001, 1000];
// - a thickness below 0 or NaN counts as 0, one above 65504 as 65504;
// - total reflection at the entry (index below 1): kHitReasonNoRefractedRay, and the direction is the reflected one;
// - a surface point that is not finite: kHitReasonDegenerateRay, and the exit is at the origin.
// With any status but kHitReasonNone the exit is the surface point with path length 0 and, unless said above, the ray
// goes straight through. Directions are always unit vectors (the zero vector where no view direction is given), all
// numbers finite.
#ifndef CROSSRAY_REFRACT_REFRACTION_GLSL
#define CROSSRAY_REFRACT_REFRACTION_GLSL

#include "crossray/core/math.glsl"
#include "crossray/shared/outputs.glsl"

const float kThinThickness = 0.005; // metres; part of the model, nothing overrides it
const float kGrazingCosine = 1e-4;  // 89.994 degrees
// Sine of the angle to the opposite of the view direction below which a normal has no side to be tilted to: roundings.
const float kSmallestTilt = 1e-5;
// A slab is no endless one: its path is at most 1/this times its thickness. Reached only by indices near 1 beyond 89.4
// degrees.
const float kSlabSmallestCosine = 0.01;

struct RefractionExit {
    vec3 positionWS;
    vec3 dirWS;       // unit
    float pathLength; // metres inside
    int status;       // kHitReasonNone, or why there is no refracted ray
};

// A ray just inside the surface, with the cosines that the models need.
struct RefractionEntry {
    vec3 normalWS;       // unit, on the eye's side
    vec3 viewDirWS;      // unit
    vec3 dirWS;          // unit, inside
    float cosineOutside; // normal . view direction
    float cosineInside;  // -normal . dirWS
    float indexOfRefraction;
    float thickness; // metres
    int status;
};

RefractionEntry enterRefractor(vec3 normalWS, vec3 viewDirWS, float indexOfRefraction, float thickness)
{
    vec3 v = safeNormalize(viewDirWS, vec3(0.0));
    vec3 n = safeNormalize(normalWS, vec3(0.0));
    float t = thickness > 0.0 ? min(thickness, kFarAway) : 0.0;
    bool hasIndex = indexOfRefraction > 0.0 && indexOfRefraction < 1e30;
    float index = hasIndex ? clamp(indexOfRefraction, 0.001, 1000.0) : 1.0;

    float cosine = dot(n, v);
    if (cosine < kGrazingCosine) {
        vec3 sideways = n - v * cosine;
        bool tilted = dot(sideways, sideways) > kSmallestTilt * kSmallestTilt && dot(v, v) > 0.5;
        vec3 side = safeNormalize(sideways, vec3(0.0));
        n = side * sqrt(1.0 - kGrazingCosine * kGrazingCosine) + v * kGrazingCosine;
        if (!tilted) return RefractionEntry(n, v, -v, 1.0, 1.0, index, t, kHitReasonDegenerateRay);
        cosine = kGrazingCosine;
    }
    if (!hasIndex) return RefractionEntry(n, v, -v, 1.0, 1.0, index, t, kHitReasonDegenerateInput);

    cosine = min(cosine, 1.0);
    float eta = 1.0 / index;
    // 1 - eta^2 (1 - cosine^2), grouped so that an index of 1 gives back the cosine at grazing angles.
    float cosineSquared = (1.0 - eta) * (1.0 + eta) + eta * eta * cosine * cosine;
    if (cosineSquared < 0.0) {
        vec3 reflectedWS = safeNormalize(n * (2.0 * cosine) - v, -v);
        return RefractionEntry(n, v, reflectedWS, cosine, cosine, index, t, kHitReasonNoRefractedRay);
    }
    float cosineInside = sqrt(cosineSquared);
    vec3 dirWS = safeNormalize(n * (eta * cosine - cosineInside) - v * eta, -v);
    return RefractionEntry(n, v, dirWS, cosine, cosineInside, index, t, kHitReasonNone);
}

// The exit after `pathLength` metres inside; with a status, or from a point that is not finite, the ray does not enter.
RefractionExit makeRefractionExit(vec3 positionWS, RefractionEntry entry, float pathLength, vec3 exitDirWS)
{
    bool isPlaced = isFinite(positionWS);
    vec3 origin = isPlaced ? positionWS : vec3(0.0);
    int status = isPlaced ? entry.status : kHitReasonDegenerateRay;
    if (status != kHitReasonNone) return RefractionExit(origin, entry.dirWS, 0.0, status);
    return RefractionExit(origin + entry.dirWS * pathLength, exitDirWS, pathLength, kHitReasonNone);
}

// The object is a sphere of diameter `thickness` that touches the surface from inside: centre P - N*t/2. Exact for a
// real sphere of that diameter. Inside a sphere both ends of the path see the same cosines, so that the exit needs no
// second root and never reflects totally: with c the inner cosine, the path is c*t and the normal at the exit, inwards,
// is -N - 2c*R. At thickness 0 the position stays and the direction is that of the sphere's limit.
RefractionExit computeRefractionSphere(vec3 positionWS, vec3 normalWS, vec3 viewDirWS, float indexOfRefraction,
                                       float thickness)
{
    RefractionEntry entry = enterRefractor(normalWS, viewDirWS, indexOfRefraction, thickness);
    float pathLength = entry.cosineInside * entry.thickness;
    vec3 exitNormalWS = -entry.normalWS - entry.dirWS * (2.0 * entry.cosineInside);
    vec3 exitDirWS = entry.dirWS * entry.indexOfRefraction +
                     exitNormalWS * (entry.indexOfRefraction * entry.cosineInside - entry.cosineOutside);
    return makeRefractionExit(positionWS, entry, pathLength, safeNormalize(exitDirWS, -entry.viewDirWS));
}

// The object is a slab of that thickness with parallel faces: the ray leaves in the direction in which it came,
// shifted. Exact for a real slab. The path is thickness / inner cosine, and at most 100 thicknesses.
RefractionExit computeRefractionBox(vec3 positionWS, vec3 normalWS, vec3 viewDirWS, float indexOfRefraction,
                                    float thickness)
{
    RefractionEntry entry = enterRefractor(normalWS, viewDirWS, indexOfRefraction, thickness);
    float pathLength = entry.thickness / max(entry.cosineInside, kSlabSmallestCosine);
    return makeRefractionExit(positionWS, entry, pathLength, -entry.viewDirWS);
}

// A slab of 5 mm, whatever thickness the material has: panes, bubbles.
RefractionExit computeRefractionThin(vec3 positionWS, vec3 normalWS, vec3 viewDirWS, float indexOfRefraction)
{
    return computeRefractionBox(positionWS, normalWS, viewDirWS, indexOfRefraction, kThinThickness);
}

// No refraction: straight through, with no path inside. A view direction without direction: kHitReasonDegenerateRay.
RefractionExit computeRefractionNone(vec3 positionWS, vec3 viewDirWS)
{
    vec3 v = safeNormalize(viewDirWS, vec3(0.0));
    int status = hasDirection(viewDirWS) ? kHitReasonNone : kHitReasonDegenerateRay;
    return makeRefractionExit(positionWS, RefractionEntry(v, v, -v, 1.0, 1.0, 1.0, 0.0, status), 0.0, -v);
}

// By model number (kRefraction...); an unknown number is None.
RefractionExit computeRefraction(int model, vec3 positionWS, vec3 normalWS, vec3 viewDirWS, float indexOfRefraction,
                                 float thickness)
{
    if (model == kRefractionSphere) {
        return computeRefractionSphere(positionWS, normalWS, viewDirWS, indexOfRefraction, thickness);
    }
    if (model == kRefractionBox) {
        return computeRefractionBox(positionWS, normalWS, viewDirWS, indexOfRefraction, thickness);
    }
    if (model == kRefractionThin) return computeRefractionThin(positionWS, normalWS, viewDirWS, indexOfRefraction);
    return computeRefractionNone(positionWS, viewDirWS);
}

#endif
