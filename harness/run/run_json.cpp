#include "harness/run/run_json.h"

#include "harness/base/text.h"
#include "harness/run/bare_case.h"
#include "harness/run/case_json.h"
#include "harness/run/run_slices.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace crossray {

using Json = nlohmann::ordered_json;

namespace {

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

} // namespace

RunJsonFrame formatRunJsonFrame(const RunResult& run)
{
    // Beyond the head stands one key, the cases, and they come last.
    std::string text = headToJson(run).dump(1, ' ', false, Json::error_handler_t::replace);
    text.resize(text.rfind("\n}"));
    return {text + ",\n \"cases\": [", "]\n}\n"};
}

std::string formatRunJson(const RunResult& run)
{
    const RunJsonFrame frame = formatRunJsonFrame(run);
    std::string text = frame.before;
    for (const CaseResult& testCase : run.cases) {
        if (&testCase != &run.cases.front()) text += ",";
        text += "\n  " + formatCaseJson(testCase);
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

CaseResult RunFile::parseBare(std::string_view testCase) const
{
    return parseNamed(name_, [&] { return parseBareCase(testCase); });
}

RunResult readRun(const std::filesystem::path& path)
{
    const std::filesystem::path file = findRunJson(path);
    const std::optional<std::string> text = readText(file);
    if (!text) throw InputError({file.string(), 0, 0}, kNoSuchRun);
    return parseRunJson(*text, file.string());
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
