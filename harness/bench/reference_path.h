// What the yardstick's reference tracers share: a depth buffer in metres, and a ray's way over the screen.
#pragma once

#include "harness/bench/tracer_yardstick.h"

#include "harness/scene/camera_frame.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace crossray {

class DepthImage {
  public:
    explicit DepthImage(const YardstickScene& scene)
        : frame_(scene.gbuffer.camera), width_(scene.gbuffer.camera.width), height_(scene.gbuffer.camera.height),
          normals_(&scene.gbuffer.plane(GBufferChannel::kNormalWS))
    {
        const Camera& camera = scene.gbuffer.camera;
        const double cleared = clearedDeviceDepth(camera);
        for (const double depth : scene.gbuffer.plane(GBufferChannel::kDeviceDepth).values)
            depths_.push_back(depth == cleared ? kNoLimit : computeLinearDepth(camera, depth));
    }
    const CameraFrame& frame() const { return frame_; }
    int width() const { return width_; }
    int height() const { return height_; }
    bool contains(int x, int y) const { return x >= 0 && y >= 0 && x < width_ && y < height_; }
    // Metres; infinite where there is no surface.
    double depth(int x, int y) const
    {
        return depths_[static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x)];
    }
    double depthAt(const glm::dvec2& positionSS) const
    {
        return depth(std::clamp(static_cast<int>(positionSS.x), 0, width_ - 1),
                     std::clamp(static_cast<int>(positionSS.y), 0, height_ - 1));
    }
    glm::dvec3 normalWS(int x, int y) const
    {
        return {normals_->at(x, y, 0), normals_->at(x, y, 1), normals_->at(x, y, 2)};
    }

  private:
    CameraFrame frame_;
    int width_, height_;
    std::vector<double> depths_;
    const Plane* normals_;
};

// From the surface at a pixel's centre to the near or the far plane: startSS + t * deltaSS for t in [0, 1]. Affine
// depth (project/screen_ray.glsl has the same idea): 1/depth, or -depth in orthographic views.
struct ScreenPath {
    bool exists = false;
    bool isOrthographic = false;
    glm::dvec2 startSS{0.0}, deltaSS{0.0};
    double startAffine = 0, deltaAffine = 0;
    double end = 0; // t where it leaves the image, at most 1

    glm::dvec2 positionSS(double t) const { return startSS + t * deltaSS; }
    double depth(double t) const
    {
        const double affine = startAffine + t * deltaAffine;
        return isOrthographic ? -affine : 1 / affine;
    }
    // t at which it is so deep.
    double timeOfDepth(double linearDepth) const
    {
        return ((isOrthographic ? -linearDepth : 1 / linearDepth) - startAffine) / deltaAffine;
    }
    double pixels() const { return std::max(std::abs(deltaSS.x), std::abs(deltaSS.y)) * end; }
};
ScreenPath makeScreenPath(const DepthImage& image, const YardstickRay& ray);

TracerAnswer makeHit(const ScreenPath& path, double t, int fetches, int iterations);
TracerAnswer makeNoHit(int fetches, int iterations, bool isCapped = false);

// Uludag's march over the nearest depths alone, as FidelityFX SSSR describes it.
TracerMethod closestDepthTracer(double thickness, int maxIterations);

} // namespace crossray
