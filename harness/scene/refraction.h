// Light through a clear solid by Snell's law, exactly: every interface of a sphere, a bubble, a box, a lens or a
// torus.
#pragma once

#include "harness/scene/scene.h"

#include <optional>

namespace crossray {

// Mirror image of a direction at a surface; the normal's side does not matter.
glm::dvec3 reflectDirection(const glm::dvec3& dirWS, const glm::dvec3& normalWS);

// Direction behind an interface. `normalWS` is unit and on the side that the light comes from; `indexRatio` is the
// index before the interface over the one behind it. Nothing beyond the critical angle.
std::optional<glm::dvec3> refractDirection(const glm::dvec3& dirWS, const glm::dvec3& normalWS, double indexRatio);

struct RefractedPath {
    glm::dvec3 entryWS{0.0};
    glm::dvec3 insideDirWS{0.0}; // unit, behind the first interface
    glm::dvec3 exitWS{0.0};
    glm::dvec3 exitDirWS{0.0}; // unit
    double length = 0;         // metres inside the material
};

// Path of a ray that meets the solid (of index `solid.ior`, in air) from outside at `entryWS`, where the outward unit
// normal is `normalWS`, until it leaves it for good: through a bubble's air and its other wall, and through a torus as
// often as it meets it. Nothing when an interface reflects all of it.
std::optional<RefractedPath> refractThrough(const Primitive& solid, const glm::dvec3& entryWS,
                                            const glm::dvec3& normalWS, const glm::dvec3& dirWS);

} // namespace crossray
