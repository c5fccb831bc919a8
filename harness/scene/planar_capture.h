// What a planar probe captures: the scene as a mirror plane shows it to a camera. The camera is mirrored about the
// plane and sees nothing that lies behind it, as behind an oblique near plane. Radiance by the double-precision ray
// caster, one ray through the centre of each pixel. Shares no code with the shaders.
#pragma once

#include "harness/base/plane.h"
#include "harness/scene/camera.h"
#include "harness/scene/scene.h"

#include <optional>
#include <string_view>

namespace crossray {

struct MirrorPlane {
    glm::dvec3 pointWS{0.0};
    glm::dvec3 normalWS{0.0, 1.0, 0.0}; // unit; the mirror is seen from its side
};

struct PlanarCaptureSettings {
    MirrorPlane mirror;
    int width = 64; // pixels of the image
    int height = 64;
    // Vertical field of view, perspective; the image's sides give the horizontal one. Nothing: the camera's own, both
    // ways, whatever the image's sides are. Not above 0: none.
    std::optional<double> fovYDegrees;
};

enum class PlanarState {
    kCaptured,
    kCameraNotInFront, // on the plane, to 1e-4 m, or behind it
    kNoFieldOfView,
};
std::string_view nameOf(PlanarState state);
PlanarState findPlanarState(const Camera& camera, const PlanarCaptureSettings& settings);

// Where nothing is in front of the mirror the sky is shown, by the mirrored ray's direction; there is no far plane, for
// an oblique one is nowhere in particular. Mirrors and glass show their own radiance. Black unless kCaptured. Three
// channels, named "Planar". Throws InputError on an invalid camera or scene, and on an image without pixels.
Plane capturePlanar(const Scene& scene, const Camera& camera, const PlanarCaptureSettings& settings);

} // namespace crossray
