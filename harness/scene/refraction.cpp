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

namespace {

// Metres by which a ray has to go on before it meets a torus again, as a share of its radius.
constexpr double kApart = 1e-9;
// Times that a ray may enter one torus; each one turns it away from the ring, and three are rare.
constexpr int kMostEntries = 16;

// Where a ray from a point of the solid's surface leaves it. Grazing with an index near 1 the way inside has no length,
// and rounding may lose it: nothing.
std::optional<SurfaceHit> findExit(const Primitive& solid, const Ray& inside)
{
    const bool isConvex = solid.shape != PrimitiveShape::kTorus;
    const double least = isConvex ? 0.0 : kApart * solid.radius;
    const auto hits = intersectPrimitive(solid, inside);
    if (isConvex) {
        if (!hits.empty() && hits.back().backFace && hits.back().distance > least) return hits.back();
        return std::nullopt;
    }
    for (const SurfaceHit& hit : hits) {
        if (hit.backFace && hit.distance > least) return hit;
    }
    return std::nullopt;
}

// Once in and once out.
std::optional<RefractedPath> refractOnce(const Primitive& solid, const glm::dvec3& entryWS, const glm::dvec3& normalWS,
                                         const glm::dvec3& dirWS)
{
    const std::optional<glm::dvec3> inside = refractDirection(dirWS, normalWS, 1.0 / solid.ior);
    if (!inside) return std::nullopt;
    RefractedPath path{entryWS, *inside, entryWS, glm::dvec3(0.0), 0.0};
    glm::dvec3 exitNormal = normalWS;
    if (const auto exit = findExit(solid, {entryWS, *inside})) {
        path.exitWS = exit->positionWS;
        path.length = exit->distance;
        exitNormal = exit->normalWS;
    } else if (glm::dot(*inside, exitNormal) < 0.0) {
        exitNormal = -exitNormal;
    }
    const std::optional<glm::dvec3> outside = refractDirection(*inside, -exitNormal, solid.ior);
    if (!outside) return std::nullopt;
    path.exitDirWS = *outside;
    return path;
}

// In through the wall, over the air inside, and out through the wall: four interfaces. A ray that does not meet the
// inner sphere stays in the glass.
std::optional<RefractedPath> refractThroughBubble(const Primitive& bubble, const glm::dvec3& entryWS,
                                                  const glm::dvec3& normalWS, const glm::dvec3& dirWS)
{
    const std::optional<glm::dvec3> inWall = refractDirection(dirWS, normalWS, 1.0 / bubble.ior);
    if (!inWall) return std::nullopt;
    Primitive air = bubble;
    air.radius = bubble.radius - bubble.wall;
    const auto inner = intersectPrimitive(air, {entryWS, *inWall});
    if (inner.empty() || !(inner.front().distance > 0.0)) return refractOnce(bubble, entryWS, normalWS, dirWS);
    // Air inside glass: the same two interfaces with the inverse index.
    air.ior = 1.0 / bubble.ior;
    const auto across = refractOnce(air, inner.front().positionWS, inner.front().normalWS, *inWall);
    if (!across) return std::nullopt;
    const auto outer = findExit(bubble, {across->exitWS, across->exitDirWS});
    if (!outer) return std::nullopt;
    const auto outside = refractDirection(across->exitDirWS, -outer->normalWS, bubble.ior);
    if (!outside) return std::nullopt;
    return RefractedPath{entryWS, *inWall, outer->positionWS, *outside, inner.front().distance + outer->distance};
}

// Where a ray that has just left a torus meets it again.
std::optional<SurfaceHit> findNextEntry(const Primitive& torus, const Ray& outside)
{
    for (const SurfaceHit& hit : intersectPrimitive(torus, outside)) {
        if (!hit.backFace && hit.distance > kApart * torus.radius) return hit;
    }
    return std::nullopt;
}

} // namespace

std::optional<RefractedPath> refractThrough(const Primitive& solid, const glm::dvec3& entryWS,
                                            const glm::dvec3& normalWS, const glm::dvec3& dirWS)
{
    assert(solid.shape != PrimitiveShape::kPlane);
    if (solid.shape == PrimitiveShape::kSphere && solid.wall > 0.0)
        return refractThroughBubble(solid, entryWS, normalWS, dirWS);
    std::optional<RefractedPath> path = refractOnce(solid, entryWS, normalWS, dirWS);
    if (solid.shape != PrimitiveShape::kTorus) return path;
    for (int entry = 1; path && entry < kMostEntries; ++entry) {
        const auto again = findNextEntry(solid, {path->exitWS, path->exitDirWS});
        if (!again) return path;
        const auto next = refractOnce(solid, again->positionWS, again->normalWS, path->exitDirWS);
        if (!next) return std::nullopt;
        path->exitWS = next->exitWS;
        path->exitDirWS = next->exitDirWS;
        path->length += next->length;
    }
    return std::nullopt;
}

} // namespace crossray
