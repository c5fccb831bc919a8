// The previous frame of a case, by the ray caster: its colour as the shader reads it, and where each pixel of this
// frame was on screen then.
#pragma once

#include "harness/base/plane.h"
#include "harness/case/case.h"
#include "harness/scene/camera_frame.h"

#include <optional>

namespace crossray {

struct FrameHistory {
    Plane color;  // 3: linear radiance at the previous camera, broken pixels included
    Plane motion; // 2: UV of this frame's pixel centre less UV then; NaN where it was not in front of the camera
};

// Throws InputError where the previous camera is none. The case has a [history].
FrameHistory makeFrameHistory(const Case& testCase);

// The scene as it stood in the previous frame.
Scene makePreviousScene(const Case& testCase);

// Where in the previous image a point of this frame's primitive was (of no primitive, -1: of what stands still);
// nothing where it was not in front of that camera.
std::optional<glm::dvec2> findPreviousUV(const Case& testCase, const CameraFrame& previous,
                                         const glm::dvec3& positionWS, int primitive);

// The pixels that [history] poison breaks.
bool isPoisoned(const History& history, int x, int y);

// The map of [material.thickness_map], 1 channel, metres, without the multiplier. Throws InputError: a file of another
// shape. The case has one.
Plane makeThicknessMap(const Case& testCase);

} // namespace crossray
