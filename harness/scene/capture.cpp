#include "harness/scene/capture.h"

#include "harness/base/error.h"
#include "harness/scene/refraction.h"

#include <fmt/format.h>

namespace crossray {

namespace {

class CubeCapture {
  public:
    CubeCapture(const Scene& scene, const CaptureSettings& settings)
        : scene_(makeOpaqueScene(scene)), settings_(settings)
    {
    }

    // `last`: what mirrors show; null: nothing.
    Cubemap capture(const Cubemap* last) const
    {
        Cubemap cubemap(settings_.size, 1);
        for (int face = 0; face < kCubeFaces; ++face) {
            if (settings_.face && *settings_.face != face) continue;
            for (int y = 0; y < settings_.size; ++y)
                for (int x = 0; x < settings_.size; ++x) {
                    const glm::dvec2 center = glm::dvec2(x + 0.5, y + 0.5) / static_cast<double>(settings_.size);
                    cubemap.at(0, face, x, y) = look(computeCubeDirection(face, center), last);
                }
        }
        return cubemap;
    }

  private:
    glm::dvec3 look(const glm::dvec3& dirWS, const Cubemap* last) const
    {
        const auto hit = castRay(scene_, {settings_.positionWS, dirWS});
        if (!hit) return computeSkyRadiance(scene_, dirWS);
        const glm::dvec3 own = computeRadiance(scene_, *hit);
        const bool isMirror = scene_.primitives[static_cast<size_t>(hit->primitive)].material == "mirror";
        if (!isMirror || !settings_.bounces) return own;
        if (last == nullptr) return glm::dvec3(0.0);
        return own * nearestTexel(*last, findLookUp(hit->positionWS, reflectDirection(dirWS, hit->normalWS)));
    }

    // Where the last capture shows what a reflected ray meets, as seen from the capture position.
    glm::dvec3 findLookUp(const glm::dvec3& fromWS, const glm::dvec3& dirWS) const
    {
        if (!settings_.proxy) return dirWS;
        const auto crossings = intersectPrimitive(*settings_.proxy, {fromWS, dirWS});
        if (crossings.empty() || crossings.back().distance <= 0.0) return dirWS; // it does not meet the proxy
        const glm::dvec3 towards = crossings.back().positionWS - settings_.positionWS;
        return glm::length(towards) > 0.0 ? towards : dirWS;
    }

    Scene scene_; // what is opaque
    const CaptureSettings& settings_;
};

void requireSettings(const CaptureSettings& settings)
{
    requireCubeSize(settings.size);
    if (settings.face && (*settings.face < 0 || *settings.face >= kCubeFaces))
        throw InputError(fmt::format("capture: face {}; allowed: 0 to {}", *settings.face, kCubeFaces - 1));
    if (settings.bounces && (*settings.bounces < 0 || *settings.bounces > kMaxBounces))
        throw InputError(fmt::format("capture: {} bounces; allowed: 0 to {}", *settings.bounces, kMaxBounces));
    if (settings.proxy && settings.proxy->shape == PrimitiveShape::kPlane)
        throw InputError("capture: a plane as the proxy; allowed: a box or a sphere");
}

} // namespace

Cubemap captureCubemap(const Scene& scene, const CaptureSettings& settings)
{
    validateScene(scene);
    requireSettings(settings);
    const CubeCapture camera(scene, settings);
    Cubemap cubemap = camera.capture(nullptr);
    for (int bounce = 0; bounce < settings.bounces.value_or(0); ++bounce)
        cubemap = camera.capture(&cubemap);
    buildMipLevels(cubemap);
    return cubemap;
}

} // namespace crossray
