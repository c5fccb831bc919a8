#include "harness/pass/probe_params.h"

#include "harness/base/error.h"
#include "harness/pass/object_bounds.h"
#include "harness/pass/params.h"

#include <fmt/format.h>

#include <algorithm>

namespace crossray {

namespace {

// Rows that a cubemap takes in the atlas: 2 size - 1, for sizes that are powers of two.
int rowsOf(const Cubemap& cubemap)
{
    return 2 * cubemap.size - 1;
}

template <class Params>
class ProbeParamsFiller {
  public:
    explicit ProbeParamsFiller(const CaseData& data) : data_(data), testCase_(data.testCase()) {}

    Params fill()
    {
        const SkySettings& sky = testCase_.sky;
        params_.skyZenith = vector(sky.gradient.zenith, 0.0);
        params_.skyHorizon = vector(sky.gradient.horizon, 0.0);
        params_.skyNadir = vector(sky.gradient.nadir, 0.0);
        params_.skyUpWS = vector(testCase_.scene.upWS, 0.0);
        params_.settings = {0, static_cast<int>(testCase_.dominantDirection), 0, 0};
        int row = 0;
        const std::vector<Cubemap>& cubemaps = data_.environments();
        std::vector<int> rows;
        for (const Cubemap& cubemap : cubemaps) {
            rows.push_back(row);
            row += rowsOf(cubemap);
        }
        const auto placeOf = [&](size_t cubemap) {
            return glm::ivec4(rows[cubemap], cubemaps[cubemap].size, cubemaps[cubemap].levelCount(), 0);
        };
        std::vector<size_t> order = orderProbes(testCase_);
        const auto planar = std::stable_partition(order.begin(), order.end(), [&](size_t probe) {
            return testCase_.probes[probe].kind == ProbeKind::kReflection;
        });
        params_.settings.x = static_cast<int>(planar - order.begin()); // planar ones follow: pass/planar_tier.glsl
        for (size_t place = 0; place < order.size(); ++place) {
            fillItem(params_.items[place], testCase_.probes[order[place]], static_cast<int>(order[place]));
            params_.cubemaps[place] = placeOf(order[place]);
        }
        if (testCase_.probeProfile != ProbeProfile::kHdrp) fillProfile();
        if (cubemaps.size() > testCase_.probes.size()) params_.cubemaps[kMaxProbes] = placeOf(testCase_.probes.size());
        return params_;
    }

  private:
    using Vec4 = decltype(Params::skyZenith);
    using Item = std::remove_all_extents_t<decltype(Params::items)>;
    using Mat4 = decltype(Item::worldFromProxy);

    static Vec4 vector(const glm::dvec3& xyz, double w) { return Vec4(glm::dvec4(xyz, w)); }

    static void fillItem(Item& item, const Probe& probe, int number)
    {
        item.worldFromInfluence = Mat4(glm::dmat4(probe.influence.worldFromVolume));
        item.worldFromProxy = Mat4(glm::dmat4(probe.proxy.worldFromVolume));
        item.kind = {static_cast<int>(probe.influence.shape), static_cast<int>(probe.proxy.shape), number,
                     probe.distanceBasedRoughness ? 1 : 0};
        item.influenceCenterWS = vector(probe.influence.center, probe.weight);
        item.influenceExtents = vector(probe.influence.halfExtents, probe.multiplier);
        item.blendPositive = vector(probe.blend.positive, 0.0);
        item.blendNegative = vector(probe.blend.negative, 0.0);
        item.blendNormalPositive = vector(probe.blendNormal.positive, 0.0);
        item.blendNormalNegative = vector(probe.blendNormal.negative, 0.0);
        item.facePositive = vector(probe.facePositive, 0.0);
        item.faceNegative = vector(probe.faceNegative, 0.0);
        item.proxyCenterWS = vector(probe.proxy.center, probe.minProjectionDistance);
        item.proxyExtents = vector(probe.proxy.halfExtents, 0.0);
        item.capturePositionWS = vector(probe.capturePosition, 0.0);
    }

    // What the profiles read that know boxes along the axes of the world.
    void fillProfile()
    {
        const ObjectBounds object = findObjectBounds(testCase_);
        params_.objectMinWS = vector(object.minWS, 0.0);
        params_.objectMaxWS = vector(object.maxWS, 0.0);
        for (size_t place = 0; place < testCase_.probes.size(); ++place) {
            const Probe& probe = testCase_.probes[place];
            const RgbmDecoding rgbm = probe.rgbm.value_or(RgbmDecoding{});
            const ObjectBounds box{probe.influence.center - probe.influence.halfExtents,
                                   probe.influence.center + probe.influence.halfExtents};
            Item& item = params_.items[place];
            item.boxMinWS = vector(box.minWS, probe.blend.positive.x);
            item.boxMaxWS = vector(box.maxWS, static_cast<double>(probe.importance));
            item.lookUp = Vec4(glm::dvec4(measureCoveredArea(object, box), probe.boxProjection ? 1.0 : 0.0,
                                          probe.rgbm ? 1.0 : 0.0, rgbm.alpha));
            item.decode = Vec4(glm::dvec4(rgbm.range, rgbm.exponent, 0.0, rgbm.alphaWeight));
        }
    }

    const CaseData& data_;
    const Case& testCase_;
    Params params_{};
};

void copyCubemap(const Cubemap& cubemap, int row, ImageDesc& atlas)
{
    for (int level = 0; level < cubemap.levelCount(); ++level) {
        const int size = cubemap.sizeOf(level);
        for (int face = 0; face < kCubeFaces; ++face) {
            for (int y = 0; y < size; ++y) {
                for (int x = 0; x < size; ++x) {
                    const auto texel = static_cast<size_t>(row + y) * static_cast<size_t>(atlas.width) +
                                       static_cast<size_t>(face * size + x);
                    const glm::dvec3& color = cubemap.at(level, face, x, y);
                    for (int channel = 0; channel < 3; ++channel)
                        atlas.texels[texel * 4 + static_cast<size_t>(channel)] = color[channel];
                }
            }
        }
        row += size;
    }
}

} // namespace

bool usesProbes(const Case& testCase)
{
    return testCase.hierarchy != 0 || testCase.projection.model == ProjectionModel::kProxyProbe;
}

std::vector<std::byte> makeProbeParams(const CaseData& data, Precision precision)
{
    return precision == Precision::kFloat ? bytesOf(ProbeParamsFiller<layout32::ProbeParams>(data).fill())
                                          : bytesOf(ProbeParamsFiller<layout64::ProbeParams>(data).fill());
}

ImageDesc makeProbeAtlas(const CaseData& data)
{
    int side = 1, rows = 1;
    for (const Cubemap& cubemap : data.environments()) {
        side = std::max(side, cubemap.size);
        rows += rowsOf(cubemap);
    }
    if (rows > kLargestAtlas || side * kCubeFaces > kLargestAtlas) {
        throw InputError(data.testCase().position,
                         fmt::format("the cubemaps of this case need an image of {} x {} texels; at most {} a side are "
                                     "allowed: smaller environments, or fewer",
                                     side * kCubeFaces, rows, kLargestAtlas));
    }
    ImageDesc atlas{side * kCubeFaces, rows, 4, 1, ImageFilter::kNearest, {}};
    atlas.texels.assign(static_cast<size_t>(atlas.width) * static_cast<size_t>(atlas.height) * 4, 1.0);
    int row = 0;
    for (const Cubemap& cubemap : data.environments()) {
        copyCubemap(cubemap, row, atlas);
        row += rowsOf(cubemap);
    }
    return atlas;
}

} // namespace crossray
