#include "harness/bench/family.h"

#include <algorithm>
#include <array>

namespace crossray {

const Plane& FamilyRun::plane(std::string_view name) const
{
    return *std::find_if(planes.begin(), planes.end(), [&](const Plane& plane) { return plane.name == name; });
}

const BenchFamily* findBenchFamily(const std::string& name)
{
    static const std::array families{&refractionTechniques(), &glossyMappings(), &depthFormats()};
    const auto found =
        std::find_if(families.begin(), families.end(), [&](const BenchFamily* family) { return family->name == name; });
    return found == families.end() ? nullptr : *found;
}

std::string shortNameOf(const std::string& caseName)
{
    return caseName.substr(caseName.rfind('/') + 1);
}

std::string chartIdOf(const std::string& name)
{
    std::string id = name;
    for (char& c : id) {
        const bool isPlain = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
        if (!isPlain) c = '_';
    }
    return id;
}

std::vector<Chart> makeRefractionModelCharts(const BenchScene& scene, const std::string& device)
{
    struct Axis {
        const char* error;
        const char* label;
    };
    constexpr std::array<Axis, 3> kAxes{{{"RayDirWS", "exit direction, mean error in degrees"},
                                         {"RayOriginWS", "exit position, mean error in metres"},
                                         {"PathLength", "path inside, mean error in metres"}}};
    const std::string id = chartIdOf(shortNameOf(scene.name));
    const std::string title = "Refraction model: " + scene.name;
    std::vector<Chart> charts;
    for (const Axis& axis : kAxes) {
        Chart chart{
            "refraction_models_" + id + "_" + axis.error, title, "SPIR-V instructions of the pass", axis.label, {}};
        for (const BenchPoint& point : scene.points) {
            if (point.counters.contains("Instructions"))
                chart.points.push_back({point.method, point.counters.at("Instructions"), point.errors.at(axis.error)});
        }
        charts.push_back(std::move(chart));
    }
    Chart time{"refraction_models_" + id + "_time",
               title,
               "time over that of reading the G-buffer and writing the outputs (" + device + ")",
               kAxes[0].label,
               {}};
    for (const BenchPoint& point : scene.points)
        time.points.push_back({point.method, point.time.ratio, point.errors.at("RayDirWS")});
    charts.push_back(std::move(time));
    return charts;
}

} // namespace crossray
