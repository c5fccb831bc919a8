// The library's HiZ tracer in float, behind types that know nothing of GLSL: a unit cannot hold both the library and
// the harness's scenes, whose vectors bear the same names.
#pragma once

#include <array>
#include <span>

namespace yardstick {

struct Frame {
    std::array<double, 16> viewFromWorld, worldFromView; // columns
    int width = 0, height = 0;
    double slopeX = 0, slopeY = 0; // tangents of half the field of view
    double nearDistance = 0, farDistance = 0;
};
struct Settings {
    int minLevel = 0, maxLevel = 99, maxIterations = 1000;
    double depthBias = 0; // metres
};
struct Answer {
    bool hit = false;
    double x = 0, y = 0; // pixels
    double linearDepth = 0;
    int iterations = 0;
    long fetches = 0; // reads of the pyramid
};

// Linear depth of each pixel, row 0 the top; 0 where there is no surface. Held until the next call.
void setDepth(const Frame& frame, std::span<const float> linearDepth);
// The ray from what the pixel shows along a unit direction in world space.
Answer trace(int x, int y, const std::array<double, 3>& dirWS, const Settings& settings);

} // namespace yardstick
