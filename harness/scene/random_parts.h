// What the generators of random scenes share. One draw a statement everywhere: the order in which arguments are
// evaluated is the compiler's choice.
#pragma once

#include "harness/scene/random_scene.h"

namespace crossray {

// A mirror with a checker of its own colours.
void dress(Primitive& primitive, RandomStream& random);

// A rectangle whose normal is the cross product of its axes, which are unit and at right angles.
Primitive makeWall(const glm::dvec3& center, const glm::dvec3& xAxis, const glm::dvec3& yAxis, double halfX,
                   double halfY);

// No solid nearer than the clearance that the generators' cameras keep. `vault` is a sphere that the eye is inside of;
// -1: none.
bool isClear(const Scene& scene, const glm::dvec3& eyeWS, int vault = -1);

// Where a generator's camera may stand, and where it may look.
struct CameraRegion {
    glm::dvec3 eyeLow, eyeHigh, targetLow, targetHigh;
};

// A camera whose eye is clear of the scene, looking at a target; the image's size moves nothing. The region must be far
// larger than what the scene's objects fill.
Camera drawCamera(RandomStream& random, const Scene& scene, const CameraRegion& region, int width, int height,
                  int vault = -1);

} // namespace crossray
