#include "harness/scene/scene.h"

#include "harness/base/error.h"
#include "harness/scene/curved_shapes.h"

#include <fmt/format.h>

#include <cmath>

namespace crossray {

namespace {

// One crossing of a ray and a primitive, before position and normal are worked out. Plain numbers and inlined visitors:
// this is the inner loop of every image.
struct Crossing {
    double distance = 0;
    int face = 0; // box: 2 * axis, + 1 for the face on the axis' positive side; lens: that of CurvedCrossings
};

// The half-chord comes from the ray's distance to the centre: no difference of large squares, so far spheres stay
// exact.
template <typename Visit>
void crossSphere(const Primitive& sphere, const Ray& ray, const Visit& visit)
{
    const glm::dvec3 fromCenter = ray.originWS - sphere.center;
    const double along = glm::dot(fromCenter, ray.dirWS);
    const glm::dvec3 nearest = fromCenter - along * ray.dirWS;
    const double squared = sphere.radius * sphere.radius - glm::dot(nearest, nearest);
    if (!(squared >= 0.0)) return;
    const double halfChord = std::sqrt(squared);
    visit(Crossing{-along - halfChord, 0});
    visit(Crossing{-along + halfChord, 0});
}

template <typename Visit>
void crossPlane(const Primitive& plane, const Ray& ray, const Visit& visit)
{
    const glm::dvec3 fromCenter = ray.originWS - plane.center;
    const double height = glm::dot(plane.worldFromLocal[2], fromCenter);
    const double descent = glm::dot(plane.worldFromLocal[2], ray.dirWS);
    if (descent == 0.0) return;
    const double distance = -height / descent;
    const glm::dvec3 hit = fromCenter + distance * ray.dirWS;
    if (std::abs(glm::dot(plane.worldFromLocal[0], hit)) <= plane.halfExtents.x &&
        std::abs(glm::dot(plane.worldFromLocal[1], hit)) <= plane.halfExtents.y)
        visit(Crossing{distance, 0});
}

template <typename Visit>
void crossBox(const Primitive& box, const Ray& ray, const Visit& visit)
{
    const glm::dvec3 fromCenter = ray.originWS - box.center;
    Crossing entry{-kNoLimit, 0};
    Crossing exit{kNoLimit, 0};
    for (int axis = 0; axis < 3; ++axis) {
        const double origin = glm::dot(box.worldFromLocal[axis], fromCenter);
        const double dir = glm::dot(box.worldFromLocal[axis], ray.dirWS);
        const double half = box.halfExtents[axis];
        if (dir == 0.0) { // parallel to the slab: inside it for ever, or never
            if (std::abs(origin) > half) return;
            continue;
        }
        const double towards = std::copysign(half, dir);
        const double enters = (-towards - origin) / dir;
        const double leaves = (towards - origin) / dir;
        const int ahead = dir > 0.0 ? 1 : 0;
        if (enters > entry.distance) entry = {enters, 2 * axis + 1 - ahead};
        if (leaves < exit.distance) exit = {leaves, 2 * axis + ahead};
        if (entry.distance > exit.distance) return;
    }
    visit(entry);
    visit(exit);
}

template <typename Visit>
void visitAll(const CurvedCrossings& crossings, const Visit& visit)
{
    for (size_t i = 0; i < static_cast<size_t>(crossings.count); ++i)
        visit(Crossing{crossings.distance[i], crossings.face[i]});
}

// Calls visit(Crossing) for each crossing in order of distance.
template <typename Visit>
void crossPrimitive(const Primitive& primitive, const Ray& ray, const Visit& visit)
{
    switch (primitive.shape) {
    case PrimitiveShape::kPlane:
        return crossPlane(primitive, ray, visit);
    case PrimitiveShape::kSphere:
        return crossSphere(primitive, ray, visit);
    case PrimitiveShape::kBox:
        return crossBox(primitive, ray, visit);
    case PrimitiveShape::kLens:
        return visitAll(crossLens(primitive, ray), visit);
    case PrimitiveShape::kTorus:
        return visitAll(crossTorus(primitive, ray), visit);
    }
}

SurfaceHit makeHit(const Primitive& primitive, int index, const Ray& ray, const Crossing& crossing)
{
    SurfaceHit hit;
    hit.distance = crossing.distance;
    hit.positionWS = ray.originWS + crossing.distance * ray.dirWS;
    hit.primitive = index;
    switch (primitive.shape) {
    case PrimitiveShape::kPlane:
        hit.normalWS = primitive.worldFromLocal[2];
        break;
    case PrimitiveShape::kSphere:
        hit.normalWS = glm::normalize(hit.positionWS - primitive.center);
        break;
    case PrimitiveShape::kBox:
        hit.normalWS = (crossing.face % 2 == 1 ? 1.0 : -1.0) * primitive.worldFromLocal[crossing.face / 2];
        break;
    case PrimitiveShape::kLens:
        hit.normalWS = lensNormal(primitive, hit.positionWS, crossing.face);
        break;
    case PrimitiveShape::kTorus:
        hit.normalWS = torusNormal(primitive, hit.positionWS);
        break;
    }
    hit.backFace = glm::dot(hit.normalWS, ray.dirWS) > 0.0;
    return hit;
}

[[noreturn]] void rejectPrimitive(size_t number, const std::string& what)
{
    throw InputError(fmt::format("scene: primitive {}: {}", number, what));
}

bool isFinite(const glm::dvec3& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool isRotation(const glm::dmat3& m)
{
    const glm::dmat3 residue = glm::transpose(m) * m - glm::dmat3(1.0);
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            if (!(std::abs(residue[column][row]) <= 1e-6)) return false;
    return glm::determinant(m) > 0.0;
}

// Extent of a gradient's axis from the centre, metres.
double gradientHalfExtent(const Primitive& primitive)
{
    return localHalfExtents(primitive)[primitive.radiance.axis];
}

void validateRadiance(const Primitive& primitive, size_t number)
{
    const Radiance& radiance = primitive.radiance;
    if (!isFinite(radiance.colorA) || !isFinite(radiance.colorB))
        rejectPrimitive(number, "a colour holds a NaN or an infinity; allowed: finite radiance");
    if (radiance.pattern == RadiancePattern::kChecker && !(radiance.cellSize > 0.0 && std::isfinite(radiance.cellSize)))
        rejectPrimitive(number, fmt::format("cell size {}; allowed: metres above 0", radiance.cellSize));
    if (radiance.pattern != RadiancePattern::kGradient) return;
    const int axes = primitive.shape == PrimitiveShape::kPlane ? 2 : 3;
    if (radiance.axis < 0 || radiance.axis >= axes)
        rejectPrimitive(number,
                        fmt::format("gradient axis {}; allowed: 0 to {} of the local frame", radiance.axis, axes - 1));
    if (!std::isfinite(gradientHalfExtent(primitive)))
        rejectPrimitive(number, "a gradient over an infinite extent; allowed: a finite half extent along its axis");
}

// Spheres, lenses and tori.
void validateRound(const Primitive& primitive, size_t number)
{
    if (primitive.shape == PrimitiveShape::kPlane || primitive.shape == PrimitiveShape::kBox) return;
    if (!(primitive.radius > 0.0 && std::isfinite(primitive.radius)))
        rejectPrimitive(number, fmt::format("radius {}; allowed: metres above 0", primitive.radius));
    const bool isLens = primitive.shape == PrimitiveShape::kLens;
    if (isLens && !(primitive.thickness > 0.0 && primitive.thickness <= 2 * primitive.radius))
        rejectPrimitive(number, fmt::format("thickness {}; allowed: metres above 0, up to twice the radius of {}",
                                            primitive.thickness, primitive.radius));
    const bool isTorus = primitive.shape == PrimitiveShape::kTorus;
    if (isTorus && !(primitive.tubeRadius > 0.0 && primitive.tubeRadius < primitive.radius))
        rejectPrimitive(number, fmt::format("tube radius {}; allowed: metres above 0, below the radius of {}",
                                            primitive.tubeRadius, primitive.radius));
    const bool isShell = primitive.shape == PrimitiveShape::kSphere && primitive.wall != 0.0;
    if (isShell && !(primitive.wall > 0.0 && primitive.wall < primitive.radius))
        rejectPrimitive(number, fmt::format("wall {}; allowed: metres above 0, below the radius of {}", primitive.wall,
                                            primitive.radius));
}

void validatePrimitive(const Primitive& primitive, size_t number)
{
    if (!isFinite(primitive.center))
        rejectPrimitive(number, "its centre holds a NaN or an infinity; allowed: a finite point");
    if (!isRotation(primitive.worldFromLocal))
        rejectPrimitive(number, "its frame is not a rotation; allowed: orthonormal axes without a mirror image");
    validateRound(primitive, number);
    if (primitive.shape == PrimitiveShape::kPlane || primitive.shape == PrimitiveShape::kBox) {
        const int axes = primitive.shape == PrimitiveShape::kPlane ? 2 : 3;
        for (int axis = 0; axis < axes; ++axis) // infinite is allowed: an endless plane, a slab
            if (!(primitive.halfExtents[axis] > 0.0))
                rejectPrimitive(number,
                                fmt::format("half extent {}; allowed: metres above 0", primitive.halfExtents[axis]));
    }
    const std::string& material = primitive.material;
    if (material != "diffuse" && material != "mirror" && material != "glass")
        rejectPrimitive(number, fmt::format("material \"{}\"; allowed: diffuse, mirror, glass", material));
    if (material == "glass" && primitive.shape == PrimitiveShape::kPlane)
        rejectPrimitive(number, "a plane of glass has no inside; allowed: a sphere, a box, a lens or a torus");
    if (material == "glass" && !(primitive.ior > 0.0 && std::isfinite(primitive.ior)))
        rejectPrimitive(number, fmt::format("index of refraction {}; allowed: above 0", primitive.ior));
    if (primitive.objectIndex < 0)
        rejectPrimitive(number, fmt::format("object index {}; allowed: 1 and above, or 0 to number by order",
                                            primitive.objectIndex));
    validateRadiance(primitive, number);
}

} // namespace

std::optional<SurfaceHit> castRay(const Scene& scene, const Ray& ray, double minDistance, double maxDistance,
                                  int ignorePrimitive)
{
    Crossing nearest{maxDistance, 0};
    int found = -1;
    const int count = static_cast<int>(scene.primitives.size());
    for (int i = 0; i < count; ++i) {
        if (i == ignorePrimitive) continue;
        crossPrimitive(scene.primitives[static_cast<size_t>(i)], ray, [&](const Crossing& crossing) {
            if (crossing.distance > minDistance && crossing.distance < nearest.distance) {
                nearest = crossing;
                found = i;
            }
        });
    }
    if (found < 0) return std::nullopt;
    return makeHit(scene.primitives[static_cast<size_t>(found)], found, ray, nearest);
}

std::vector<SurfaceHit> intersectPrimitive(const Primitive& primitive, const Ray& ray)
{
    std::vector<SurfaceHit> hits;
    bool leaves = false;
    crossPrimitive(primitive, ray, [&](const Crossing& crossing) {
        if (std::isfinite(crossing.distance)) { // an endless box is entered nowhere
            hits.push_back(makeHit(primitive, 0, ray, crossing));
            // A ray that runs along a face can round either way; entry and exit are told by their order.
            if (primitive.shape != PrimitiveShape::kPlane) hits.back().backFace = leaves;
        }
        leaves = !leaves;
    });
    return hits;
}

Scene makeOpaqueScene(const Scene& scene)
{
    Scene opaque = scene;
    std::erase_if(opaque.primitives, [](const Primitive& primitive) { return primitive.material == "glass"; });
    return opaque;
}

int objectIndexOf(const Scene& scene, int primitive)
{
    const int own = scene.primitives[static_cast<size_t>(primitive)].objectIndex;
    return own != 0 ? own : primitive + 1;
}

glm::dvec3 localHalfExtents(const Primitive& primitive)
{
    switch (primitive.shape) {
    case PrimitiveShape::kPlane:
        return {primitive.halfExtents.x, primitive.halfExtents.y, 0.0};
    case PrimitiveShape::kBox:
        return primitive.halfExtents;
    case PrimitiveShape::kSphere:
        return glm::dvec3(primitive.radius);
    case PrimitiveShape::kLens:
        return {lensRimRadius(primitive), lensRimRadius(primitive), 0.5 * primitive.thickness};
    case PrimitiveShape::kTorus:
        return {primitive.radius + primitive.tubeRadius, primitive.radius + primitive.tubeRadius, primitive.tubeRadius};
    }
    return glm::dvec3(0.0);
}

glm::dvec3 computeRadiance(const Scene& scene, const SurfaceHit& hit)
{
    const Primitive& primitive = scene.primitives[static_cast<size_t>(hit.primitive)];
    const Radiance& radiance = primitive.radiance;
    if (radiance.pattern == RadiancePattern::kSolid) return radiance.colorA;
    const glm::dmat3 localFromWorld = glm::transpose(primitive.worldFromLocal);
    const glm::dvec3 local = localFromWorld * (hit.positionWS - primitive.center);
    if (radiance.pattern == RadiancePattern::kGradient) {
        const double half = gradientHalfExtent(primitive);
        const double t = glm::clamp(0.5 + 0.5 * local[radiance.axis] / half, 0.0, 1.0);
        return glm::mix(radiance.colorA, radiance.colorB, t);
    }
    int acrossAxis = -1; // the face's own axis
    if (primitive.shape == PrimitiveShape::kPlane) acrossAxis = 2;
    if (primitive.shape == PrimitiveShape::kBox) {
        const glm::dvec3 normal = glm::abs(localFromWorld * hit.normalWS);
        acrossAxis = normal.x > normal.y ? (normal.x > normal.z ? 0 : 2) : (normal.y > normal.z ? 1 : 2);
    }
    double parity = 0.0;
    for (int axis = 0; axis < 3; ++axis)
        if (axis != acrossAxis) parity += std::floor(local[axis] / radiance.cellSize);
    return std::fmod(std::abs(parity), 2.0) == 0.0 ? radiance.colorA : radiance.colorB;
}

glm::dvec3 computeSkyRadiance(const Scene& scene, const glm::dvec3& dirWS)
{
    const double sine = glm::clamp(glm::dot(dirWS, scene.upWS), -1.0, 1.0);
    return sine >= 0.0 ? glm::mix(scene.sky.horizon, scene.sky.zenith, sine)
                       : glm::mix(scene.sky.horizon, scene.sky.nadir, -sine);
}

void validateScene(const Scene& scene)
{
    for (size_t i = 0; i < scene.primitives.size(); ++i)
        validatePrimitive(scene.primitives[i], i + 1);
    if (!isFinite(scene.sky.zenith) || !isFinite(scene.sky.horizon) || !isFinite(scene.sky.nadir))
        throw InputError("scene: a sky colour holds a NaN or an infinity; allowed: finite radiance");
    if (!(std::abs(glm::length(scene.upWS) - 1.0) <= 1e-6))
        throw InputError("scene: its up direction is not of length 1; allowed: a unit vector");
}

} // namespace crossray
