// What a refracting surface lets through: Beer-Lambert's law of absorption, set by a colour and the distance at which
// white light has it, and Fresnel's share of reflection (domain, sections 1 and 5). Fresnel in the form of sines and
// tangents of the two angles (Fresnel 1823), which shares no step with the cosines' form.
#include "harness/expect/analytic.h"

#include <algorithm>
#include <cmath>

namespace crossray {

namespace {

constexpr double kSmallestTransmittance = 1e-4;
constexpr double kSmallestDistance = 1e-5; // metres
constexpr double kLongestPath = 65504.0;   // metres
constexpr double kSmallestCosine = 1e-4;
constexpr double kSmallestIndex = 0.001, kLargestIndex = 1000.0;
constexpr double kNormalIncidence = 1e-7; // radians, below which only the limit is left

struct Angles {
    double outside = 0, inside = 0; // radians
    bool totallyReflected = false;
};

Angles refractAngles(const SurfacePoint& surface, double index)
{
    double cosine = glm::dot(surface.normalWS, surface.toEyeWS);
    double sine = glm::length(glm::cross(surface.normalWS, surface.toEyeWS));
    if (!(cosine >= kSmallestCosine)) {
        cosine = kSmallestCosine;
        sine = std::sqrt(1.0 - kSmallestCosine * kSmallestCosine);
    }
    Angles angles;
    angles.outside = std::atan2(sine, cosine);
    const double sineInside = sine / index;
    angles.totallyReflected = sineInside >= 1.0;
    if (!angles.totallyReflected) {
        angles.inside = std::atan2(sineInside, std::sqrt((1.0 - sineInside) * (1.0 + sineInside)));
    }
    return angles;
}

} // namespace

// A colour T after the distance d is T twice over after 2 d: T to the power of path / d.
glm::dvec3 transmittanceAfter(const Material& material, double pathLength)
{
    const double distance = std::max(material.absorptionDistance, kSmallestDistance);
    const double distances = std::clamp(pathLength, 0.0, kLongestPath) / distance;
    glm::dvec3 left(1.0);
    for (int channel = 0; channel < 3; ++channel) {
        const double color = std::clamp(material.transmittanceColor[channel], kSmallestTransmittance, 1.0);
        left[channel] = std::pow(color, distances);
    }
    return left;
}

double reflectedShare(const Material& material, const SurfacePoint& surface)
{
    if (material.fresnel == FresnelModel::kNone) return 0.0;
    if (!(material.ior > 0.0) || !std::isfinite(material.ior)) return 1.0;
    const double index = std::clamp(material.ior, kSmallestIndex, kLargestIndex);
    const Angles angles = refractAngles(surface, index);
    if (angles.totallyReflected) return 1.0;
    const double atNormal = std::pow((index - 1.0) / (index + 1.0), 2.0);
    if (material.fresnel == FresnelModel::kSchlick) {
        const double cosine = std::cos(index < 1.0 ? angles.inside : angles.outside);
        return atNormal + (1.0 - atNormal) * std::pow(1.0 - cosine, 5.0);
    }
    if (angles.outside < kNormalIncidence) return atNormal;
    const double difference = angles.outside - angles.inside, sum = angles.outside + angles.inside;
    const double across = std::sin(difference) / std::sin(sum);
    const double along = std::tan(difference) / std::tan(sum);
    return 0.5 * (across * across + along * along);
}

} // namespace crossray
