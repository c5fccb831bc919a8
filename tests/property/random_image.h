// Random cameras, depth images and rays by seed, for properties that hold over any image.
#pragma once

#include "harness/scene/camera.h"

#include <cstdint>
#include <random>
#include <vector>

namespace crossray {

struct RandomRay {
    glm::dvec3 originWS, dirWS;
    int maxLevel;
    double caution; // of the tracer over planes; the thickness in metres of the other one
};

// A G-buffer of planes, blocks, noise and holes, and rays from its pixels and from anywhere.
struct RandomImage {
    uint64_t seed = 0;
    Camera camera;
    std::vector<double> deviceDepths;
    std::vector<double> normalsWS; // 4 a pixel
    double depthError = 0;
    std::vector<RandomRay> rays;
};

enum class ImageShape { kAny, kThin, kWide }; // to 96 a side; 1 to 3 pixels across; 8190 to 8192 wide

RandomImage makeRandomImage(uint64_t seed, ImageShape shape, int rayCount);

} // namespace crossray
