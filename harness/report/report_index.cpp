#include "harness/report/report_index.h"

#include "harness/base/outputs.h"
#include "harness/run/run_json.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>

namespace crossray {

using Json = nlohmann::ordered_json;

namespace {

std::string_view nameOf(Tally tally)
{
    switch (tally) {
    case Tally::kPassed:
        return "passed";
    case Tally::kFailed:
        return "failed";
    case Tally::kSkipped:
        break;
    }
    return "skipped";
}

std::string_view nameOf(OutputType type)
{
    switch (type) {
    case OutputType::kDirection:
        return "direction";
    case OutputType::kDepth:
        return "depth";
    case OutputType::kHitClass:
        return "class";
    case OutputType::kColor:
        return "color";
    case OutputType::kScalar:
        return "scalar";
    case OutputType::kCount:
        break;
    }
    return "count";
}

Json formatResult(const CaseResult& testCase, const BackendResult& result)
{
    Json json{{"backend", result.backend},
              {"verdict", crossray::nameOf(result.verdict)},
              {"tally", nameOf(tallyOf(result.verdict))}};
    if (result.verdict == Verdict::kPass) return json;
    json["reason"] = result.reason;
    const ExpectationResult* const worst = findWorstExpectation(testCase, result);
    if (worst == nullptr || tallyOf(result.verdict) == Tally::kPassed) return json;
    json["output"] = worst->output;
    json["expectation"] = worst->index;
    if (worst->comparison.worst) json["pixel"] = {worst->comparison.worst->x, worst->comparison.worst->y};
    if (!worst->comparison.census.empty()) {
        const auto& census = worst->comparison.census;
        json["kind"] = std::max_element(census.begin(), census.end(), [](const auto& a, const auto& b) {
                           return a.second < b.second;
                       })->first;
    }
    return json;
}

Json formatCase(const CaseResult& testCase, const CasePieces& pieces)
{
    std::set<std::string> outputs;
    Json results = Json::array();
    for (const BackendResult& result : testCase.backends) {
        for (const ExpectationResult& expectation : result.expectations)
            outputs.insert(expectation.output);
        results.push_back(formatResult(testCase, result));
    }
    Json json{{"name", testCase.name},
              {"summary", testCase.summary},
              {"tags", testCase.tags},
              {"file", testCase.position.file},
              {"line", testCase.position.line},
              {"width", testCase.width},
              {"height", testCase.height},
              {"mustFail", testCase.mustFail},
              {"outputs", outputs},
              {"results", results},
              {"details", pieces.details}};
    if (!pieces.planes.empty()) json["planes"] = pieces.planes;
    return json;
}

Json formatOutputs()
{
    Json outputs = Json::array();
    for (const OutputInfo& info : allOutputs()) {
        outputs.push_back({{"name", info.name},
                           {"type", nameOf(info.type)},
                           {"channels", info.channels},
                           {"unit", info.unit},
                           {"summary", info.summary}});
    }
    return outputs;
}

} // namespace

bool hasFailed(const CaseResult& testCase)
{
    return std::any_of(testCase.backends.begin(), testCase.backends.end(),
                       [](const BackendResult& result) { return tallyOf(result.verdict) == Tally::kFailed; });
}

std::string formatIndexCase(const CaseResult& testCase, const CasePieces& pieces)
{
    return formatCase(testCase, pieces).dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string formatIndexJson(const RunResult& run, const ReportOptions& options, const ReportIndex& index)
{
    Json cases = Json::array();
    for (size_t i = 0; i < run.cases.size(); ++i)
        cases.push_back(formatCase(run.cases[i], index.cases[i]));
    Json traces = Json::array();
    for (const TracePiece& trace : index.traces) {
        traces.push_back({{"piece", trace.piece},
                          {"case", trace.caseName},
                          {"x", trace.x},
                          {"y", trace.y},
                          {"backends", trace.backends}});
    }
    Json benches = Json::array();
    for (const std::string& piece : index.benches)
        benches.push_back({{"piece", piece}});
    Json cubemaps = Json::array();
    for (const auto& [name, piece] : index.cubemaps)
        cubemaps.push_back({{"name", name}, {"piece", piece}});
    const Json json{{"schema", kReportSchema},
                    {"runFolder", options.runFolder},
                    {"run", Json::parse(formatHeadJson(run))},
                    {"outputs", formatOutputs()},
                    {"leftOut", index.leftOut},
                    {"traces", traces},
                    {"benches", benches},
                    {"cubemaps", cubemaps},
                    {"atlas", index.atlas},
                    {"atlasPictures", index.atlasPictures},
                    {"atlasCases", index.atlasCases},
                    {"cases", cases}};
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

} // namespace crossray
