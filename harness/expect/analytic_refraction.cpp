// Refraction models as plane geometry: everything happens in the plane of incidence, spanned by the inward axis -N and
// the tangent T along which the light travels. A direction at the angle a from -N is cos(a) (-N) + sin(a) T. Source:
// Snell's law; the models of domain.md, section 5 (Unity HDRP refraction model documentation, 2018).
#include "harness/expect/analytic.h"

#include <algorithm>
#include <cmath>

namespace crossray {

namespace {

constexpr double kSmallestCosine = 1e-4; // of N and V; below, the normal is tilted
constexpr double kSmallestIndex = 0.001, kLargestIndex = 1000.0;
constexpr double kLargestThickness = 65504.0; // metres
constexpr double kThinThickness = 0.005;      // metres
constexpr double kLargestSlabPath = 100.0;    // thicknesses
constexpr double kNoDirection = 1e-15;        // a sine this small has no tangent

// The plane of incidence, with both angles as sine and cosine.
struct Incidence {
    HitReason status = HitReason::kNone;
    glm::dvec3 inwardWS{0.0};  // -N, N tilted where the eye is behind the surface
    glm::dvec3 tangentWS{0.0}; // unit; zero at normal incidence, where it does not matter
    double cosOutside = 1, sinOutside = 0;
    double cosInside = 1, sinInside = 0;

    glm::dvec3 direction(double cosine, double sine) const
    {
        return glm::normalize(cosine * inwardWS + sine * tangentWS);
    }
};

Incidence enterMaterial(const SurfacePoint& surface, double ior)
{
    Incidence plane;
    glm::dvec3 normal = surface.normalWS;
    const glm::dvec3& toEye = surface.toEyeWS;
    plane.cosOutside = glm::dot(normal, toEye);
    // The tangent part of the light's direction -V is N x (N x V), free of the cancellation of cos*N - V near the axis.
    glm::dvec3 along = glm::cross(normal, glm::cross(normal, toEye));
    plane.sinOutside = glm::length(along);
    if (!(plane.cosOutside >= kSmallestCosine)) {
        if (!(plane.sinOutside > kNoDirection)) {
            plane.status = HitReason::kDegenerateRay;
            return plane;
        }
        const glm::dvec3 side = glm::normalize(glm::cross(glm::cross(toEye, normal), toEye));
        plane.cosOutside = kSmallestCosine;
        plane.sinOutside = std::sqrt(1.0 - kSmallestCosine * kSmallestCosine);
        normal = plane.sinOutside * side + kSmallestCosine * toEye;
        along = plane.cosOutside * normal - toEye;
    }
    plane.inwardWS = -normal;
    if (plane.sinOutside > kNoDirection) plane.tangentWS = glm::normalize(along);
    if (!(ior > 0.0) || !std::isfinite(ior)) {
        plane.status = HitReason::kDegenerateInput;
        return plane;
    }
    plane.sinInside = plane.sinOutside / std::clamp(ior, kSmallestIndex, kLargestIndex);
    if (plane.sinInside > 1.0) {
        plane.status = HitReason::kNoRefractedRay;
        return plane;
    }
    plane.cosInside = std::sqrt((1.0 - plane.sinInside) * (1.0 + plane.sinInside));
    return plane;
}

double usableThickness(double thickness)
{
    return thickness > 0.0 ? std::min(thickness, kLargestThickness) : 0.0;
}

// What is left when nothing enters: the mirror image at total reflection, else straight on.
EffectRay stayOutside(const SurfacePoint& surface, const Incidence& plane)
{
    const glm::dvec3 dir = plane.status == HitReason::kNoRefractedRay
                               ? plane.direction(-plane.cosOutside, plane.sinOutside)
                               : -surface.toEyeWS;
    return {plane.status, surface.positionWS, dir, 0.0};
}

} // namespace

// Sphere of diameter t that touches P from inside. The way inside is a chord that makes the angle b (inside) with the
// diameter at P, so it is t cos(b) long. A chord is symmetric: the light turns by a - b towards the axis at the entry
// and by as much once more at the exit, so that it leaves at 2b - a from the axis (the first step of Descartes'
// rainbow). sin and cos of 2b - a by the addition theorems.
EffectRay refractThroughSphere(const SurfacePoint& surface, double ior, double thickness)
{
    const Incidence plane = enterMaterial(surface, ior);
    if (plane.status != HitReason::kNone) return stayOutside(surface, plane);
    const double chord = usableThickness(thickness) * plane.cosInside;
    const double cosTwice = (plane.cosInside - plane.sinInside) * (plane.cosInside + plane.sinInside);
    const double sinTwice = 2.0 * plane.sinInside * plane.cosInside;
    const double cosExit = cosTwice * plane.cosOutside + sinTwice * plane.sinOutside;
    const double sinExit = sinTwice * plane.cosOutside - cosTwice * plane.sinOutside;
    return {HitReason::kNone, surface.positionWS + chord * plane.direction(plane.cosInside, plane.sinInside),
            plane.direction(cosExit, sinExit), chord};
}

// Slab of thickness t. Both interfaces are parallel, so the light leaves as it came; while it sinks by t it moves t
// tan(b) along the tangent. Its path t / cos(b) is cut at 100 t: a slab in a scene is not endless.
EffectRay refractThroughBox(const SurfacePoint& surface, double ior, double thickness)
{
    const Incidence plane = enterMaterial(surface, ior);
    if (plane.status != HitReason::kNone) return stayOutside(surface, plane);
    const double slab = usableThickness(thickness);
    const double sunk = plane.cosInside * kLargestSlabPath > 1.0 ? slab : slab * kLargestSlabPath * plane.cosInside;
    const double path = plane.cosInside * kLargestSlabPath > 1.0 ? slab / plane.cosInside : slab * kLargestSlabPath;
    const glm::dvec3 exit = surface.positionWS + sunk * plane.inwardWS + path * plane.sinInside * plane.tangentWS;
    return {HitReason::kNone, exit, -surface.toEyeWS, path};
}

EffectRay refractThroughThin(const SurfacePoint& surface, double ior)
{
    return refractThroughBox(surface, ior, kThinThickness);
}

EffectRay passStraight(const SurfacePoint& surface)
{
    return {HitReason::kNone, surface.positionWS, -surface.toEyeWS, 0.0};
}

double thicknessAt(const Material& material, const SurfacePoint& surface)
{
    return surface.thickness.value_or(material.thickness * material.thicknessMultiplier);
}

EffectRay computeEffectRay(const Case& testCase, const SurfacePoint& surface)
{
    if (testCase.effect == TraceEffect::kReflection) return reflectAtSurface(surface);
    const Material& material = testCase.material;
    switch (material.refractionModel) {
    case RefractionModel::kSphere:
        return refractThroughSphere(surface, material.ior, thicknessAt(material, surface));
    case RefractionModel::kBox:
        return refractThroughBox(surface, material.ior, thicknessAt(material, surface));
    case RefractionModel::kThin:
        return refractThroughThin(surface, material.ior);
    case RefractionModel::kNone:
        break;
    }
    return passStraight(surface);
}

} // namespace crossray
