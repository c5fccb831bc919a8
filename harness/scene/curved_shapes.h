// Where a ray crosses the solids that are neither a sphere nor a box: a lens and a torus.
#pragma once

#include "harness/scene/scene.h"

#include <array>

namespace crossray {

// Along the ray, in order, entries and exits in turn: 0, 2 or (torus) 4.
struct CurvedCrossings {
    int count = 0;
    std::array<double, 4> distance{};
    std::array<int, 4> face{}; // lens: 0 the face towards local +z, 1 the other; torus: 0
};

CurvedCrossings crossLens(const Primitive& lens, const Ray& ray);

// By the quartic of the ray's parameter, which has at most three turning points. These are found between the turning
// points of its derivative, and so on down to a square root: between two neighbouring ones the quartic is monotone, so
// that each change of sign holds exactly one crossing, and halving the stretch ends at two neighbouring doubles. The
// sign itself is that of the distance to the ring, not of the expanded coefficients, which would cancel.
CurvedCrossings crossTorus(const Primitive& torus, const Ray& ray);

// Outward unit normals there.
glm::dvec3 lensNormal(const Primitive& lens, const glm::dvec3& positionWS, int face);
glm::dvec3 torusNormal(const Primitive& torus, const glm::dvec3& positionWS);

// Metres from a lens' axis to its rim.
double lensRimRadius(const Primitive& lens);

} // namespace crossray
