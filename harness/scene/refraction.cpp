#include "harness/scene/refraction.h"

#include <cassert>
#include <cmath>

namespace crossray {

glm::dvec3 reflectDirection(const glm::dvec3& dirWS, const glm::dvec3& normalWS)
{
    return glm::normalize(dirWS - (2.0 * glm::dot(dirWS, normalWS)) * normalWS);
}

std::optional<glm::dvec3> refractDirection(const glm::dvec3& dirWS, const glm::dvec3& normalWS, double indexRatio)
{
    const double cosine = -glm::dot(dirWS, normalWS);
    const glm::dvec3 along = dirWS + cosine * normalWS; // the part within the interface, as long as the angle's sine
    // 1 - (ratio * sine)^2, written so that near grazing, where the sine is nearly 1, nothing cancels.
    const double squared = (1.0 - indexRatio) * (1.0 + indexRatio) + (indexRatio * cosine) * (indexRatio * cosine);
    if (squared < 0.0) return std::nullopt;
    return glm::normalize(indexRatio * along - std::sqrt(squared) * normalWS);
}

std::optional<RefractedPath> refractThrough(const Primitive& solid, const glm::dvec3& entryWS,
                                            const glm::dvec3& normalWS, const glm::dvec3& dirWS)
{
    assert(solid.shape != PrimitiveShape::kPlane);
    const std::optional<glm::dvec3> inside = refractDirection(dirWS, normalWS, 1.0 / solid.ior);
    if (!inside) return std::nullopt;
    RefractedPath path;
    path.entryWS = entryWS;
    path.insideDirWS = *inside;
    path.exitWS = entryWS;
    glm::dvec3 exitNormal = normalWS;
    const auto hits = intersectPrimitive(solid, {entryWS, *inside});
    // Grazing with an index near 1 the way inside has no length, and rounding may lose it.
    if (!hits.empty() && hits.back().backFace && hits.back().distance > 0.0) {
        path.exitWS = hits.back().positionWS;
        path.length = hits.back().distance;
        exitNormal = hits.back().normalWS;
    } else if (glm::dot(*inside, exitNormal) < 0.0) {
        exitNormal = -exitNormal;
    }
    const std::optional<glm::dvec3> outside = refractDirection(*inside, -exitNormal, solid.ior);
    if (!outside) return std::nullopt;
    path.exitDirWS = *outside;
    return path;
}

} // namespace crossray
