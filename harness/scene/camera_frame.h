// A camera prepared for loops over pixels: its axes and half size are computed once. The free functions of camera.h are
// this with a frame made for each call.
#pragma once

#include "harness/scene/camera.h"
#include "harness/scene/scene.h"

#include <cmath>
#include <optional>

namespace crossray {

// Half width and half height of the image: metres (orthographic), or metres at a linear depth of 1 m (perspective).
glm::dvec2 computeHalfSize(const Camera& camera);

class CameraFrame {
  public:
    explicit CameraFrame(const Camera& camera)
        : camera_(camera), right_(camera.worldFromView[0]), up_(camera.worldFromView[1]),
          back_(camera.worldFromView[2]), eye_(camera.worldFromView[3]), halfSize_(computeHalfSize(camera)),
          perspective_(camera.projection == ProjectionKind::kPerspective)
    {
    }

    const Camera& camera() const { return camera_; }
    const glm::dvec3& forwardWS() const { return forward_; }

    Ray primaryRay(const glm::dvec2& positionSS) const
    {
        const glm::dvec3 across = offset(positionSS);
        if (perspective_) return {eye_, glm::normalize(across - back_)};
        return {eye_ + across, forward_};
    }

    glm::dvec3 unproject(const glm::dvec2& positionSS, double linearDepth) const
    {
        const glm::dvec3 across = offset(positionSS);
        if (perspective_) return eye_ + linearDepth * (across - back_);
        return eye_ + across + linearDepth * forward_;
    }

    double linearDepth(const glm::dvec3& positionWS) const { return glm::dot(positionWS - eye_, forward_); }

    ScreenPoint project(const glm::dvec3& positionWS) const
    {
        const glm::dvec3 fromEye = positionWS - eye_;
        ScreenPoint point;
        point.linearDepth = glm::dot(fromEye, forward_);
        point.inFront = point.linearDepth > 0.0;
        if (!point.inFront) return point;
        const double w = perspective_ ? point.linearDepth : 1.0;
        const double ndcX = glm::dot(fromEye, right_) / (w * halfSize_.x);
        const double ndcY = glm::dot(fromEye, up_) / (w * halfSize_.y);
        point.positionSS = {(0.5 + 0.5 * ndcX) * camera_.width, (0.5 - 0.5 * ndcY) * camera_.height};
        point.deviceDepth = computeDeviceDepth(camera_, point.linearDepth);
        point.onScreen = std::abs(ndcX) <= 1.0 && std::abs(ndcY) <= 1.0;
        return point;
    }

    // Inside the image and between the near and the far plane: where a depth buffer could hold the point.
    bool covers(const ScreenPoint& point) const
    {
        return point.onScreen && point.linearDepth >= camera_.nearDistance &&
               (camera_.depthConvention == DepthConvention::kInfiniteReversed ||
                point.linearDepth <= camera_.farDistance);
    }

  private:
    // From the view axis to the image point: metres (orthographic), or metres at a linear depth of 1 m (perspective).
    glm::dvec3 offset(const glm::dvec2& positionSS) const
    {
        const double ndcX = 2.0 * positionSS.x / camera_.width - 1.0;
        const double ndcY = 1.0 - 2.0 * positionSS.y / camera_.height;
        return (ndcX * halfSize_.x) * right_ + (ndcY * halfSize_.y) * up_;
    }

    Camera camera_;
    glm::dvec3 right_, up_, back_, eye_;
    glm::dvec3 forward_ = -back_;
    glm::dvec2 halfSize_;
    bool perspective_;
};

// Nearest surface between the near and the far plane, both included: what the depth buffer would show along this
// primary ray.
std::optional<SurfaceHit> castPrimaryRay(const Scene& scene, const CameraFrame& frame, const Ray& ray);

} // namespace crossray
