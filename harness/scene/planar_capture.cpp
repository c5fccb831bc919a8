#include "harness/scene/planar_capture.h"

#include "harness/base/error.h"
#include "harness/scene/camera_frame.h"

#include <fmt/format.h>

namespace crossray {

namespace {

constexpr double kSmallestHeight = 1e-4; // metres from the eye to the plane

Ray mirrorRay(const Ray& ray, const MirrorPlane& mirror)
{
    const glm::dvec3& n = mirror.normalWS;
    return {ray.originWS - 2.0 * glm::dot(ray.originWS - mirror.pointWS, n) * n,
            ray.dirWS - 2.0 * glm::dot(ray.dirWS, n) * n};
}

// A mirrored ray starts behind the mirror: what it meets before it comes to the front is cut away.
glm::dvec3 lookThrough(const Scene& scene, const Ray& ray, const MirrorPlane& mirror)
{
    const double behind = glm::dot(mirror.pointWS - ray.originWS, mirror.normalWS);
    const double climb = glm::dot(ray.dirWS, mirror.normalWS);
    if (climb <= 0.0) return computeSkyRadiance(scene, ray.dirWS); // it never does
    const double distance = behind / climb;
    const auto hit = castRay(scene, ray, distance + 1e-9 * (1.0 + distance)); // not the mirror itself
    return hit ? computeRadiance(scene, *hit) : computeSkyRadiance(scene, ray.dirWS);
}

} // namespace

std::string_view nameOf(PlanarState state)
{
    switch (state) {
    case PlanarState::kCaptured:
        return "captured";
    case PlanarState::kCameraNotInFront:
        return "the camera is not in front of the mirror plane";
    case PlanarState::kNoFieldOfView:
        return "no field of view";
    }
    return "";
}

PlanarState findPlanarState(const Camera& camera, const PlanarCaptureSettings& settings)
{
    if (settings.fovYDegrees && !(*settings.fovYDegrees > 0.0)) return PlanarState::kNoFieldOfView;
    const glm::dvec3 fromPlane = glm::dvec3(camera.worldFromView[3]) - settings.mirror.pointWS;
    const bool inFront = glm::dot(fromPlane, settings.mirror.normalWS) > kSmallestHeight;
    return inFront ? PlanarState::kCaptured : PlanarState::kCameraNotInFront;
}

Plane capturePlanar(const Scene& scene, const Camera& camera, const PlanarCaptureSettings& settings)
{
    validateCamera(camera);
    validateScene(scene);
    if (settings.width < 1 || settings.height < 1)
        throw InputError(fmt::format("planar capture: an image of {}x{}; allowed: 1 pixel a side and more",
                                     settings.width, settings.height));
    Plane image("Planar", settings.width, settings.height, 3);
    if (findPlanarState(camera, settings) != PlanarState::kCaptured) return image;
    Camera own = camera;
    if (settings.fovYDegrees) {
        own.fovYDegrees = *settings.fovYDegrees;
        own.width = settings.width;
        own.height = settings.height;
    }
    const CameraFrame frame(own);
    const glm::dvec2 scale = glm::dvec2(own.width, own.height) / glm::dvec2(settings.width, settings.height);
    for (int y = 0; y < settings.height; ++y)
        for (int x = 0; x < settings.width; ++x) {
            const Ray ray = mirrorRay(frame.primaryRay(glm::dvec2(x + 0.5, y + 0.5) * scale), settings.mirror);
            const glm::dvec3 color = lookThrough(scene, ray, settings.mirror);
            for (int c = 0; c < 3; ++c)
                image.at(x, y, c) = color[c];
        }
    return image;
}

} // namespace crossray
