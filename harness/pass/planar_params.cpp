#include "harness/pass/planar_params.h"

#include "harness/base/error.h"
#include "harness/expect/captures.h"
#include "harness/pass/params.h"
#include "harness/pass/probe_params.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

namespace crossray {

namespace {

// The planar probes in the order in which they are asked.
std::vector<const Probe*> findPlanarProbes(const Case& testCase)
{
    std::vector<const Probe*> planar;
    for (const size_t place : orderProbes(testCase)) {
        const Probe& probe = testCase.probes[place];
        if (probe.kind == ProbeKind::kPlanar) planar.push_back(&probe);
    }
    return planar;
}

template <class Params>
Params fillParams(const Case& testCase)
{
    using Vec4 = decltype(std::remove_all_extents_t<decltype(Params::items)>::pointWS);
    Params params{};
    const std::vector<const Probe*> planar = findPlanarProbes(testCase);
    params.settings = {static_cast<int>(planar.size()), static_cast<int>(testCase.probes.size() - planar.size()), 0, 0};
    int row = 0;
    for (size_t i = 0; i < planar.size(); ++i) {
        const ProbeMirror& mirror = planar[i]->mirror;
        const double radians = mirror.fovYDegrees.value_or(0.0) * std::numbers::pi / 180.0;
        const double aspect = static_cast<double>(mirror.width) / mirror.height;
        params.items[i].pointWS = Vec4(glm::dvec4(mirror.position, 0.0));
        params.items[i].normalWS = Vec4(glm::dvec4(mirror.normal, 0.0));
        params.items[i].field = Vec4(glm::dvec4(radians, aspect, mirror.fovYDegrees ? 1.0 : 0.0, 0.0));
        params.items[i].image = {row, mirror.width, mirror.height, mirror.linearFilter ? 1 : 0};
        row += mirror.height;
    }
    return params;
}

} // namespace

bool usesPlanarProbes(const Case& testCase)
{
    return (testCase.hierarchy & kTierProbes) != 0 && !findPlanarProbes(testCase).empty();
}

std::vector<std::byte> makePlanarParams(const CaseData& data, Precision precision)
{
    return precision == Precision::kFloat ? bytesOf(fillParams<layout32::PlanarParams>(data.testCase()))
                                          : bytesOf(fillParams<layout64::PlanarParams>(data.testCase()));
}

ImageDesc makePlanarAtlas(const CaseData& data)
{
    const Case& testCase = data.testCase();
    const std::vector<const Probe*> planar = findPlanarProbes(testCase);
    ImageDesc atlas{1, 0, 4, 1, ImageFilter::kNearest, {}};
    for (const Probe* probe : planar) {
        atlas.width = std::max(atlas.width, probe->mirror.width);
        atlas.height += probe->mirror.height;
    }
    if (atlas.height > kLargestAtlas) {
        throw InputError(testCase.position, fmt::format("the planar captures of this case are {} pixels high together; "
                                                        "at most {} are allowed",
                                                        atlas.height, kLargestAtlas));
    }
    atlas.texels.assign(static_cast<size_t>(atlas.width) * static_cast<size_t>(atlas.height) * 4, 0.0);
    size_t row = 0;
    for (const Probe* probe : planar) {
        const Plane capture = capturePlanar(testCase.scene, testCase.camera, makePlanarSettings(*probe));
        for (int y = 0; y < capture.height; ++y, ++row) {
            for (int x = 0; x < capture.width; ++x) {
                const size_t texel = row * static_cast<size_t>(atlas.width) + static_cast<size_t>(x);
                for (int channel = 0; channel < 3; ++channel)
                    atlas.texels[texel * 4 + static_cast<size_t>(channel)] = capture.at(x, y, channel);
                atlas.texels[texel * 4 + 3] = 1.0;
            }
        }
    }
    return atlas;
}

} // namespace crossray
