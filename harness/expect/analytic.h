// The closed forms, one subject a file. Written by hand from the formulas, each by another derivation than the obvious
// one where there is one, so that it is a second opinion on the shaders.
#pragma once

#include "harness/case/case.h"
#include "harness/expect/expect.h"
#include "harness/scene/camera_frame.h"

#include <optional>

namespace crossray {

// The values of HitReason that a closed form can know; shaders/crossray/shared/outputs.glsl.
enum class HitReason : int {
    kNone = 0,
    kBehindCamera = 5,
    kNoProxyHit = 6,
    kNoRefractedRay = 8,
    kDegenerateRay = 9,
    kDegenerateInput = 10,
};

// The ray that a pixel sends out, or why there is none.
struct EffectRay {
    HitReason status = HitReason::kNone;
    glm::dvec3 originWS{0.0};
    glm::dvec3 dirWS{0.0}; // unit
    double pathLength = 0; // metres inside the refracting material
};

EffectRay reflectAtSurface(const SurfacePoint& surface);

// Models of refraction (domain, section 5). `ior` is the inside's index over the outside's, `thickness` in metres.
EffectRay refractThroughSphere(const SurfacePoint& surface, double ior, double thickness);
EffectRay refractThroughBox(const SurfacePoint& surface, double ior, double thickness);
EffectRay refractThroughThin(const SurfacePoint& surface, double ior);
EffectRay passStraight(const SurfacePoint& surface);

// Metres that the material is taken to be thick at a surface point: the map's, else the material's.
double thicknessAt(const Material& material, const SurfacePoint& surface);

// The ray of the case's effect and refraction model.
EffectRay computeEffectRay(const Case& testCase, const SurfacePoint& surface);

// Share of white light, per channel in [0,1], that is left after a way inside; metres.
glm::dvec3 transmittanceAfter(const Material& material, double pathLength);
// Share of light that the refracting surface reflects, by the case's model; 1 at total reflection.
double reflectedShare(const Material& material, const SurfacePoint& surface);

// The levels of the previous frame's colour: 4 channels, the mean of a cell's valid pixels and their share.
std::vector<Plane> averageLevels(const Plane& color);
// Between cells and levels; nothing where no valid pixel counts.
std::optional<glm::dvec3> colorAt(const std::vector<Plane>& levels, const glm::dvec2& uv, double level);
double colorLevelOf(double roughness, TraceEffect effect, int levels);

// Distance along the ray to where it leaves the proxy; nothing when it does not meet it.
std::optional<double> distanceToBoxExit(const ProxyVolume& proxy, const Ray& ray);
std::optional<double> distanceToSphereExit(const ProxyVolume& proxy, const Ray& ray);
inline constexpr double kInfiniteProxyDistance = 65504.0; // metres

// Where a ray ends on a proxy, and what the camera makes of it.
struct RayEnd {
    HitClass hitClass = HitClass::kNoRaycast;
    HitReason reason = HitReason::kNone;
    ScreenPoint screen; // of a hit
};
RayEnd projectOnProxy(const CameraFrame& frame, ProjectionModel model, const ProxyVolume& proxy, const EffectRay& ray);

// Where a linear march finds a surface of one depth: at the first sample, or halved stretch, beyond the true hit.
struct LinearMarch {
    int iterations = 0;
    glm::dvec2 positionSS{0.0};
    double linearDepth = 0; // of the ray there, metres
};
LinearMarch marchOnFacingSurface(const Camera& camera, const LinearSettings& settings, const glm::dvec2& startSS,
                                 double startDepth, const glm::dvec2& hitSS, double hitDepth);

// Direction of a ray on screen at its start: xy unit in NDC, z the change of 1/linear depth for a unit of way there. By the
// quotient rule on the projection in clip space. 0 along the line of sight, and where the start is not in front.
glm::dvec3 rayDirectionNDC(const Camera& camera, const glm::dvec3& originWS, const glm::dvec3& dirWS);

// Weight in [0,1] of a hit at `uv`; domain, section 2. `distance` in the same unit.
double screenWeightAt(const glm::dvec2& uv, double distance, ScreenWeightForm form);

// What PlanarStatus says: the values of crossray/probe/planar.glsl and of pass/planar_tier.glsl.
enum class PlanarStatus : int {
    kOk = 0,
    kCameraNotInFront = 1,
    kNoFieldOfView = 3,
    kPlaneOutOfView = 4,
    kOutsideImage = 5,
    kBehindNearPlane = 6,
    kOpposed = 7,
    kNotAsked = 9,
};

// Where a planar probe's image shows the end of a ray, for a ray that a surface sends out.
struct PlanarPlace {
    PlanarStatus status = PlanarStatus::kNotAsked;
    glm::dvec2 uv{0.0}; // [0,1], v down; 0 where the status is not kOk
};
PlanarPlace findPlanarPlace(const Camera& camera, const Probe& probe, const EffectRay& ray);

// The case's planar probes by what they get of a pixel: smaller influences first. Standard probes have no part in it.
struct PlanarShare {
    PlanarPlace first;     // of the first whose influence reaches the surface
    double weight = 0;     // of all
    double multiplied = 0; // the same, each times its probe's multiplier
};
PlanarShare sharePlanarProbes(const Case& testCase, const SurfacePoint& surface, const EffectRay& ray);

} // namespace crossray
