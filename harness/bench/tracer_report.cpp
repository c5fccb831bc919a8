#include "harness/bench/tracer_report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>

namespace crossray {

namespace {

struct Column {
    const char* name;
    double TracerScore::*value;
};
constexpr std::array<Column, 10> kColumns{{{"recall", &TracerScore::recall},
                                           {"precision", &TracerScore::precision},
                                           {"falseShare", &TracerScore::falseShare},
                                           {"medianPixels", &TracerScore::medianPixels},
                                           {"p95Pixels", &TracerScore::p95Pixels},
                                           {"medianDepthError", &TracerScore::medianDepth},
                                           {"fetches", &TracerScore::fetches},
                                           {"fetchesOf32", &TracerScore::groupFetches},
                                           {"iterations", &TracerScore::iterations},
                                           {"capped", &TracerScore::capped}}};

nlohmann::ordered_json toJson(const TracerScore& score)
{
    nlohmann::ordered_json json;
    for (const Column& column : kColumns)
        json[column.name] = score.*column.value;
    return json;
}

} // namespace

std::string formatTracerJson(const TracerReportHead& head, std::span<const MeasuredTracer> rows)
{
    const YardstickOptions& options = head.options;
    nlohmann::ordered_json json{{"schema", "crossray-tracers/1"}};
    if (!head.scene.empty()) {
        json["case"] = head.scene;
    } else {
        json["family"] = nameOf(options.family);
        json["disturbance"] = nameOf(options.disturbance);
        json["seeds"] = {options.firstSeed, options.lastSeed};
        json["size"] = {options.width, options.height};
        json["stride"] = options.stride;
    }
    json["thickness"] = head.thickness;
    json["tracers"] = nlohmann::ordered_json::array();
    for (const MeasuredTracer& tracer : rows) {
        nlohmann::ordered_json row{{"name", tracer.row.name},
                                   {"scenes", tracer.row.scenes},
                                   {"mean", toJson(tracer.row.mean)},
                                   {"worst", toJson(tracer.row.worst)}};
        row["reliability"] = nlohmann::ordered_json::array();
        for (const ReliabilityBin& bin : tracer.reliability)
            row["reliability"].push_back({{"confidence", bin.confidence}, {"right", bin.right}, {"hits", bin.count}});
        json["tracers"].push_back(std::move(row));
    }
    return json.dump(2) + "\n";
}

std::string formatTracerCsv(std::span<const MeasuredTracer> rows)
{
    std::string text = "tracer";
    for (const char* prefix : {"", "worst "}) {
        for (const Column& column : kColumns)
            text += fmt::format(",{}{}", prefix, column.name);
    }
    text += '\n';
    for (const MeasuredTracer& tracer : rows) {
        text += fmt::format("\"{}\"", tracer.row.name);
        for (const TracerScore* score : {&tracer.row.mean, &tracer.row.worst}) {
            for (const Column& column : kColumns)
                text += fmt::format(",{}", score->*column.value);
        }
        text += '\n';
    }
    return text;
}

} // namespace crossray
