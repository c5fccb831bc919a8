#include "harness/bench/tracer_report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>

namespace crossray {

namespace {

struct Column {
    const char* name;
    double TracerScore::*value;
};
constexpr std::array<Column, 11> kColumns{{{"recall", &TracerScore::recall},
                                           {"precision", &TracerScore::precision},
                                           {"falseShare", &TracerScore::falseShare},
                                           {"wrong", &TracerScore::wrong},
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

std::vector<Chart> makeTracerCharts(const TracerReportHead& head, std::span<const MeasuredTracer> rows)
{
    const YardstickOptions& options = head.options;
    const bool isCase = !head.scene.empty();
    std::string id =
        isCase ? head.scene : fmt::format("{}_{}x{}", nameOf(options.family), options.width, options.height);
    std::string title = isCase ? head.scene
                               : fmt::format("{}, seeds {} to {}, {}x{}", nameOf(options.family), options.firstSeed,
                                             options.lastSeed, options.width, options.height);
    if (!isCase && options.disturbance != Disturbance::kNone) {
        id += fmt::format("_{}", nameOf(options.disturbance));
        title += fmt::format(", {}", nameOf(options.disturbance));
    }
    std::replace(id.begin(), id.end(), '/', '_');
    Chart cost{"tracers_" + id,
               "Screen-space tracers: " + title,
               "reads of the depth buffer or its pyramid, a ray",
               "share of all rays that are answered wrongly",
               {}};
    Chart group{"tracers_of_32_" + id,
                "What a GPU pays: " + title,
                "reads a ray, the largest of 32 neighbours (mean)",
                "share of all rays that are answered wrongly",
                {}};
    Chart knob{"tracers_false_" + id,
               "Missed against false hits: " + title,
               "false hits: share of the unanswerable rays that are claimed",
               "missed: share of the answerable rays without a right hit",
               {}};
    for (const MeasuredTracer& tracer : rows) {
        const TracerScore& m = tracer.row.mean;
        const bool isBound = tracer.row.name.starts_with("oracle");
        const bool isOwn = std::find(head.own.begin(), head.own.end(), tracer.row.name) != head.own.end();
        cost.points.push_back({tracer.row.name, m.fetches, m.wrong, isBound, isOwn});
        group.points.push_back({tracer.row.name, m.groupFetches, m.wrong, isBound, isOwn});
        if (!isBound) knob.points.push_back({tracer.row.name, m.falseShare, 1 - m.recall, false, isOwn});
    }
    return {cost, group, knob};
}

std::string formatTracerReliability(const TracerReportHead& head, std::span<const MeasuredTracer> rows)
{
    std::vector<ReliabilitySeries> series;
    for (const MeasuredTracer& tracer : rows) {
        if (tracer.reliability.empty() || !series.empty()) continue; // the most greedy setting shows the whole range
        ReliabilitySeries made{tracer.row.name, {}};
        for (const ReliabilityBin& bin : tracer.reliability)
            made.dots.push_back({bin.confidence, bin.right, bin.count});
        series.push_back(std::move(made));
    }
    const YardstickOptions& options = head.options;
    const std::string scene = head.scene.empty()
                                  ? fmt::format("{}, seeds {} to {}, {}x{}", nameOf(options.family), options.firstSeed,
                                                options.lastSeed, options.width, options.height)
                                  : head.scene;
    return formatReliabilitySvg("Confidence: " + scene, series);
}

} // namespace crossray
