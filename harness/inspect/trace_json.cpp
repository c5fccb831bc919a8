#include "harness/inspect/trace_json.h"

#include "harness/inspect/names.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <set>

namespace crossray {

namespace {

using Json = nlohmann::ordered_json;

// Numbers that JSON does not have are strings, as in run.json.
Json number(double value)
{
    if (std::isnan(value)) return "NaN";
    if (std::isinf(value)) return value > 0 ? "Infinity" : "-Infinity";
    return value;
}

template <typename Vector>
Json vector(const Vector& values)
{
    Json list = Json::array();
    for (int i = 0; i < values.length(); ++i)
        list.push_back(number(values[i]));
    return list;
}

Json stepJson(const RecordedStep& step)
{
    return {{"positionSS", vector(step.positionSS)},
            {"rayLinearDepth", number(step.rayLinearDepth)},
            {"level", step.level},
            {"cell", {step.cell.x, step.cell.y}},
            {"cellSize", {step.cellSize.x, step.cellSize.y}},
            {"nearest", number(step.nearest)},
            {"farthest", number(step.farthest)},
            {"nearestAndThickness", number(step.thick)},
            {"intersection", nameOfIntersection(static_cast<int>(step.kind))}};
}

Json recordJson(const RecordOnBackend& trace)
{
    const PixelRecord& record = trace.record;
    Json steps = Json::array();
    for (const RecordedStep& step : record.steps)
        steps.push_back(stepJson(step));
    return {{"backend", trace.backend},
            {"traced", record.isTraced},
            {"tracingModel", nameOfTracingModel(static_cast<int>(record.model))},
            {"hitSuccess", nameOf(record.hitClass)},
            {"reason", nameOfReason(record.reason)},
            {"startSS", vector(record.startSS)},
            {"startLinearDepth", number(record.startDepth)},
            {"originWS", vector(record.originWS)},
            {"rayDirWS", vector(record.dirWS)},
            {"rayDirSS", vector(record.dirSS)},
            {"depthChange", number(record.depthChange)},
            {"wayOnScreen", number(record.wayOnScreen)},
            {"pathLength", number(record.pathLength)},
            {"minLevel", record.minLevel},
            {"maxLevel", record.maxLevel},
            {"maxIterations", record.maxIterations},
            {"thickness", number(record.depthBias)},
            {"projectionDistance", number(record.projectionDistance)},
            {"meetsProxy", record.meetsProxy},
            {"endSS", vector(record.endSS)},
            {"endLinearDepth", number(record.endDepth)},
            {"iterations", record.iterations},
            {"maxUsedLevel", record.maxUsedLevel},
            {"intersection", nameOfIntersection(static_cast<int>(record.lastKind))},
            {"confidence", number(record.confidence)},
            {"hitWeight", number(record.hitWeight)},
            {"sampledColor", vector(record.sampledColor)},
            {"sampledColorWeight", number(record.sampledColorWeight)},
            {"lostSteps", record.lostSteps},
            {"steps", steps}};
}

void collectFields(const Json& value, const std::string& path, std::set<std::string>& fields)
{
    if (value.is_array()) {
        for (const Json& element : value) {
            if (element.is_object()) collectFields(element, path + "[]", fields);
        }
    }
    if (!value.is_object()) return;
    for (const auto& [name, element] : value.items()) {
        const std::string inner = path.empty() ? name : path + "." + name;
        fields.insert(inner);
        collectFields(element, inner, fields);
    }
}

Json traceJson(const PixelTrace& trace)
{
    Json backends = Json::array();
    for (const RecordOnBackend& record : trace.records)
        backends.push_back(recordJson(record));
    Json parting;
    if (trace.parting) parting = {{"step", trace.parting->step}, {"sentence", trace.parting->sentence}};
    Json conditioning = Json::array();
    for (const PixelConditioning& output : trace.conditioning) {
        conditioning.push_back({{"output", output.output},
                                {"condition", number(output.condition)},
                                {"cpu32", number(output.float32)},
                                {"rounding", number(output.rounding)},
                                {"cause", output.cause},
                                {"undecidable", output.condition > kUndecidableAbove}});
    }
    return {{"schema", "crossray-trace/1"}, {"case", trace.caseName},
            {"summary", trace.summary},     {"pixel", {trace.pixel.x, trace.pixel.y}},
            {"backends", backends},         {"parting", parting},
            {"conditioning", conditioning}, {"conditioningNote", trace.conditioningNote}};
}

} // namespace

std::string formatTraceJson(const PixelTrace& trace)
{
    return traceJson(trace).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::vector<std::string> listTraceJsonFields()
{
    PixelTrace trace;
    trace.records.resize(2);
    trace.records[0].record.steps.resize(1);
    trace.parting = Parting{0, ""};
    trace.conditioning.resize(1);
    std::set<std::string> fields;
    collectFields(traceJson(trace), "", fields);
    return {fields.begin(), fields.end()};
}

} // namespace crossray
