// The numbers of charts, and their files.
#include "harness/base/error.h"
#include "harness/bench/chart.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>

namespace crossray {

std::string formatChartsCsv(std::span<const Chart> charts)
{
    std::string text = "chart,method,cost,error,front,bound\n";
    for (const Chart& chart : charts) {
        const std::vector<bool> front = findChartFront(chart);
        for (size_t i = 0; i < chart.points.size(); ++i) {
            const ChartPoint& point = chart.points[i];
            text += fmt::format("{},\"{}\",{},{},{:d},{:d}\n", chart.id, point.name, point.cost, point.error,
                                static_cast<bool>(front[i]), point.isBound);
        }
    }
    return text;
}

std::string formatChartsJson(std::span<const Chart> charts)
{
    nlohmann::ordered_json all = nlohmann::ordered_json::array();
    for (const Chart& chart : charts) {
        const std::vector<bool> front = findChartFront(chart);
        nlohmann::ordered_json points = nlohmann::ordered_json::array();
        for (size_t i = 0; i < chart.points.size(); ++i) {
            const ChartPoint& point = chart.points[i];
            points.push_back({{"name", point.name},
                              {"cost", point.cost},
                              {"error", point.error},
                              {"front", static_cast<bool>(front[i])},
                              {"bound", point.isBound}});
        }
        all.push_back({{"id", chart.id},
                       {"title", chart.title},
                       {"cost", chart.costLabel},
                       {"error", chart.errorLabel},
                       {"points", points}});
    }
    return nlohmann::ordered_json{{"schema", "crossray-charts/1"}, {"charts", all}}.dump(2) + "\n";
}

void writeTextFile(const std::string& path, const std::string& text)
{
    std::ofstream file(path);
    file << text;
    if (!file.flush()) throw InputError(fmt::format("{}: cannot be written", path));
}

void writeCharts(const std::string& folder, std::span<const Chart> charts)
{
    std::error_code ignored;
    std::filesystem::create_directories(folder, ignored);
    for (const Chart& chart : charts)
        writeTextFile(folder + "/" + chart.id + ".svg", formatChartSvg(chart));
}

} // namespace crossray
