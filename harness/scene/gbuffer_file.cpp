#include "harness/base/error.h"
#include "harness/scene/camera_frame.h"
#include "harness/scene/exr.h"
#include "harness/scene/gbuffer.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace crossray {

namespace {

constexpr double kBlenderNoSurface = 1e10; // metres
constexpr std::array<GBufferChannel, 3> kDepthLike = {GBufferChannel::kLinearDepth, GBufferChannel::kDeviceDepth,
                                                      GBufferChannel::kPositionWS};

bool isDepthLike(GBufferChannel channel)
{
    return std::find(kDepthLike.begin(), kDepthLike.end(), channel) != kDepthLike.end();
}

class Reader {
  public:
    Reader(const std::filesystem::path& file, const Camera& camera, const ChannelMap& map)
        : file_(file), camera_(camera), frame_(camera), map_(map), stored_(readExrChannels(file))
    {
    }

    GBuffer read(std::span<const GBufferChannel> channels)
    {
        GBuffer gbuffer;
        gbuffer.camera = camera_;
        const Plane linearDepth = readLinearDepth(channels);
        for (const GBufferChannel channel : channels) {
            std::optional<Plane> plane = find(channel);
            if (!plane && isDepthLike(channel)) plane = derive(channel, linearDepth);
            if (!plane) failMissing(channel);
            clearWithoutSurface(channel, linearDepth, *plane);
            plane->name = nameOf(channel);
            gbuffer.planes.insert_or_assign(channel, std::move(*plane));
        }
        return gbuffer;
    }

  private:
    [[noreturn]] void fail(const std::string& what) const { throw InputError({file_.string(), 0, 0}, what); }

    [[noreturn]] void failMissing(GBufferChannel channel) const
    {
        const auto mapped = map_.find(channel);
        std::vector<std::string> present;
        for (const auto& [name, plane] : stored_)
            present.push_back(name);
        if (mapped == map_.end())
            fail(fmt::format("channel {} is not in the channel map and cannot be computed; allowed: names out of {}",
                             nameOf(channel), fmt::join(present, ", ")));
        fail(fmt::format("missing {} for {}; allowed: {}", fmt::join(mapped->second, ", "), nameOf(channel),
                         fmt::join(present, ", ")));
    }

    // The mapped channels as one plane; nothing when the map or the file has none of them.
    std::optional<Plane> find(GBufferChannel channel) const
    {
        const auto mapped = map_.find(channel);
        if (mapped == map_.end()) return std::nullopt;
        const auto& names = mapped->second;
        const size_t count = static_cast<size_t>(channelCount(channel));
        if (names.size() != count)
            fail(fmt::format("the channel map gives {} names for {}; allowed: {}", names.size(), nameOf(channel),
                             count));
        const auto found =
            std::count_if(names.begin(), names.end(), [&](const auto& name) { return stored_.contains(name); });
        if (found == 0) return std::nullopt;
        if (static_cast<size_t>(found) != count) failMissing(channel);
        Plane plane(std::string(nameOf(channel)), camera_.width, camera_.height, channelCount(channel));
        for (size_t c = 0; c < count; ++c) {
            const Plane& source = stored_.at(names[c]);
            if (source.width != camera_.width || source.height != camera_.height)
                fail(fmt::format("{} is {}x{}; allowed: the camera's {}x{}", names[c], source.width, source.height,
                                 camera_.width, camera_.height));
            for (size_t i = 0; i < source.values.size(); ++i)
                plane.values[i * count + c] = source.values[i];
        }
        return plane;
    }

    // Linear depth, 0 without a surface, from the first of the three that the file has.
    Plane readLinearDepth(std::span<const GBufferChannel> wanted) const
    {
        for (const GBufferChannel source : kDepthLike)
            if (const std::optional<Plane> plane = find(source)) return toLinearDepth(source, *plane);
        for (const GBufferChannel channel : wanted)
            if (isDepthLike(channel)) failMissing(GBufferChannel::kLinearDepth);
        return {}; // nobody asks: then no pixel is known to lack a surface
    }

    Plane toLinearDepth(GBufferChannel source, const Plane& plane) const
    {
        Plane result("LinearDepth", camera_.width, camera_.height, 1);
        for (int y = 0; y < camera_.height; ++y)
            for (int x = 0; x < camera_.width; ++x) {
                double value = plane.at(x, y);
                if (source == GBufferChannel::kPositionWS) {
                    const glm::dvec3 position(plane.at(x, y, 0), plane.at(x, y, 1), plane.at(x, y, 2));
                    if (position == glm::dvec3(0.0)) continue; // no surface
                    value = frame_.linearDepth(position);
                }
                if (!(value >= 0.0))
                    fail(fmt::format("{} is {} at ({}, {}); allowed: a depth of 0 and more", nameOf(source), value, x,
                                     y));
                if (source == GBufferChannel::kDeviceDepth)
                    value = value == clearedDeviceDepth(camera_) ? 0.0 : computeLinearDepth(camera_, value);
                result.at(x, y) = value >= kBlenderNoSurface ? 0.0 : value;
            }
        return result;
    }

    Plane derive(GBufferChannel channel, const Plane& linearDepth) const
    {
        if (channel == GBufferChannel::kLinearDepth) return linearDepth;
        Plane plane(std::string(nameOf(channel)), camera_.width, camera_.height, channelCount(channel));
        for (int y = 0; y < camera_.height; ++y)
            for (int x = 0; x < camera_.width; ++x) {
                const double depth = linearDepth.at(x, y);
                if (channel == GBufferChannel::kDeviceDepth) {
                    plane.at(x, y) = glm::clamp(computeDeviceDepth(camera_, depth), 0.0, 1.0);
                    continue;
                }
                const glm::dvec3 position = frame_.unproject({x + 0.5, y + 0.5}, depth);
                for (int c = 0; c < 3; ++c)
                    plane.at(x, y, c) = position[c];
            }
        return plane;
    }

    void clearWithoutSurface(GBufferChannel channel, const Plane& linearDepth, Plane& plane) const
    {
        if (channel == GBufferChannel::kColor || linearDepth.values.empty()) return; // the sky has a colour
        const double none = channel == GBufferChannel::kDeviceDepth ? clearedDeviceDepth(camera_) : 0.0;
        const size_t count = static_cast<size_t>(plane.channels);
        for (size_t i = 0; i < linearDepth.values.size(); ++i)
            if (linearDepth.values[i] == 0.0)
                std::fill_n(plane.values.begin() + static_cast<std::ptrdiff_t>(i * count), count, none);
    }

    const std::filesystem::path& file_;
    const Camera& camera_;
    CameraFrame frame_;
    const ChannelMap& map_;
    std::map<std::string, Plane> stored_;
};

} // namespace

ChannelMap blenderChannelMap()
{
    return {{GBufferChannel::kLinearDepth, {"ViewLayer.Depth.Z"}},
            {GBufferChannel::kNormalWS, {"ViewLayer.Normal.X", "ViewLayer.Normal.Y", "ViewLayer.Normal.Z"}},
            {GBufferChannel::kPositionWS, {"ViewLayer.Position.X", "ViewLayer.Position.Y", "ViewLayer.Position.Z"}},
            {GBufferChannel::kColor, {"ViewLayer.Combined.R", "ViewLayer.Combined.G", "ViewLayer.Combined.B"}},
            {GBufferChannel::kObjectIndex, {"ViewLayer.IndexOB.X"}}};
}

ChannelMap crossrayChannelMap()
{
    ChannelMap map;
    for (const GBufferChannel channel :
         {GBufferChannel::kDeviceDepth, GBufferChannel::kLinearDepth, GBufferChannel::kNormalWS,
          GBufferChannel::kPositionWS, GBufferChannel::kColor, GBufferChannel::kObjectIndex}) {
        const std::string part(nameOf(channel));
        if (channelCount(channel) == 1)
            map[channel] = {part + ".Y"};
        else
            map[channel] = {part + ".R", part + ".G", part + ".B"};
    }
    return map;
}

GBuffer readGBuffer(const std::filesystem::path& file, const Camera& camera, const ChannelMap& map,
                    std::span<const GBufferChannel> channels)
{
    validateCamera(camera);
    return Reader(file, camera, map).read(channels);
}

void writeGBuffer(const std::filesystem::path& file, const GBuffer& gbuffer)
{
    std::vector<Plane> planes;
    for (const auto& [channel, plane] : gbuffer.planes) {
        planes.push_back(plane);
        planes.back().name = nameOf(channel);
    }
    writeExr(file, planes);
}

} // namespace crossray
