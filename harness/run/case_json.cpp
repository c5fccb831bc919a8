#include "harness/run/case_json.h"

#include "harness/run/judged_json.h"

#include <fmt/format.h>

namespace crossray {

using Json = nlohmann::ordered_json;

namespace {

Json timesToJson(const StageTimes& times)
{
    return {{"program", times.program},   {"upload", times.upload}, {"dispatch", times.dispatch},
            {"readback", times.readback}, {"device", times.device}, {"worker", times.worker},
            {"judge", times.judge}};
}

StageTimes timesFromJson(const Json& json)
{
    StageTimes times;
    times.program = json.at("program").get<double>();
    times.upload = json.at("upload").get<double>();
    times.dispatch = json.at("dispatch").get<double>();
    times.readback = json.at("readback").get<double>();
    times.device = json.at("device").get<double>();
    times.worker = json.at("worker").get<double>();
    times.judge = json.at("judge").get<double>();
    return times;
}

Verdict verdictFromJson(const Json& json)
{
    const std::string name = json.get<std::string>();
    if (const auto verdict = findVerdict(name)) return *verdict;
    throw InputError(fmt::format("\"{}\" is no verdict", name));
}

Json backendResultToJson(const BackendResult& result)
{
    Json json{{"backend", result.backend},
              {"verdict", nameOf(result.verdict)},
              {"reason", result.reason},
              {"times", timesToJson(result.times)},
              {"programsWereWarm", result.programsWereWarm},
              {"messages", result.messages},
              {"logLines", result.logLines},
              {"planes", result.planesFile},
              {"trace", result.traceFile},
              {"traceNote", result.traceNote}};
    Json expectations = Json::array();
    for (const ExpectationResult& expectation : result.expectations)
        expectations.push_back(expectationToJson(expectation));
    json["expectations"] = std::move(expectations);
    return json;
}

BackendResult backendResultFromJson(const Json& json)
{
    BackendResult result;
    result.backend = json.at("backend").get<std::string>();
    result.verdict = verdictFromJson(json.at("verdict"));
    result.reason = json.at("reason").get<std::string>();
    result.times = timesFromJson(json.at("times"));
    result.programsWereWarm = json.at("programsWereWarm").get<bool>();
    result.messages = json.at("messages").get<std::vector<std::string>>();
    result.logLines = json.at("logLines").get<std::vector<std::string>>();
    result.planesFile = json.at("planes").get<std::string>();
    result.traceFile = json.value("trace", ""); // younger than the schema
    result.traceNote = json.value("traceNote", "");
    for (const Json& expectation : json.at("expectations"))
        result.expectations.push_back(expectationFromJson(expectation));
    return result;
}

} // namespace

Json caseToJson(const CaseResult& testCase)
{
    Json json{{"name", testCase.name},
              {"summary", testCase.summary},
              {"tags", testCase.tags},
              {"position", positionToJson(testCase.position)},
              {"width", testCase.width},
              {"height", testCase.height},
              {"mustFail", testCase.mustFail},
              {"times", {{"prepare", testCase.prepareMs}, {"compile", testCase.compileMs}}},
              {"inputs", testCase.inputKey},
              {"answeredBy", testCase.answeredBy},
              {"expected", testCase.expectedFile}};
    if (testCase.conditioning) json["conditioning"] = conditioningToJson(*testCase.conditioning);
    Json backends = Json::array();
    for (const BackendResult& result : testCase.backends)
        backends.push_back(backendResultToJson(result));
    json["backends"] = std::move(backends);
    return json;
}

CaseResult caseFromJson(const Json& json)
{
    CaseResult testCase;
    testCase.name = json.at("name").get<std::string>();
    testCase.summary = json.at("summary").get<std::string>();
    testCase.tags = json.at("tags").get<std::vector<std::string>>();
    testCase.position = positionFromJson(json.at("position"));
    testCase.width = json.at("width").get<int>();
    testCase.height = json.at("height").get<int>();
    testCase.mustFail = json.at("mustFail").get<bool>();
    testCase.prepareMs = json.at("times").at("prepare").get<double>();
    testCase.compileMs = json.at("times").at("compile").get<double>();
    testCase.inputKey = json.at("inputs").get<std::string>();
    testCase.answeredBy = json.value("answeredBy", ""); // younger than the schema
    testCase.expectedFile = json.at("expected").get<std::string>();
    if (json.contains("conditioning")) testCase.conditioning = conditioningFromJson(json.at("conditioning"));
    for (const Json& result : json.at("backends"))
        testCase.backends.push_back(backendResultFromJson(result));
    return testCase;
}

} // namespace crossray
