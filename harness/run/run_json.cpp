#include "harness/run/run_json.h"

#include "harness/base/text.h"
#include "harness/run/run_slices.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>
#include <set>

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

Json positionToJson(const SourcePosition& position)
{
    return {{"file", position.file}, {"line", position.line}, {"column", position.column}};
}

SourcePosition positionFromJson(const Json& json)
{
    return {json.at("file").get<std::string>(), json.at("line").get<int>(), json.at("column").get<int>()};
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

Json caseToJson(const CaseResult& testCase)
{
    Json json{
        {"name", testCase.name},         {"summary", testCase.summary},
        {"tags", testCase.tags},         {"position", positionToJson(testCase.position)},
        {"width", testCase.width},       {"height", testCase.height},
        {"mustFail", testCase.mustFail}, {"times", {{"prepare", testCase.prepareMs}, {"compile", testCase.compileMs}}},
        {"inputs", testCase.inputKey},   {"answeredBy", testCase.answeredBy},
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

Json backendRecordToJson(const BackendRecord& record)
{
    const Fingerprint& print = record.fingerprint;
    return {{"api", print.api},
            {"device", print.device},
            {"driver", print.driver},
            {"llvm", print.llvm},
            {"cpu", print.cpu},
            {"startMs", record.startMs},
            {"environmentError", record.environmentError}};
}

BackendRecord backendRecordFromJson(const std::string& name, const Json& json)
{
    BackendRecord record;
    Fingerprint& print = record.fingerprint;
    print.backend = name;
    print.api = json.at("api").get<std::string>();
    print.device = json.at("device").get<std::string>();
    print.driver = json.at("driver").get<std::string>();
    print.llvm = json.at("llvm").get<std::string>();
    print.cpu = json.at("cpu").get<std::string>();
    record.startMs = json.at("startMs").get<double>();
    record.environmentError = json.at("environmentError").get<std::string>();
    return record;
}

Json planToJson(const RunPlan& plan)
{
    return {{"hash", plan.hash},       {"cases", plan.cases},       {"ownCases", plan.ownCases},
            {"names", plan.names},     {"contents", plan.contents}, {"partition", plan.partition},
            {"shaders", plan.shaders}, {"harness", plan.harness},   {"options", plan.options}};
}

RunPlan planFromJson(const Json& json)
{
    RunPlan plan;
    plan.hash = json.at("hash").get<std::string>();
    plan.cases = json.at("cases").get<uint64_t>();
    plan.ownCases = json.at("ownCases").get<uint64_t>();
    plan.names = json.at("names").get<std::string>();
    plan.contents = json.at("contents").get<std::string>();
    plan.partition = json.at("partition").get<std::string>();
    plan.shaders = json.at("shaders").get<std::string>();
    plan.harness = json.at("harness").get<std::string>();
    plan.options = json.at("options").get<std::string>();
    return plan;
}

Json partToJson(const MergedPart& part)
{
    return {{"shard", part.shard},     {"attempt", part.attempt}, {"started", part.started},
            {"seconds", part.seconds}, {"cases", part.cases},     {"devices", part.devices}};
}

MergedPart partFromJson(const Json& json)
{
    MergedPart part;
    part.shard = json.at("shard").get<std::string>();
    part.attempt = json.at("attempt").get<std::string>();
    part.started = json.at("started").get<std::string>();
    part.seconds = json.at("seconds").get<double>();
    part.cases = json.at("cases").get<uint64_t>();
    part.devices = json.at("devices").get<std::map<std::string, std::string>>();
    return part;
}

// Of files that are older than these fields: empty.
void sharedFieldsFromJson(const Json& json, RunResult& run)
{
    run.attempt = json.value("attempt", "");
    if (json.contains("plan")) run.plan = planFromJson(json.at("plan"));
    if (json.contains("missingParts")) run.missingParts = json.at("missingParts").get<std::vector<std::string>>();
    if (!json.contains("parts")) return;
    for (const Json& part : json.at("parts"))
        run.parts.push_back(partFromJson(part));
}

Json headToJson(const RunResult& run)
{
    const RunCounts counts = countVerdicts(run);
    Json byVerdict = Json::object();
    for (const auto& [verdict, count] : counts.byVerdict)
        byVerdict[std::string(nameOf(verdict))] = count;
    Json json{{"schema", kRunSchema},
              {"version", run.version},
              {"commit", run.commit},
              {"modified", run.modified},
              {"started", run.started},
              {"seconds", run.seconds},
              {"firstVerdictMs", run.firstVerdictMs},
              {"interrupted", run.interrupted},
              {"stoppedEarly", run.stoppedEarly},
              {"exitCode", run.exitCode},
              {"counts", {{"passed", counts.passed}, {"failed", counts.failed}, {"skipped", counts.skipped}}},
              {"verdicts", std::move(byVerdict)},
              {"commandLine", run.commandLine},
              {"validation", run.validation},
              {"cores", run.cores},
              {"repeat", run.repeat},
              {"seed", run.seed ? Json(*run.seed) : Json(nullptr)},
              {"shard", run.shard},
              {"attempt", run.attempt},
              {"plan", planToJson(run.plan)},
              {"compilers", run.compilers},
              {"toolPeakBytes", run.toolPeakBytes},
              {"workersPeakBytes", run.workersPeakBytes},
              {"brokenFiles", run.brokenFiles},
              {"unchanged", run.unchanged}};
    Json backends = Json::object();
    for (const auto& [name, record] : run.backends)
        backends[name] = backendRecordToJson(record);
    json["backends"] = std::move(backends);
    json["missingParts"] = run.missingParts;
    Json parts = Json::array();
    for (const MergedPart& part : run.parts)
        parts.push_back(partToJson(part));
    json["parts"] = std::move(parts);
    return json;
}

RunResult runFromJson(const Json& json)
{
    RunResult run;
    run.version = json.at("version").get<std::string>();
    run.commit = json.at("commit").get<std::string>();
    run.modified = json.at("modified").get<bool>();
    run.started = json.at("started").get<std::string>();
    run.seconds = json.at("seconds").get<double>();
    run.firstVerdictMs = json.at("firstVerdictMs").get<double>();
    run.interrupted = json.at("interrupted").get<bool>();
    run.stoppedEarly = json.at("stoppedEarly").get<bool>();
    run.exitCode = json.at("exitCode").get<int>();
    run.commandLine = json.at("commandLine").get<std::vector<std::string>>();
    run.validation = json.at("validation").get<bool>();
    run.cores = json.at("cores").get<int>();
    run.repeat = json.at("repeat").get<int>();
    if (!json.at("seed").is_null()) run.seed = json.at("seed").get<uint64_t>();
    run.shard = json.at("shard").get<std::string>();
    run.compilers = json.at("compilers").get<std::map<std::string, std::string>>();
    run.toolPeakBytes = json.at("toolPeakBytes").get<uint64_t>();
    run.workersPeakBytes = json.at("workersPeakBytes").get<uint64_t>();
    run.brokenFiles = json.at("brokenFiles").get<std::vector<std::string>>();
    run.unchanged = json.at("unchanged").get<std::vector<std::string>>();
    for (const auto& [name, record] : json.at("backends").items())
        run.backends[name] = backendRecordFromJson(name, record);
    sharedFieldsFromJson(json, run);
    for (const Json& testCase : json.at("cases"))
        run.cases.push_back(caseFromJson(testCase));
    return run;
}

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

RunJsonFrame formatRunJsonFrame(const RunResult& run)
{
    // Beyond the head stands one key, the cases, and they come last.
    std::string text = headToJson(run).dump(1, ' ', false, Json::error_handler_t::replace);
    text.resize(text.rfind("\n}"));
    return {text + ",\n \"cases\": [", "]\n}\n"};
}

std::string indentCaseJson(std::string_view json)
{
    std::string text = "\n  ";
    for (const char character : json) { // a line break within a string is written as \n
        text += character;
        if (character == '\n') text += "  ";
    }
    return text;
}

std::string formatRunJson(const RunResult& run)
{
    const RunJsonFrame frame = formatRunJsonFrame(run);
    std::string text = frame.before;
    for (const CaseResult& testCase : run.cases) {
        if (&testCase != &run.cases.front()) text += ",";
        text += indentCaseJson(caseToJson(testCase).dump(1, ' ', false, Json::error_handler_t::replace));
    }
    if (!run.cases.empty()) text += "\n ";
    return text + frame.after;
}

std::string formatCaseJson(const CaseResult& testCase)
{
    return caseToJson(testCase).dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string formatHeadJson(const RunResult& run)
{
    return headToJson(run).dump(-1, ' ', false, Json::error_handler_t::replace);
}

namespace {

// Calls `parse`; what it complains about is told with the file's name.
template <typename Parse>
auto parseNamed(const std::string& name, const Parse& parse)
{
    try {
        return parse();
    } catch (const Json::exception& error) {
        throw InputError({name, 0, 0}, fmt::format("is no run.json: {}", error.what()));
    } catch (const InputError& error) {
        throw InputError({name, 0, 0}, error.what());
    }
}

} // namespace

RunResult parseRunJson(std::string_view text, const std::string& name)
{
    return parseNamed(name, [&] {
        // A case at a time: the whole as one tree would take ten times the memory of its text.
        const std::optional<RunSlices> slices = sliceRunJson(text);
        const Json json = Json::parse(slices ? std::string_view(slices->head) : text);
        const std::string schema = json.is_object() ? json.value("schema", "") : "";
        if (schema != kRunSchema) {
            throw InputError(fmt::format("the schema is \"{}\"; this version reads \"{}\"", schema, kRunSchema));
        }
        RunResult run = runFromJson(json);
        if (slices) {
            for (const std::string_view testCase : slices->cases)
                run.cases.push_back(caseFromJson(Json::parse(testCase)));
        }
        return run;
    });
}

CaseResult parseCaseJson(std::string_view text, const std::string& name)
{
    return parseNamed(name, [&] { return caseFromJson(Json::parse(text)); });
}

std::filesystem::path findRunJson(const std::filesystem::path& path)
{
    std::error_code failure;
    return std::filesystem::is_directory(path, failure) ? path / "run.json" : path;
}

namespace {

constexpr const char* kNoSuchRun = "there is no such file; allowed is a run's folder or its run.json";

MappedFile openRunJson(const std::filesystem::path& file)
{
    std::error_code failure;
    if (!std::filesystem::is_regular_file(file, failure)) throw InputError({file.string(), 0, 0}, kNoSuchRun);
    return MappedFile(file);
}

} // namespace

RunFile::RunFile(const std::filesystem::path& path)
    : name_(findRunJson(path).string()), file_(openRunJson(findRunJson(path)))
{
    std::optional<RunSlices> slices = sliceRunJson(file_.text());
    // What cannot be taken apart is refused by the parser, which says where it breaks off.
    head_ = parseRunJson(slices ? std::string_view(slices->head) : file_.text(), name_);
    if (!slices) throw InputError({name_, 0, 0}, "is no run.json: its cases are no one list");
    cases_ = std::move(slices->cases);
    release();
}

RunResult readRun(const std::filesystem::path& path)
{
    const std::filesystem::path file = findRunJson(path);
    const std::optional<std::string> text = readText(file);
    if (!text) throw InputError({file.string(), 0, 0}, kNoSuchRun);
    return parseRunJson(*text, file.string());
}

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

std::string formatSummaryJson(const RunResult& run)
{
    Json json = headToJson(run);
    Json notPassed = Json::array();
    for (const CaseResult& testCase : run.cases) {
        for (const BackendResult& result : testCase.backends) {
            if (result.verdict == Verdict::kPass) continue;
            notPassed.push_back({{"case", testCase.name},
                                 {"backend", result.backend},
                                 {"verdict", nameOf(result.verdict)},
                                 {"reason", result.reason}});
        }
    }
    json["notPassed"] = std::move(notPassed);
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace crossray
