// The truth: what a ray traced from each pixel of a scene really meets, in doubles, by geometry alone.
#pragma once

#include "harness/base/plane.h"
#include "harness/scene/gbuffer.h"
#include "harness/scene/scene.h"

#include <filesystem>
#include <vector>

namespace crossray {

enum class TraceEffect { kReflection, kRefraction };

// Could the screen have known the answer?
enum class ScreenKnowledge {
    kNoRay,     // the pixel traces no ray
    kVisible,   // the hit is on screen and is the nearest surface of its pixel, facing the camera
    kHidden,    // the hit is on screen but something is in front of it, or its back is what the ray met
    kOffScreen, // the hit is outside the image or behind the camera
    kSky,       // the ray leaves the scene
};
std::string_view nameOf(ScreenKnowledge knowledge);

struct TruthPixel {
    ScreenKnowledge screen = ScreenKnowledge::kNoRay;
    glm::dvec3 rayOriginWS{0.0}; // reflection: the surface; refraction: where the ray leaves the solid
    glm::dvec3 rayDirWS{0.0};    // unit; reflected, or the exit direction after both interfaces
    glm::dvec3 hitPositionWS{0.0};
    glm::dvec2 hitPositionSS{0.0};
    double hitLinearDepth = 0;
    double pathLength = 0; // refraction: metres inside the solid
    glm::dvec3 radiance{0.0};
    bool totalInternalReflection = false; // refraction: no ray leaves by the second interface; the pixel is kNoRay
};

struct Truth {
    int width = 0, height = 0;
    std::vector<TruthPixel> pixels; // row 0 is the top
    const TruthPixel& at(int x, int y) const { return pixels[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)]; }
};

// Rays start at pixels whose nearest surface has the material "mirror" (reflection) or "glass" (refraction), through the pixel's
// centre. Refraction enters and leaves the same primitive (sphere or box) by exact Snell refraction; when nothing leaves after
// the second interface the pixel has no ray.
Truth computeTruth(const Scene& scene, const Camera& camera, TraceEffect effect);

// The same from an independent renderer's truth.exr (position + 64 as RGB; 0 = nothing was hit), with the G-buffer for what is
// visible. `objectIndex` selects the tracing pixels. A refraction's exit position comes from the primitive of the camera.json
// that bears the material "glass", in closed form.
Truth readTruth(const std::filesystem::path& truthFile, const GBuffer& gbuffer, const Scene& primitives,
                TraceEffect effect, int objectIndex);

} // namespace crossray
