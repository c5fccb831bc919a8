#include "harness/scene/truth.h"

#include "harness/base/error.h"
#include "harness/base/work_watch.h"
#include "harness/scene/camera_frame.h"
#include "harness/scene/refraction.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace crossray {

namespace {

// A camera ray and a traced ray end at the same point when their distances agree to this.
constexpr double kSamePoint = 1e-6;
// Metres after which a ray may meet something; of a torus, which may reflect itself, as a share of its radius.
constexpr double kOffSurface = 1e-9;
constexpr double kOffTorus = 1e-7;

class Tracer {
  public:
    Tracer(const Scene& scene, const Camera& camera, TraceEffect effect, ScreenLayer layer)
        : scene_(scene), frame_(camera), effect_(effect)
    {
        if (layer == ScreenLayer::kOpaque) opaque_ = makeOpaqueScene(scene);
        const std::string_view material = effect == TraceEffect::kReflection ? "mirror" : "glass";
        for (const Primitive& primitive : scene.primitives)
            traces_.push_back(primitive.material == material);
    }

    TruthPixel trace(int x, int y) const
    {
        TruthPixel pixel;
        const Ray primary = frame_.primaryRay({x + 0.5, y + 0.5});
        const std::optional<SurfaceHit> surface = castPrimaryRay(scene_, frame_, primary);
        if (!surface || !traces_[static_cast<size_t>(surface->primitive)]) return pixel;
        if (effect_ == TraceEffect::kReflection)
            reflect(pixel, primary, *surface);
        else
            refract(pixel, primary, *surface);
        return pixel;
    }

  private:
    void reflect(TruthPixel& pixel, const Ray& primary, const SurfaceHit& surface) const
    {
        pixel.rayOriginWS = surface.positionWS;
        pixel.rayDirWS = reflectDirection(primary.dirWS, surface.normalWS);
        // But for the torus all shapes are convex: from outside none of them reflects itself. From inside a solid does.
        const Primitive& mirror = scene_.primitives[static_cast<size_t>(surface.primitive)];
        const bool inside = surface.backFace && mirror.shape != PrimitiveShape::kPlane;
        const bool isTorus = mirror.shape == PrimitiveShape::kTorus;
        finish(pixel, inside || isTorus ? -1 : surface.primitive, isTorus ? kOffTorus * mirror.radius : kOffSurface);
    }

    void refract(TruthPixel& pixel, const Ray& primary, const SurfaceHit& surface) const
    {
        if (surface.backFace) return; // the camera is inside the glass
        const Primitive& solid = scene_.primitives[static_cast<size_t>(surface.primitive)];
        const auto path = refractThrough(solid, surface.positionWS, surface.normalWS, primary.dirWS);
        if (!path) {
            pixel.totalInternalReflection = true;
            return;
        }
        pixel.rayOriginWS = path->exitWS;
        pixel.rayDirWS = path->exitDirWS;
        pixel.pathLength = path->length;
        finish(pixel, surface.primitive, kOffSurface);
    }

    void finish(TruthPixel& pixel, int ignorePrimitive, double minDistance) const
    {
        const auto hit = castRay(scene_, {pixel.rayOriginWS, pixel.rayDirWS}, minDistance, kNoLimit, ignorePrimitive);
        if (!hit) {
            pixel.screen = ScreenKnowledge::kSky;
            pixel.radiance = computeSkyRadiance(scene_, pixel.rayDirWS);
            return;
        }
        pixel.hitPositionWS = hit->positionWS;
        pixel.radiance = computeRadiance(scene_, *hit);
        const ScreenPoint point = frame_.project(hit->positionWS);
        pixel.hitPositionSS = point.positionSS;
        pixel.hitLinearDepth = point.linearDepth;
        pixel.screen = classify(point, *hit);
    }

    ScreenKnowledge classify(const ScreenPoint& point, const SurfaceHit& hit) const
    {
        if (!frame_.covers(point)) return ScreenKnowledge::kOffScreen;
        const Ray view = frame_.primaryRay(point.positionSS);
        const bool sameSide = (glm::dot(view.dirWS, hit.normalWS) > 0.0) == hit.backFace;
        const double distance = glm::dot(hit.positionWS - view.originWS, view.dirWS);
        if (opaque_ && scene_.primitives[static_cast<size_t>(hit.primitive)].material == "glass")
            return ScreenKnowledge::kHidden;
        const std::optional<SurfaceHit> first = castPrimaryRay(opaque_ ? *opaque_ : scene_, frame_, view);
        const bool covered = first && first->distance < distance * (1.0 - kSamePoint);
        return sameSide && !covered ? ScreenKnowledge::kVisible : ScreenKnowledge::kHidden;
    }

    const Scene& scene_;
    CameraFrame frame_;
    TraceEffect effect_;
    std::optional<Scene> opaque_; // what the screen shows, where that is not all
    std::vector<bool> traces_;
};

} // namespace

std::string_view nameOf(ScreenKnowledge knowledge)
{
    static constexpr std::array<std::string_view, 5> kNames = {"no ray", "visible", "hidden", "off screen", "sky"};
    return kNames.at(static_cast<size_t>(knowledge));
}

Truth computeTruth(const Scene& scene, const Camera& camera, TraceEffect effect, ScreenLayer layer)
{
    validateCamera(camera);
    validateScene(scene);
    Truth truth;
    truth.width = camera.width;
    truth.height = camera.height;
    truth.pixels.reserve(static_cast<size_t>(camera.width) * static_cast<size_t>(camera.height));
    const Tracer tracer(scene, camera, effect, layer);
    for (int y = 0; y < camera.height; ++y) {
        noteWork(static_cast<size_t>(y), static_cast<size_t>(camera.height));
        for (int x = 0; x < camera.width; ++x)
            truth.pixels.push_back(tracer.trace(x, y));
    }
    return truth;
}

} // namespace crossray
