// The truth: what a ray traced from each pixel of a scene really meets, in doubles, by geometry alone.
#pragma once

#include "harness/base/plane.h"
#include "harness/scene/gbuffer.h"
#include "harness/scene/scene.h"

#include <filesystem>
#include <vector>

namespace crossray {

enum class TraceEffect { kReflection, kRefraction };

// What the depth buffer that rays are traced in shows: every surface, or those that are not of glass, as where an
// engine draws what is transparent last.
enum class ScreenLayer { kAll, kOpaque };

// Could the screen have known the answer?
enum class ScreenKnowledge {
    kNoRay,     // the pixel traces no ray
    kVisible,   // the hit is on screen, nothing lies in front of it, and the side that the ray met faces the camera
    kHidden,    // the hit is on screen but something is in front of it, or its back is what the ray met
    kOffScreen, // the hit is outside the image, behind the camera, before the near or beyond the far plane
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
    double pathLength = 0;                // refraction: metres inside the solid
    glm::dvec3 radiance{0.0};             // of the hit, or of the sky
    bool totalInternalReflection = false; // refraction: no light passes one of the two interfaces; the pixel is kNoRay
};

struct Truth {
    int width = 0, height = 0;
    std::vector<TruthPixel> pixels; // row 0 is the top
    const TruthPixel& at(int x, int y) const
    {
        return pixels[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)];
    }
};

// Rays start at pixels whose nearest surface has the material "mirror" (reflection) or "glass" (refraction), through
// the pixel's centre, and end at the first surface that they meet: mirrors and glass show their own radiance there.
// Refraction enters and leaves the same primitive by exact Snell refraction (harness/scene/refraction.h), and ignores
// what stands inside it; when an interface reflects everything, or the camera is inside the glass, the pixel has no
// ray.
//
// Visible is meant geometrically: a camera ray through the exact projected hit, not through the centre of its pixel,
// must meet it first (distances equal to 1e-6). So a pole thinner than a pixel counts as visible although no pixel's
// centre may show it: what sampling loses is an error of screen space, and its share belongs in the figures.
// With the layer of what is opaque, glass hides nothing, and what a ray meets of it is hidden.
Truth computeTruth(const Scene& scene, const Camera& camera, TraceEffect effect, ScreenLayer layer = ScreenLayer::kAll);

// The same from an independent renderer's truth.exr (position + 64 as RGB; 0 = nothing was hit). `objectIndex` selects
// the tracing pixels. Reads the G-buffer's kLinearDepth, kPositionWS, kNormalWS and kObjectIndex, and kColor where it
// is there: a mirror's or a glass' colour is the radiance that reaches it. A reflection's direction runs from the
// surface to the hit; a refraction's exit position comes from the primitive of the camera.json that bears the material
// "glass", in closed form, and its direction runs from there to the hit. Where nothing was hit the direction is the
// closed form's.
//
// Visible is what the depth buffer can tell: the hit's linear depth agrees with one of the four pixels around it, each
// taken as a plane through its position with its normal, within 1e-3 of the depth plus a quarter of what that plane's
// depth changes a pixel (curvature), and the ray meets the side that this pixel shows.
Truth readTruth(const std::filesystem::path& truthFile, const GBuffer& gbuffer, const Scene& primitives,
                TraceEffect effect, int objectIndex);

} // namespace crossray
