#include "harness/run/inputs.h"

#include "harness/base/hash.h"
#include "harness/run/case_judge.h"
#include "harness/run/plane_files.h"
#include "harness/run/worker_pool.h"

#include <nlohmann/json.hpp>

#include <fstream>
#include <sstream>

namespace crossray {

namespace fs = std::filesystem;

namespace {

std::string readAll(const fs::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream content;
    content << stream.rdbuf();
    return content.str();
}

} // namespace

std::string computeInputKey(const Case& testCase, const Job& job)
{
    // A program's own key covers its whole source; what reaches the device says more about this variant.
    Job content = job;
    content.label.clear();
    for (ProgramSource& program : content.programs)
        program.key.clear();
    Hasher hasher;
    hasher.addBytes(encodeJob(content)).addString(readAll(testCase.file));
    for (const Expectation& expectation : testCase.expectations) {
        hasher.addString(expectation.output.name);
        hasher.addString(describeSource(expectation.source)).addString(describeTolerance(expectation));
        if (const auto* golden = std::get_if<GoldenSource>(&expectation.source))
            hasher.addString(readAll(golden->file));
    }
    if (testCase.recorded) hasher.addString(readAll(testCase.recorded->truthFile));
    return hasher.finish().hex();
}

PassedCases readPassedCases(const fs::path& runFolder)
{
    PassedCases cases;
    try {
        const auto json = nlohmann::json::parse(readAll(runFolder / "inputs.json"));
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
