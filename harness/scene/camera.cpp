#include "harness/scene/camera.h"

#include "harness/base/error.h"
#include "harness/scene/camera_frame.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace crossray {

namespace {

constexpr int kMaxImageSide = 16384;
constexpr double kRigidTolerance = 1e-6;

// Linear part of clip z in the [0,1] range: clipZ = scale * linearDepth + offset.
struct DepthRow {
    double scale;
    double offset;
};

DepthRow makeDepthRow(const Camera& camera)
{
    const double nearD = camera.nearDistance;
    const double farD = camera.farDistance;
    const double range = farD - nearD;
    if (camera.projection == ProjectionKind::kOrthographic) {
        if (camera.depthConvention == DepthConvention::kStandard) return {1.0 / range, -nearD / range};
        return {-1.0 / range, farD / range};
    }
    switch (camera.depthConvention) {
    case DepthConvention::kStandard:
        return {farD / range, -farD * nearD / range};
    case DepthConvention::kReversed:
        return {-nearD / range, nearD * farD / range};
    case DepthConvention::kInfiniteReversed:
        break;
    }
    return {0.0, nearD};
}

void requireRange(const char* what, double value, double low, double high, const char* allowed)
{
    if (!std::isfinite(value) || value <= low || value >= high)
        throw InputError(fmt::format("camera: {} is {}; allowed: {}", what, value, allowed));
}

void requireRigid(const glm::dmat4& worldFromView)
{
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!std::isfinite(worldFromView[column][row]))
                throw InputError(
                    "camera: its world matrix holds a NaN or an infinity; allowed: a rotation and a position");
    const glm::dmat3 rotation(worldFromView);
    const glm::dmat3 residue = glm::transpose(rotation) * rotation - glm::dmat3(1.0);
    double worst = 0.0;
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            worst = std::max(worst, std::abs(residue[column][row]));
    const bool lastRow = worldFromView[0][3] == 0.0 && worldFromView[1][3] == 0.0 && worldFromView[2][3] == 0.0 &&
                         worldFromView[3][3] == 1.0;
    if (worst > kRigidTolerance || glm::determinant(rotation) < 0.0 || !lastRow)
        throw InputError("camera: its world matrix is not rigid; allowed: a rotation (no scale, no mirror image) and a "
                         "position, last row 0 0 0 1");
}

} // namespace

glm::dmat4 makeLookAt(const glm::dvec3& eyeWS, const glm::dvec3& targetWS, const glm::dvec3& upWS)
{
    const glm::dvec3 away = eyeWS - targetWS;
    const double distance = glm::length(away);
    if (!std::isfinite(distance) || distance == 0.0)
        throw InputError("camera: the eye is the target; allowed: two different finite points");
    const glm::dvec3 backWS = away / distance;
    const glm::dvec3 side = glm::cross(upWS, backWS);
    const double sideLength = glm::length(side);
    if (!(sideLength > 1e-9 * glm::length(upWS)))
        throw InputError("camera: the view is parallel to the up direction; allowed: any other up");
    const glm::dvec3 rightWS = side / sideLength;
    return glm::dmat4(glm::dvec4(rightWS, 0.0), glm::dvec4(glm::cross(backWS, rightWS), 0.0), glm::dvec4(backWS, 0.0),
                      glm::dvec4(eyeWS, 1.0));
}

glm::dmat4 computeViewFromWorld(const Camera& camera)
{
    const glm::dmat3 viewFromWorld = glm::transpose(glm::dmat3(camera.worldFromView));
    glm::dmat4 result(viewFromWorld);
    result[3] = glm::dvec4(-(viewFromWorld * glm::dvec3(camera.worldFromView[3])), 1.0);
    return result;
}

glm::dmat4 computeClipFromView(const Camera& camera)
{
    const bool perspective = camera.projection == ProjectionKind::kPerspective;
    const glm::dvec2 halfSize = computeHalfSize(camera);
    const DepthRow depth = makeDepthRow(camera);
    // Written for linear depth = -z of view space; w is the linear depth (perspective) or 1.
    const double wScale = perspective ? 1.0 : 0.0;
    const double wOffset = perspective ? 0.0 : 1.0;
    double zScale = depth.scale;
    double zOffset = depth.offset;
    if (camera.ndcDepthRange == NdcDepthRange::kMinusOneToOne) {
        zScale = 2.0 * zScale - wScale;
        zOffset = 2.0 * zOffset - wOffset;
    }
    glm::dmat4 clip(0.0);
    clip[0][0] = 1.0 / halfSize.x;
    clip[1][1] = 1.0 / halfSize.y;
    clip[2][2] = -zScale;
    clip[3][2] = zOffset;
    clip[2][3] = -wScale;
    clip[3][3] = wOffset;
    return clip;
}

glm::dvec2 computeHalfSize(const Camera& camera)
{
    const double halfHeight = camera.projection == ProjectionKind::kPerspective
                                  ? std::tan(camera.fovYDegrees * std::numbers::pi / 360.0)
                                  : 0.5 * camera.orthographicHeight;
    return {halfHeight * camera.width / camera.height, halfHeight};
}

Ray computePrimaryRay(const Camera& camera, const glm::dvec2& positionSS)
{
    return CameraFrame(camera).primaryRay(positionSS);
}

ScreenPoint projectToScreen(const Camera& camera, const glm::dvec3& positionWS)
{
    return CameraFrame(camera).project(positionWS);
}

glm::dvec3 unprojectFromScreen(const Camera& camera, const glm::dvec2& positionSS, double linearDepth)
{
    return CameraFrame(camera).unproject(positionSS, linearDepth);
}

double computeDeviceDepth(const Camera& camera, double linearDepth)
{
    const double nearD = camera.nearDistance;
    const double farD = camera.farDistance;
    const double range = farD - nearD;
    // Factored so that the near plane and the far plane give exactly 0 and 1, whatever their ratio.
    if (camera.projection == ProjectionKind::kOrthographic) {
        if (camera.depthConvention == DepthConvention::kStandard) return (linearDepth - nearD) / range;
        return (farD - linearDepth) / range;
    }
    switch (camera.depthConvention) {
    case DepthConvention::kStandard:
        return ((linearDepth - nearD) / range) * (farD / linearDepth);
    case DepthConvention::kReversed:
        return ((farD - linearDepth) / range) * (nearD / linearDepth);
    case DepthConvention::kInfiniteReversed:
        break;
    }
    return nearD / linearDepth;
}

double computeLinearDepth(const Camera& camera, double deviceDepth)
{
    const double nearD = camera.nearDistance;
    const double farD = camera.farDistance;
    const double range = farD - nearD;
    if (camera.projection == ProjectionKind::kOrthographic) {
        if (camera.depthConvention == DepthConvention::kStandard) return nearD + deviceDepth * range;
        return farD - deviceDepth * range;
    }
    switch (camera.depthConvention) {
    // (1 - d) loses nothing for d in [0.5, 1], where a standard depth buffer holds nearly everything.
    case DepthConvention::kStandard:
        return nearD * farD / ((1.0 - deviceDepth) * range + nearD);
    case DepthConvention::kReversed:
        return nearD * farD / (deviceDepth * range + nearD);
    case DepthConvention::kInfiniteReversed:
        break;
    }
    return nearD / deviceDepth;
}

namespace {

// Whole numbers that the format has above 0.
double stepsOf(DepthFormat format)
{
    return format == DepthFormat::kUnorm16 ? 65535.0 : 16777215.0;
}

// Largest distance between two neighbouring floats in [0.5, 1], where a standard depth's far half lies.
constexpr double kFloatStep = 0x1p-24;

} // namespace

double roundDeviceDepth(const Camera& camera, double deviceDepth)
{
    if (camera.depthFormat == DepthFormat::kFloat32) return deviceDepth;
    const double steps = stepsOf(camera.depthFormat);
    return std::round(deviceDepth * steps) / steps;
}

double computeAffineDepthError(const Camera& camera)
{
    const bool isFloat = camera.depthFormat == DepthFormat::kFloat32;
    if (isFloat && camera.depthConvention != DepthConvention::kStandard) return 0.0;
    const double first = camera.nearDistance, second = 2 * camera.nearDistance;
    const bool isOrthographic = camera.projection == ProjectionKind::kOrthographic;
    const double affine = isOrthographic ? second - first : 1 / first - 1 / second;
    const double device = std::abs(computeDeviceDepth(camera, first) - computeDeviceDepth(camera, second));
    return 0.5 * (isFloat ? kFloatStep : 1 / stepsOf(camera.depthFormat)) * affine / device;
}

double clearedDeviceDepth(const Camera& camera)
{
    return camera.depthConvention == DepthConvention::kStandard ? 1.0 : 0.0;
}

void validateCamera(const Camera& camera)
{
    if (camera.width < 1 || camera.height < 1 || camera.width > kMaxImageSide || camera.height > kMaxImageSide)
        throw InputError(fmt::format("camera: the image is {}x{}; allowed: 1 to {} pixels a side", camera.width,
                                     camera.height, kMaxImageSide));
    requireRigid(camera.worldFromView);
    const double huge = std::numeric_limits<double>::infinity();
    if (camera.projection == ProjectionKind::kPerspective) {
        requireRange("the vertical field of view", camera.fovYDegrees, 0.0, 180.0, "degrees in (0, 180)");
    } else {
        requireRange("the orthographic height", camera.orthographicHeight, 0.0, huge, "metres above 0");
        if (camera.depthConvention == DepthConvention::kInfiniteReversed)
            throw InputError("camera: an orthographic depth buffer cannot be infinite; allowed: standard or reversed");
    }
    requireRange("near", camera.nearDistance, 0.0, huge, "metres above 0");
    if (camera.depthConvention != DepthConvention::kInfiniteReversed)
        requireRange("far", camera.farDistance, camera.nearDistance, huge, "metres beyond near");
}

} // namespace crossray
