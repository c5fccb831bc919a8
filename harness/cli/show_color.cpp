#include "harness/cli/show_color.h"

#include <fmt/format.h>

#include <array>

namespace crossray {

namespace {

constexpr std::array<std::string_view, 3> kFresnelNames = {"none", "exact", "Schlick"};
constexpr std::array<std::string_view, 4> kPoisonNames = {"none", "NaN", "infinity", "negative"};

} // namespace

void printAbsorption(const Material& material)
{
    if (material.thicknessMap) {
        const ThicknessMap& map = *material.thicknessMap;
        fmt::print("thickness  {}\n", map.file.empty() ? fmt::format("{:g} m to {:g} m along {}", map.from, map.to,
                                                                     map.axis == 0 ? "x" : "y")
                                                       : map.file.string());
    }
    if (material.transmittanceColor != glm::dvec3(1.0)) {
        fmt::print("absorption white is {:g}, {:g}, {:g} after {:g} m\n", material.transmittanceColor.x,
                   material.transmittanceColor.y, material.transmittanceColor.z, material.absorptionDistance);
    }
    if (material.fresnel != FresnelModel::kNone)
        fmt::print("fresnel    {}\n", kFresnelNames.at(static_cast<size_t>(material.fresnel)));
}

void printHistory(const History& history, std::string_view camera)
{
    fmt::print("history    by {}, {} pyramid levels",
               history.reprojection == Reprojection::kMotionVectors ? "motion vectors" : "the previous view-projection",
               history.levels > 0 ? fmt::format("{}", history.levels) : "all");
    if (!history.moved.empty()) fmt::print(", {} moved", history.moved.size());
    if (history.poison != HistoryPoison::kNone) {
        fmt::print(", one pixel in {} both ways is {}", history.poisonEvery,
                   kPoisonNames.at(static_cast<size_t>(history.poison)));
    }
    fmt::print("\n           previous camera: {}\n", camera);
}

} // namespace crossray
