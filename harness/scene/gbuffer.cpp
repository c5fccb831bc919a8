#include "harness/scene/gbuffer.h"

#include "harness/base/error.h"
#include "harness/base/work_watch.h"
#include "harness/scene/camera_frame.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace crossray {

namespace {

struct ChannelInfo {
    std::string_view name;
    int channels;
};

constexpr std::array<ChannelInfo, 6> kChannelInfo = {
    {{"DeviceDepth", 1}, {"LinearDepth", 1}, {"NormalWS", 3}, {"PositionWS", 3}, {"Color", 3}, {"ObjectIndex", 1}}};

const ChannelInfo& infoOf(GBufferChannel channel)
{
    return kChannelInfo.at(static_cast<size_t>(channel));
}

// Where each channel's values go; null where the channel was not asked for.
struct Targets {
    std::array<double*, kChannelInfo.size()> values{};
    double* of(GBufferChannel channel) const { return values[static_cast<size_t>(channel)]; }
};

void store(double* target, size_t pixel, double value)
{
    if (target != nullptr) target[pixel] = value;
}

void store(double* target, size_t pixel, const glm::dvec3& value)
{
    if (target == nullptr) return;
    for (int c = 0; c < 3; ++c)
        target[3 * pixel + static_cast<size_t>(c)] = value[c];
}

void storePixel(const Targets& targets, size_t pixel, const Scene& scene, const CameraFrame& frame, const Ray& ray,
                const std::optional<SurfaceHit>& hit)
{
    double* color = targets.of(GBufferChannel::kColor);
    if (!hit) { // everything else holds its "no surface" value already
        if (color != nullptr) store(color, pixel, computeSkyRadiance(scene, ray.dirWS));
        return;
    }
    const double linearDepth = frame.linearDepth(hit->positionWS);
    store(targets.of(GBufferChannel::kLinearDepth), pixel, linearDepth);
    store(targets.of(GBufferChannel::kDeviceDepth), pixel,
          roundDeviceDepth(frame.camera(), glm::clamp(computeDeviceDepth(frame.camera(), linearDepth), 0.0, 1.0)));
    store(targets.of(GBufferChannel::kNormalWS), pixel, hit->backFace ? -hit->normalWS : hit->normalWS);
    store(targets.of(GBufferChannel::kPositionWS), pixel, hit->positionWS);
    store(targets.of(GBufferChannel::kObjectIndex), pixel, static_cast<double>(objectIndexOf(scene, hit->primitive)));
    if (color != nullptr) store(color, pixel, computeRadiance(scene, *hit));
}

} // namespace

std::string_view nameOf(GBufferChannel channel)
{
    return infoOf(channel).name;
}

int channelCount(GBufferChannel channel)
{
    return infoOf(channel).channels;
}

const Plane& GBuffer::plane(GBufferChannel channel) const
{
    const auto found = planes.find(channel);
    if (found == planes.end())
        throw InputError(
            fmt::format("the G-buffer has no channel {}; allowed: one that was asked for", nameOf(channel)));
    return found->second;
}

std::optional<SurfaceHit> castPrimaryRay(const Scene& scene, const CameraFrame& frame, const Ray& ray)
{
    // A surface exactly on the near or far plane belongs to the image, whichever way its distance rounds.
    constexpr double kSlack = 1e-12;
    const Camera& camera = frame.camera();
    const double cosine = glm::dot(ray.dirWS, frame.forwardWS());
    const double farDistance =
        camera.depthConvention == DepthConvention::kInfiniteReversed ? kNoLimit : camera.farDistance * (1.0 + kSlack);
    return castRay(scene, ray, camera.nearDistance * (1.0 - kSlack) / cosine, farDistance / cosine);
}

GBuffer renderGBuffer(const Scene& scene, const Camera& camera, std::span<const GBufferChannel> channels)
{
    validateCamera(camera);
    validateScene(scene);
    GBuffer gbuffer;
    gbuffer.camera = camera;
    Targets targets;
    for (const GBufferChannel channel : channels) {
        const double none = channel == GBufferChannel::kDeviceDepth ? clearedDeviceDepth(camera) : 0.0;
        Plane& plane = gbuffer.planes
                           .insert_or_assign(channel, Plane(std::string(nameOf(channel)), camera.width, camera.height,
                                                            channelCount(channel), none))
                           .first->second;
        targets.values[static_cast<size_t>(channel)] = plane.values.data();
    }
    const CameraFrame frame(camera);
    size_t pixel = 0;
    for (int y = 0; y < camera.height; ++y) {
        noteWork(static_cast<size_t>(y), static_cast<size_t>(camera.height));
        for (int x = 0; x < camera.width; ++x, ++pixel) {
            const Ray ray = frame.primaryRay({x + 0.5, y + 0.5});
            storePixel(targets, pixel, scene, frame, ray, castPrimaryRay(scene, frame, ray));
        }
    }
    return gbuffer;
}

} // namespace crossray
