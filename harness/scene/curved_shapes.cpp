#include "harness/scene/curved_shapes.h"

#include <algorithm>
#include <cmath>

namespace crossray {

namespace {

// Signed distance along the axis from the lens' middle to the centre of the sphere that its face is part of.
double faceCenter(const Primitive& lens, int face)
{
    const double away = lens.radius - 0.5 * lens.thickness;
    return face == 0 ? -away : away;
}

// Crossings of a sphere whose centre is at `fromCenter` from the ray's origin. The half-chord comes from the distance
// to the centre, so that far spheres stay exact.
bool crossSphereAt(const glm::dvec3& fromCenter, const glm::dvec3& dir, double radius, double& enters, double& leaves)
{
    const double along = glm::dot(fromCenter, dir);
    const glm::dvec3 nearest = fromCenter - along * dir;
    const double squared = radius * radius - glm::dot(nearest, nearest);
    if (!(squared >= 0.0)) return false;
    const double halfChord = std::sqrt(squared);
    enters = -along - halfChord;
    leaves = -along + halfChord;
    return true;
}

// The place between `low` and `high` where `isPositive` changes, to neighbouring doubles.
template <typename IsPositive>
double findChange(double low, double high, const IsPositive& isPositive)
{
    const bool atLow = isPositive(low);
    while (true) {
        const double middle = low + 0.5 * (high - low);
        if (!(middle > low && middle < high)) return middle;
        (isPositive(middle) == atLow ? low : high) = middle;
    }
}

// A torus and a ray in the torus' own frame, the ray's origin at its nearest point to the middle.
struct TorusRay {
    double ringRadius, tubeRadius;
    glm::dvec3 origin, dir;

    // Above 0 outside. Its sign is that of the quartic, whose other factor is above 0 everywhere.
    bool isOutside(double t) const
    {
        const glm::dvec3 p = origin + t * dir;
        const double fromRing = std::hypot(p.x, p.y) - ringRadius;
        return fromRing * fromRing + p.z * p.z > tubeRadius * tubeRadius;
    }
};

} // namespace

CurvedCrossings crossLens(const Primitive& lens, const Ray& ray)
{
    CurvedCrossings found;
    double enters = -kNoLimit, leaves = kNoLimit;
    for (const int face : {0, 1}) {
        const glm::dvec3 center = lens.center + faceCenter(lens, face) * lens.worldFromLocal[2];
        double first = 0, last = 0;
        if (!crossSphereAt(ray.originWS - center, ray.dirWS, lens.radius, first, last)) return {};
        if (first > enters) {
            enters = first;
            found.face[0] = face;
        }
        if (last < leaves) {
            leaves = last;
            found.face[1] = face;
        }
    }
    if (enters > leaves) return {};
    found.count = 2;
    found.distance[0] = enters;
    found.distance[1] = leaves;
    return found;
}

CurvedCrossings crossTorus(const Primitive& torus, const Ray& ray)
{
    const glm::dmat3 localFromWorld = glm::transpose(torus.worldFromLocal);
    const glm::dvec3 start = localFromWorld * (ray.originWS - torus.center);
    TorusRay local{torus.radius, torus.tubeRadius, start, localFromWorld * ray.dirWS};
    const double shift = -glm::dot(start, local.dir);
    local.origin = start + shift * local.dir;
    const double reach = torus.radius + torus.tubeRadius;
    const double squared = reach * reach - glm::dot(local.origin, local.origin);
    if (!(squared > 0.0)) return {};
    const double end = std::sqrt(squared) * (1 + 1e-9) + 1e-9 * reach; // both ends are outside

    // t^4 + c2 t^2 + c1 t + c0; its slope 4 t^3 + 2 c2 t + c1 turns where 12 t^2 + 2 c2 is 0. c0 is not needed.
    const glm::dvec3& o = local.origin;
    const glm::dvec3& d = local.dir;
    const double ring = torus.radius * torus.radius;
    const double c2 =
        2 * (glm::dot(o, o) + ring - torus.tubeRadius * torus.tubeRadius) - 4 * ring * (d.x * d.x + d.y * d.y);
    const double c1 = -8 * ring * (o.x * d.x + o.y * d.y);
    const auto rises = [&](double t) { return (4 * t * t + 2 * c2) * t + c1 > 0.0; };
    const double bend = c2 < 0.0 ? std::min(std::sqrt(-c2 / 6), end) : 0.0;
    const std::array<double, 4> bends{-end, -bend, bend, end};
    std::array<double, 5> turns{-end, end, end, end, end};
    size_t count = 1;
    for (size_t i = 0; i + 1 < bends.size(); ++i) {
        if (rises(bends[i]) != rises(bends[i + 1])) turns[count++] = findChange(bends[i], bends[i + 1], rises);
    }
    turns[count] = end;

    CurvedCrossings found;
    for (size_t i = 0; i < count; ++i) {
        const auto isOutside = [&](double t) { return local.isOutside(t); };
        if (isOutside(turns[i]) == isOutside(turns[i + 1])) continue;
        found.distance[static_cast<size_t>(found.count++)] = shift + findChange(turns[i], turns[i + 1], isOutside);
    }
    return found;
}

glm::dvec3 lensNormal(const Primitive& lens, const glm::dvec3& positionWS, int face)
{
    return glm::normalize(positionWS - lens.center - faceCenter(lens, face) * lens.worldFromLocal[2]);
}

glm::dvec3 torusNormal(const Primitive& torus, const glm::dvec3& positionWS)
{
    const glm::dvec3 fromCenter = positionWS - torus.center;
    const double height = glm::dot(fromCenter, torus.worldFromLocal[2]);
    const glm::dvec3 outwards =
        fromCenter - height * torus.worldFromLocal[2]; // never 0: the ring is wider than the tube
    return glm::normalize(fromCenter - torus.radius * glm::normalize(outwards));
}

double lensRimRadius(const Primitive& lens)
{
    const double half = 0.5 * lens.thickness;
    return std::sqrt(half * (2 * lens.radius - half));
}

} // namespace crossray
