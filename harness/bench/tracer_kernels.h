// The library's tracers behind plain numbers: the unit that compiles the GLSL as C++ has a GLM of its own, so that no
// GLM type crosses this border.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace crossray {

// A G-buffer and its camera, in float.
struct TracerImage {
    uint64_t serial = 0; // of the scene; images of one serial are equal
    int width = 0, height = 0;
    std::array<float, 16> worldFromView{}; // columns; rigid
    float slopeX = 1, slopeY = 1;          // View.slope
    float depthA = 0, depthB = 1;          // View.depthA, View.depthB
    float nearDistance = 0.1f, farDistance = 100.0f;
    bool orthographic = false, reversedDepth = true;
    std::vector<float> deviceDepths;
    std::vector<float> normalsWS; // 3 a pixel
};

struct KernelAnswer {
    bool isHit = false;
    bool isCapped = false;
    float positionX = 0, positionY = 0;
    float linearDepth = 0;
    float confidence = 0;
    int fetches = 0;
    int iterations = 0;
};

// Makes an image the one that the calling thread traces, and builds the pyramid of one tracer for it, unless it did so
// for this serial before. isLoaded: whether the pixels are there already, so that only the head of the image is looked
// at.
bool isTracerImageLoaded(uint64_t serial);
void loadPatchTracer(const TracerImage& image, float depthError);
void loadHizTracer(const TracerImage& image);

// Along a direction in world space, from the surface at a pixel's centre unless it starts elsewhere.
struct KernelRay {
    int x = 0, y = 0;
    std::array<float, 3> dirWS{};
    bool startsElsewhere = false;
    std::array<float, 3> originWS{};
};
KernelAnswer tracePatchRay(const KernelRay& ray, int maxIterations, float caution, float depthError);
struct HizKernelSettings {
    int minLevel = 0, maxLevel = 6, maxIterations = 512;
    float depthBias = 0; // metres
};
KernelAnswer traceHizRay(const KernelRay& ray, const HizKernelSettings& settings);

} // namespace crossray
