#include "harness/expect/analytic.h"

#include <algorithm>

namespace crossray {

// Law of reflection (Heron): the reflected light seems to come from the eye's mirror image. One metre back along the
// view stands E = P + V; its image in the plane through P with normal N is E - 2 (N.(E - P)) N; the ray runs from there
// to P. A surface that is seen from behind (normal maps) is taken as the grazing one, in which the eye is its own
// image: straight on.
EffectRay reflectAtSurface(const SurfacePoint& surface)
{
    if (surface.normalWS == glm::dvec3(0.0)) {
        return {HitReason::kDegenerateRay, surface.positionWS, glm::dvec3(0.0), 0.0};
    }
    const glm::dvec3 eye = surface.positionWS + surface.toEyeWS;
    const double height = std::max(glm::dot(surface.normalWS, surface.toEyeWS), 0.0);
    const glm::dvec3 image = eye - 2.0 * height * surface.normalWS;
    return {HitReason::kNone, surface.positionWS, glm::normalize(surface.positionWS - image), 0.0};
}

} // namespace crossray
