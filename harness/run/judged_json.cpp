#include "harness/run/judged_json.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace crossray {

using Json = nlohmann::ordered_json;

namespace {

Json numberToJson(double value)
{
    if (std::isnan(value)) return "NaN";
    if (std::isinf(value)) return value > 0 ? "Infinity" : "-Infinity";
    return value;
}

double numberFromJson(const Json& json)
{
    if (!json.is_string()) return json.get<double>();
    const std::string text = json.get<std::string>();
    if (text == "NaN") return std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    if (text == "Infinity") return infinity;
    if (text == "-Infinity") return -infinity;
    throw InputError(fmt::format("\"{}\" is no number; allowed are numbers, NaN, Infinity and -Infinity", text));
}

Json numbersToJson(const std::vector<double>& values)
{
    Json json = Json::array();
    for (const double value : values)
        json.push_back(numberToJson(value));
    return json;
}

std::vector<double> numbersFromJson(const Json& json)
{
    std::vector<double> values;
    for (const Json& value : json)
        values.push_back(numberFromJson(value));
    return values;
}

Json comparisonToJson(const Comparison& comparison)
{
    Json json{{"passed", comparison.passed},
              {"reason", comparison.reason},
              {"unit", comparison.unit},
              {"compared", comparison.compared},
              {"failed", comparison.failed},
              {"undecidable", comparison.undecidable},
              {"excused", comparison.excused},
              {"median", numberToJson(comparison.median)},
              {"p95", numberToJson(comparison.p95)},
              {"p99", numberToJson(comparison.p99)},
              {"max", numberToJson(comparison.max)},
              {"mean", numberToJson(comparison.mean)},
              {"census", comparison.census}};
    if (comparison.worst) {
        const PixelDifference& worst = *comparison.worst;
        json["worst"] = {{"x", worst.x},
                         {"y", worst.y},
                         {"expected", numbersToJson(worst.expected)},
                         {"actual", numbersToJson(worst.actual)},
                         {"error", numberToJson(worst.error)}};
    }
    if (comparison.confusion) json["confusion"] = comparison.confusion->counts;
    Json metrics = Json::object();
    for (const auto& [name, value] : comparison.metrics)
        metrics[name] = numberToJson(value);
    json["metrics"] = std::move(metrics);
    return json;
}

Comparison comparisonFromJson(const Json& json)
{
    Comparison comparison;
    comparison.passed = json.at("passed").get<bool>();
    comparison.reason = json.at("reason").get<std::string>();
    comparison.unit = json.at("unit").get<std::string>();
    comparison.compared = json.at("compared").get<uint64_t>();
    comparison.failed = json.at("failed").get<uint64_t>();
    comparison.undecidable = json.value("undecidable", uint64_t{0}); // younger than the schema
    comparison.excused = json.value("excused", uint64_t{0});
    comparison.median = numberFromJson(json.at("median"));
    comparison.p95 = numberFromJson(json.at("p95"));
    comparison.p99 = numberFromJson(json.at("p99"));
    comparison.max = numberFromJson(json.at("max"));
    comparison.mean = numberFromJson(json.at("mean"));
    comparison.census = json.at("census").get<std::map<std::string, uint64_t>>();
    if (json.contains("worst")) {
        const Json& worst = json.at("worst");
        comparison.worst =
            PixelDifference{worst.at("x").get<int>(), worst.at("y").get<int>(), numbersFromJson(worst.at("expected")),
                            numbersFromJson(worst.at("actual")), numberFromJson(worst.at("error"))};
    }
    if (json.contains("confusion")) {
        comparison.confusion.emplace();
        for (size_t expected = 0; expected < 4; ++expected) {
            for (size_t actual = 0; actual < 4; ++actual)
                comparison.confusion->counts[expected][actual] =
                    json.at("confusion").at(expected).at(actual).get<uint64_t>();
        }
    }
    for (const auto& [name, value] : json.at("metrics").items())
        comparison.metrics[name] = numberFromJson(value);
    return comparison;
}

Json optionalToJson(const std::optional<double>& value)
{
    return value ? Json(*value) : Json(nullptr);
}

std::optional<double> optionalFromJson(const Json& json, const char* key)
{
    const auto found = json.find(key);
    if (found == json.end() || found->is_null()) return std::nullopt;
    return found->get<double>();
}

} // namespace

Json positionToJson(const SourcePosition& position)
{
    return {{"file", position.file}, {"line", position.line}, {"column", position.column}};
}

SourcePosition positionFromJson(const Json& json)
{
    return {json.at("file").get<std::string>(), json.at("line").get<int>(), json.at("column").get<int>()};
}

Json expectationToJson(const ExpectationResult& expectation)
{
    Json json{{"index", expectation.index},
              {"output", expectation.output},
              {"source", expectation.source},
              {"position", positionToJson(expectation.position)},
              {"tolerance", expectation.tolerance},
              {"judged", expectation.judged},
              {"note", expectation.note},
              {"missingGolden", expectation.missingGolden},
              {"undecidable", optionalToJson(expectation.undecidable)},
              {"undecidableAbove", optionalToJson(expectation.undecidableAbove)}};
    if (expectation.judged) json["comparison"] = comparisonToJson(expectation.comparison);
    return json;
}

ExpectationResult expectationFromJson(const Json& json)
{
    ExpectationResult expectation;
    expectation.index = json.at("index").get<size_t>();
    expectation.output = json.at("output").get<std::string>();
    expectation.source = json.at("source").get<std::string>();
    expectation.position = positionFromJson(json.at("position"));
    expectation.tolerance = json.at("tolerance").get<std::string>();
    expectation.judged = json.at("judged").get<bool>();
    expectation.note = json.at("note").get<std::string>();
    expectation.missingGolden = json.at("missingGolden").get<bool>();
    expectation.undecidable = optionalFromJson(json, "undecidable"); // younger than the schema
    expectation.undecidableAbove = optionalFromJson(json, "undecidableAbove");
    if (expectation.judged) expectation.comparison = comparisonFromJson(json.at("comparison"));
    return expectation;
}

Json conditioningToJson(const ConditioningResult& conditioning)
{
    Json outputs = Json::array();
    for (const ConditioningResult::Output& output : conditioning.outputs) {
        Json json{{"output", output.output},   {"pixels", output.pixels}, {"undecidable", output.undecidable},
                  {"fragile", output.fragile}, {"median", output.median}, {"p95", output.p95},
                  {"max", output.max}};
        if (output.worst) {
            json["worst"] = {{"x", output.worst->x},
                             {"y", output.worst->y},
                             {"condition", numberToJson(output.worst->condition)},
                             {"cause", output.worst->cause}};
        }
        outputs.push_back(std::move(json));
    }
    return {{"file", conditioning.file},
            {"bound", conditioning.bound},
            {"note", conditioning.note},
            {"outputs", std::move(outputs)}};
}

ConditioningResult conditioningFromJson(const Json& json)
{
    ConditioningResult conditioning;
    conditioning.file = json.at("file").get<std::string>();
    conditioning.bound = json.at("bound").get<double>();
    conditioning.note = json.at("note").get<std::string>();
    for (const Json& entry : json.at("outputs")) {
        ConditioningResult::Output& output = conditioning.outputs.emplace_back();
        output.output = entry.at("output").get<std::string>();
        output.pixels = entry.at("pixels").get<uint64_t>();
        output.undecidable = entry.at("undecidable").get<uint64_t>();
        output.fragile = entry.at("fragile").get<uint64_t>();
        output.median = entry.at("median").get<double>();
        output.p95 = entry.at("p95").get<double>();
        output.max = entry.at("max").get<double>();
        if (!entry.contains("worst")) continue;
        const Json& worst = entry.at("worst");
        output.worst = {worst.at("x").get<int>(), worst.at("y").get<int>(), numberFromJson(worst.at("condition")),
                        worst.at("cause").get<int>()};
    }
    return conditioning;
}

} // namespace crossray
