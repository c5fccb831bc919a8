#include "harness/expect/planar_diagnosis.h"

#include "harness/expect/captures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace crossray {

namespace {

// Metres from a point to the volume; 0 inside.
double distanceToVolume(const ProbeVolume& volume, const glm::dvec3& positionWS)
{
    const glm::dvec3 local = glm::transpose(volume.worldFromVolume) * (positionWS - volume.center);
    if (volume.shape == VolumeShape::kSphere) return std::max(glm::length(local) - volume.halfExtents.x, 0.0);
    return glm::length(glm::max(glm::abs(local) - volume.halfExtents, glm::dvec3(0.0)));
}

// By the chord, which stays exact where the cosine rounds to 1.
double degreesBetween(const glm::dvec3& a, const glm::dvec3& b)
{
    return 2.0 * std::asin(std::min(0.5 * glm::length(a - b), 1.0)) * 180.0 / std::numbers::pi;
}

// A tenth of a millimetre, a tenth of a thousandth of a degree: more would be noise to a reader.
double rounded(double value)
{
    return std::round(value * 1e4) / 1e4;
}

std::string describeInfluence(const PlanarDiagnosis& diagnosis)
{
    if (diagnosis.tracedPixels == 0) return "There is no receiver: no pixel traces a ray.";
    if (diagnosis.insidePixels == 0) {
        return fmt::format("The influence volume does not overlap the receiver: none of its {} pixels is inside, the "
                           "nearest is {:g} m away. The probe shows nothing.",
                           diagnosis.tracedPixels, rounded(diagnosis.nearestMetres));
    }
    return fmt::format("The influence volume overlaps the receiver: {} of its {} pixels are inside.",
                       diagnosis.insidePixels, diagnosis.tracedPixels);
}

std::string describePlane(const PlanarDiagnosis& diagnosis)
{
    if (diagnosis.largestDegrees > kParallelDegrees) {
        return fmt::format("The mirror plane's normal is not parallel to the surface's: {:g} to {:g} degrees apart. "
                           "The probe does not show what the surface reflects.",
                           rounded(diagnosis.smallestDegrees), rounded(diagnosis.largestDegrees));
    }
    const std::string parallel = fmt::format("The mirror plane's normal is parallel to the surface's: {:g} degrees "
                                             "apart at most",
                                             rounded(diagnosis.largestDegrees));
    if (diagnosis.farthestFromPlane > kOnPlaneMetres) {
        return fmt::format("{}, but the surface is up to {:g} m off the plane: what the probe shows is shifted.",
                           parallel, rounded(diagnosis.farthestFromPlane));
    }
    return parallel + ".";
}

std::string describeCamera(const PlanarDiagnosis& diagnosis)
{
    const double height = rounded(diagnosis.cameraHeight);
    if (diagnosis.state == PlanarState::kNoFieldOfView)
        return "The field of view is 0: nothing is captured, the probe shows nothing.";
    if (diagnosis.state == PlanarState::kCaptured)
        return fmt::format("The camera is {:g} m in front of the mirror plane.", height);
    const std::string where = height < 0.0 ? fmt::format("{:g} m behind", -height) : std::string("on");
    return fmt::format("The camera is {} the mirror plane: nothing is captured, the probe shows nothing.", where);
}

} // namespace

PlanarDiagnosis diagnosePlanar(const CaseData& data, const Probe& probe)
{
    const PlanarCaptureSettings settings = makePlanarSettings(probe);
    PlanarDiagnosis diagnosis;
    diagnosis.nearestMetres = std::numeric_limits<double>::infinity();
    std::vector<const SurfacePoint*> outside, inside;
    for (size_t pixel = 0; pixel < data.surfaces().size(); ++pixel) {
        if (!data.tracedPixels()[pixel]) continue;
        const SurfacePoint& surface = data.surfaces()[pixel];
        const double distance = distanceToVolume(probe.influence, surface.positionWS);
        diagnosis.nearestMetres = std::min(diagnosis.nearestMetres, distance);
        (distance > 0.0 ? outside : inside).push_back(&surface);
    }
    diagnosis.insidePixels = inside.size();
    diagnosis.tracedPixels = inside.size() + outside.size();
    if (diagnosis.tracedPixels > 0) diagnosis.smallestDegrees = 180.0;
    for (const SurfacePoint* surface : inside.empty() ? outside : inside) {
        const double degrees = degreesBetween(surface->normalWS, settings.mirror.normalWS);
        diagnosis.smallestDegrees = std::min(diagnosis.smallestDegrees, degrees);
        diagnosis.largestDegrees = std::max(diagnosis.largestDegrees, degrees);
        const double off = glm::dot(surface->positionWS - settings.mirror.pointWS, settings.mirror.normalWS);
        diagnosis.farthestFromPlane = std::max(diagnosis.farthestFromPlane, std::abs(off));
    }
    const Camera& camera = data.testCase().camera;
    diagnosis.state = findPlanarState(camera, settings);
    diagnosis.cameraHeight =
        glm::dot(glm::dvec3(camera.worldFromView[3]) - settings.mirror.pointWS, settings.mirror.normalWS);
    return diagnosis;
}

std::vector<std::string> describeDiagnosis(const PlanarDiagnosis& diagnosis)
{
    std::vector<std::string> lines{describeInfluence(diagnosis)};
    if (diagnosis.tracedPixels > 0) lines.push_back(describePlane(diagnosis));
    lines.push_back(describeCamera(diagnosis));
    return lines;
}

} // namespace crossray
