#include "harness/run/inputs.h"

#include "harness/base/text.h"
#include "harness/base/hash.h"
#include "harness/run/case_judge.h"
#include "harness/run/plane_files.h"
#include "harness/run/worker_pool.h"

#include <nlohmann/json.hpp>

namespace crossray {

namespace fs = std::filesystem;

namespace {

} // namespace

std::string computeInputKey(const Case& testCase, const Job& job)
{
    // A program's own key covers its whole source; what reaches the device says more about this variant.
    Job content = job;
    content.label.clear();
    for (ProgramSource& program : content.programs)
        program.key.clear();
    Hasher hasher;
    hasher.addBytes(encodeJob(content)).addString(readText(testCase.file).value_or(""));
    for (const Expectation& expectation : testCase.expectations) {
        hasher.addString(expectation.output.name);
        hasher.addString(describeSource(expectation.source)).addString(describeTolerance(expectation));
        if (const auto* golden = std::get_if<GoldenSource>(&expectation.source))
            hasher.addString(readText(golden->file).value_or(""));
    }
    if (testCase.recorded) hasher.addString(readText(testCase.recorded->truthFile).value_or(""));
    return hasher.finish().hex();
}

PassedCases readPassedCases(const fs::path& runFolder)
{
    PassedCases cases;
    try {
        const auto json = nlohmann::json::parse(readText(runFolder / "inputs.json").value_or(""));
        for (const auto& [name, entry] : json.items())
            cases[name] = {entry.at("key").get<std::string>(), entry.at("passed").get<std::set<std::string>>()};
    } catch (const nlohmann::json::exception&) {
        return {};
    }
    return cases;
}

PassedCases mergePassedCases(PassedCases before, const RunResult& run)
{
    for (const CaseResult& testCase : run.cases) {
        PassedInputs& entry = before[testCase.name];
        if (entry.key != testCase.inputKey) entry = {testCase.inputKey, {}};
        for (const BackendResult& result : testCase.backends) {
            if (tallyOf(result.verdict) == Tally::kFailed) {
                entry.backends.erase(result.backend);
            } else {
                entry.backends.insert(result.backend);
            }
        }
    }
    return before;
}

void writePassedCases(const fs::path& runFolder, const PassedCases& cases)
{
    auto json = nlohmann::json::object();
    for (const auto& [name, entry] : cases) {
        if (!entry.key.empty() && !entry.backends.empty())
            json[name] = {{"key", entry.key}, {"passed", entry.backends}};
    }
    writeFileWhole(runFolder / "inputs.json", json.dump(1) + "\n");
}

} // namespace crossray
