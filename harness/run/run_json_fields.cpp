// The list of fields that the test of the document asks for.
#include "harness/run/run_json.h"

#include <nlohmann/json.hpp>

#include <set>

namespace crossray {

using Json = nlohmann::ordered_json;

namespace {

void collectFields(const Json& json, const std::string& prefix, std::set<std::string>& fields)
{
    // Objects whose keys are data, not fields.
    static const std::set<std::string> kMaps{"verdicts",
                                             "compilers",
                                             "backends",
                                             "parts[].devices",
                                             "cases[].backends[].expectations[].comparison.census",
                                             "cases[].backends[].expectations[].comparison.metrics"};
    if (json.is_array()) {
        if (!json.empty() && json.front().is_object()) collectFields(json.front(), prefix + "[]", fields);
        return;
    }
    for (const auto& [key, value] : json.items()) {
        const bool isData = kMaps.contains(prefix);
        const std::string name = isData ? prefix + ".*" : prefix.empty() ? key : prefix + "." + key;
        fields.insert(name);
        if (value.is_structured()) collectFields(value, name, fields);
    }
}

} // namespace

std::vector<std::string> listRunJsonFields()
{
    RunResult run;
    run.backends["lavapipe"];
    run.compilers["glslang"];
    run.parts.emplace_back().devices["lavapipe"];
    CaseResult& testCase = run.cases.emplace_back();
    testCase.conditioning.emplace().outputs.emplace_back().worst = ConditioningResult::Worst{};
    BackendResult& result = testCase.backends.emplace_back();
    ExpectationResult& expectation = result.expectations.emplace_back();
    expectation.judged = true;
    expectation.comparison.worst.emplace();
    expectation.comparison.confusion.emplace();
    expectation.comparison.census["beyond tolerance"] = 1;
    expectation.comparison.metrics["recall"] = 1;
    std::set<std::string> fields;
    collectFields(Json::parse(formatRunJson(run)), "", fields);
    return {fields.begin(), fields.end()};
}

} // namespace crossray
