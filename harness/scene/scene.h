// Analytic scenes: plane, sphere, box, lens and torus primitives with closed-form unlit radiance under a gradient sky,
// and the double-precision ray caster over them. Shares no code with the shaders.
#pragma once

#include "harness/scene/camera.h"

#include <glm/glm.hpp>

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace crossray {

enum class RadiancePattern { kSolid, kChecker, kGradient };

// Unlit emitted radiance as a function of the position. Checker: cells of `cellSize` metres in the primitive's local
// frame, colorA where the sum of the cell indices is even; on a plane and on a box's face only the two axes along the
// face count, since across it rounding would choose the cell. Gradient: from colorA to colorB along the local axis over
// the (finite) extent.
struct Radiance {
    RadiancePattern pattern = RadiancePattern::kSolid;
    glm::dvec3 colorA{0.8};
    glm::dvec3 colorB{0.2};
    double cellSize = 0.5; // metres
    int axis = 1;          // gradient: 0 x, 1 y, 2 z of the local frame
    bool operator==(const Radiance&) const = default;
};

// Lens: what two spheres of one radius share, its axis the local z. Torus: a ring around the local z.
enum class PrimitiveShape { kPlane, kSphere, kBox, kLens, kTorus };

// The local frame is a rotation about `center`; scale is carried by the extents.
struct Primitive {
    PrimitiveShape shape = PrimitiveShape::kPlane;
    glm::dvec3 center{0.0};
    glm::dmat3 worldFromLocal{1.0};                                  // rotation
    glm::dvec3 halfExtents{std::numeric_limits<double>::infinity()}; // plane: local x and y; box: all three
    double radius = 1.0;     // sphere; lens: of its faces; torus: from the middle to the middle of the tube
    double thickness = 0.5;  // lens: metres along the axis, at most twice the radius
    double tubeRadius = 0.3; // torus: metres, less than the radius
    double wall = 0.0;       // a sphere of glass: metres of it around air, a bubble; 0: glass all through
    Radiance radiance;
    std::string material = "diffuse"; // "diffuse", "mirror" (traced by reflection) or "glass" (traced by refraction)
    double ior = 1.5;                 // glass
    int objectIndex = 0;              // 0: numbered by order, from 1
    bool operator==(const Primitive&) const = default;
};

// Radiance by direction: zenith to horizon to nadir, linear in the angle's sine (dot with up).
struct Sky {
    glm::dvec3 zenith{0.25, 0.45, 0.85};
    glm::dvec3 horizon{0.75, 0.85, 0.95};
    glm::dvec3 nadir{0.2, 0.18, 0.16};
    bool operator==(const Sky&) const = default;
};

struct Scene {
    std::vector<Primitive> primitives;
    Sky sky;
    glm::dvec3 upWS{0.0, 1.0, 0.0};
    bool operator==(const Scene&) const = default;
};

struct SurfaceHit {
    double distance = 0; // along the unit ray, metres
    glm::dvec3 positionWS{0.0};
    glm::dvec3 normalWS{0.0}; // unit, geometric: outward for solids, local +z for planes
    int primitive = -1;
    bool backFace = false; // the ray runs along the normal: it leaves a solid, or sees a plane from behind
};

inline constexpr double kNoLimit = std::numeric_limits<double>::infinity();

// Nearest hit with distance in (minDistance, maxDistance); planes are hit from both sides. `ignorePrimitive` is
// skipped.
std::optional<SurfaceHit> castRay(const Scene& scene, const Ray& ray, double minDistance = 1e-9,
                                  double maxDistance = kNoLimit, int ignorePrimitive = -1);
// All hits of one primitive along the ray, in order of distance, from (-inf, inf).
std::vector<SurfaceHit> intersectPrimitive(const Primitive& primitive, const Ray& ray);

// Throws InputError when a number is NaN, a size is not above 0, a frame is no rotation, a material or pattern is
// unknown or does not go with the shape (a plane of glass, a gradient over an infinite extent).
void validateScene(const Scene& scene);

// Half the size of the box around a primitive along its own axes, metres; 0 across a plane.
glm::dvec3 localHalfExtents(const Primitive& primitive);

// The scene without what is of glass.
Scene makeOpaqueScene(const Scene& scene);

// Object index as the G-buffer shows it: the primitive's own, or its number in the scene from 1.
int objectIndexOf(const Scene& scene, int primitive);

glm::dvec3 computeRadiance(const Scene& scene, const SurfaceHit& hit);
glm::dvec3 computeSkyRadiance(const Scene& scene, const glm::dvec3& dirWS);

} // namespace crossray
