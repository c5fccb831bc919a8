// The previous frame, whose colour the rays of this one find: [history].
#pragma once

#include "harness/scene/camera.h"

#include <vector>

namespace crossray {

enum class Reprojection { kMotionVectors = 0, kPreviousViewProjection = 1 };
// What the broken pixels of the previous frame hold, in every channel.
enum class HistoryPoison { kNone = 0, kNan = 1, kInfinity = 2, kNegative = 3 };

// A primitive that moved since the previous frame; its material and radiance moved with it.
struct PrimitiveMotion {
    int primitive = 0;  // of the scene, from 0
    glm::dvec3 by{0.0}; // metres, from the previous frame to this one
};

struct History {
    Camera camera; // of the previous frame; image size, kind and depth are this frame's
    Reprojection reprojection = Reprojection::kMotionVectors;
    int levels = 0; // of the colour pyramid, from the finest; 0: all
    HistoryPoison poison = HistoryPoison::kNone;
    int poisonEvery = 8; // pixels: both of a broken pixel's coordinates are half of it more than a multiple of it
    std::vector<PrimitiveMotion> moved;
};

} // namespace crossray
