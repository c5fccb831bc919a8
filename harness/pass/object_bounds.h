// The object by whose bounds the Built-in pipeline and URP choose probes: all that traces in a case.
#pragma once

#include "harness/case/case.h"

namespace crossray {

// A box along the world's axes, metres.
struct ObjectBounds {
    glm::dvec3 minWS{0.0};
    glm::dvec3 maxWS{0.0};
};

// Around all primitives of the traced material; a point at the origin where there is none. Of finite primitives.
ObjectBounds findObjectBounds(const Case& testCase);

// Square metres of the bounds' six faces that lie inside the box.
double measureCoveredArea(const ObjectBounds& object, const ObjectBounds& box);

} // namespace crossray
