// Where a planar probe shows what a surface reflects. Source: domain, section 6, planar probes. Not by the mirrored
// camera: the point that the ray ends at is mirrored instead, and looked up in the camera's own image.
#include "harness/expect/analytic_probe.h"
#include "harness/expect/captures.h"

#include <algorithm>
#include <cmath>

namespace crossray {

namespace {

// Metres in front of the mirror.
double heightOver(const MirrorPlane& mirror, const glm::dvec3& positionWS)
{
    return glm::dot(positionWS - mirror.pointWS, mirror.normalWS);
}

// The camera with the capture's field of view and shape, where the probe has its own.
Camera makeCaptureCamera(const Camera& camera, const PlanarCaptureSettings& settings)
{
    Camera own = camera;
    if (!settings.fovYDegrees) return own;
    own.fovYDegrees = *settings.fovYDegrees;
    own.width = settings.width;
    own.height = settings.height;
    return own;
}

// What the mirrored camera has in view in front of the mirror is what the camera has behind it: no part of the view
// volume lies there unless one of the far corners does.
bool seesThroughMirror(const CameraFrame& frame, const MirrorPlane& mirror)
{
    const Camera& camera = frame.camera();
    const bool isEndless = camera.depthConvention == DepthConvention::kInfiniteReversed;
    for (const glm::dvec2 corner : {glm::dvec2(0, 0), {1, 0}, {0, 1}, {1, 1}}) {
        const glm::dvec2 positionSS = corner * glm::dvec2(camera.width, camera.height);
        const double height = isEndless ? glm::dot(frame.primaryRay(positionSS).dirWS, mirror.normalWS)
                                        : heightOver(mirror, frame.unproject(positionSS, camera.farDistance));
        if (height < 0.0) return true;
    }
    return false;
}

glm::dvec3 findRayEnd(const Probe& probe, const EffectRay& ray)
{
    const ProxyVolume proxy{probe.proxy.center, probe.proxy.worldFromVolume, probe.proxy.halfExtents,
                            probe.proxy.halfExtents.x};
    std::optional<double> distance;
    if (probe.proxy.shape == VolumeShape::kBox) distance = distanceToBoxExit(proxy, {ray.originWS, ray.dirWS});
    if (probe.proxy.shape == VolumeShape::kSphere) distance = distanceToSphereExit(proxy, {ray.originWS, ray.dirWS});
    const double metres = distance ? std::max(*distance, probe.minProjectionDistance) : kInfiniteProxyDistance;
    return ray.originWS + metres * ray.dirWS;
}

} // namespace

PlanarPlace findPlanarPlace(const Camera& camera, const Probe& probe, const EffectRay& ray)
{
    const PlanarCaptureSettings settings = makePlanarSettings(probe);
    const PlanarState state = findPlanarState(camera, settings);
    if (state == PlanarState::kNoFieldOfView) return {PlanarStatus::kNoFieldOfView, {}};
    if (state == PlanarState::kCameraNotInFront) return {PlanarStatus::kCameraNotInFront, {}};
    const MirrorPlane& mirror = settings.mirror;
    const CameraFrame frame(makeCaptureCamera(camera, settings));
    if (!seesThroughMirror(frame, mirror)) return {PlanarStatus::kPlaneOutOfView, {}};
    // The mirrored camera looks against the ray when the camera looks against the mirrored ray.
    const glm::dvec3& n = mirror.normalWS;
    const glm::dvec3 mirroredDirWS = ray.dirWS - 2.0 * glm::dot(ray.dirWS, n) * n;
    if (glm::dot(mirroredDirWS, frame.forwardWS()) < 0.0) return {PlanarStatus::kOpposed, {}};
    const glm::dvec3 endWS = findRayEnd(probe, ray);
    const double height = heightOver(mirror, endWS);
    const ScreenPoint image = frame.project(endWS - 2.0 * height * n);
    if (height < 0.0 || !image.inFront) return {PlanarStatus::kBehindNearPlane, {}};
    const Camera& own = frame.camera();
    const glm::dvec2 uv = image.positionSS / glm::dvec2(own.width, own.height);
    if (!image.onScreen) return {PlanarStatus::kOutsideImage, {}};
    return {PlanarStatus::kOk, uv};
}

PlanarShare sharePlanarProbes(const Case& testCase, const SurfacePoint& surface, const EffectRay& ray)
{
    PlanarShare share;
    for (const size_t number : hdrpOrder(testCase.probes)) {
        const Probe& probe = testCase.probes[number];
        if (probe.kind != ProbeKind::kPlanar) continue;
        const double asked = probeWeightAt(probe, surface, ray.dirWS);
        if (asked <= 0.0) continue;
        const PlanarPlace place = findPlanarPlace(testCase.camera, probe, ray);
        if (share.first.status == PlanarStatus::kNotAsked) share.first = place;
        if (place.status != PlanarStatus::kOk) continue;
        const double got = std::min(asked, 1.0 - share.weight);
        share.weight += got;
        share.multiplied += got * probe.multiplier;
    }
    return share;
}

} // namespace crossray
