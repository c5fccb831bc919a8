#include "harness/run/golden.h"

#include "harness/base/text.h"
#include "harness/run/plane_files.h"
#include "harness/scene/exr.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace crossray {

namespace fs = std::filesystem;

namespace {

bool isGolden(const ExpectationResult& expectation)
{
    return expectation.source.starts_with("golden ");
}

const CaseResult* findCase(const RunResult& run, const std::string& name)
{
    const auto found =
        std::find_if(run.cases.begin(), run.cases.end(), [&](const auto& item) { return item.name == name; });
    return found == run.cases.end() ? nullptr : &*found;
}

// The first that failed, unless one is named; a run that kept all planes may have none that failed.
const BackendResult& chooseBackend(const CaseResult& testCase, const std::string& backend)
{
    const BackendResult* chosen = nullptr;
    for (const BackendResult& result : testCase.backends) {
        if (result.planesFile.empty() || (!backend.empty() && backend != result.backend)) continue;
        if (tallyOf(result.verdict) == Tally::kFailed) return result;
        if (chosen == nullptr) chosen = &result;
    }
    if (chosen != nullptr) return *chosen;
    throw InputError(fmt::format("{}: the run kept no planes of it{}; run it with --planes all", testCase.name,
                                 backend.empty() ? "" : " on " + backend));
}

std::string formatSidecar(const RunResult& run, const std::string& caseName, const BackendResult& result,
                          const std::vector<std::string>& outputs)
{
    nlohmann::ordered_json json{{"case", caseName},          {"outputs", outputs},   {"backend", result.backend},
                                {"recorded", run.started},   {"commit", run.commit}, {"modified", run.modified},
                                {"compilers", run.compilers}};
    if (const auto record = run.backends.find(result.backend); record != run.backends.end()) {
        const Fingerprint& print = record->second.fingerprint;
        json["fingerprint"] = {{"api", print.api},
                               {"device", print.device},
                               {"driver", print.driver},
                               {"llvm", print.llvm},
                               {"cpu", print.cpu}};
    }
    return json.dump(1) + "\n";
}

} // namespace

std::vector<GoldenFailure> listGoldenFailures(const RunResult& run)
{
    std::vector<GoldenFailure> failures;
    for (const CaseResult& testCase : run.cases) {
        for (const BackendResult& result : testCase.backends) {
            for (const ExpectationResult& expectation : result.expectations) {
                const bool failed = expectation.missingGolden || (expectation.judged && !expectation.comparison.passed);
                if (!isGolden(expectation) || !failed) continue;
                auto same = std::find_if(failures.begin(), failures.end(), [&](const GoldenFailure& other) {
                    return other.caseName == testCase.name && other.position.line == expectation.position.line;
                });
                if (same == failures.end()) {
                    failures.push_back({testCase.name,
                                        expectation.output,
                                        testCase.position.file,
                                        expectation.position,
                                        {},
                                        expectation.missingGolden ? "no golden file" : expectation.comparison.reason,
                                        expectation.missingGolden});
                    same = std::prev(failures.end());
                }
                same->backends.push_back(result.backend);
            }
        }
    }
    return failures;
}

std::vector<fs::path> acceptGoldens(const Case& testCase, const RunResult& run, const fs::path& runFolder,
                                    const std::string& backend)
{
    const CaseResult* ran = findCase(run, testCase.name);
    if (ran == nullptr) throw InputError(fmt::format("{}: the run has no such case", testCase.name));
    // Several outputs may share a file.
    std::map<fs::path, std::vector<std::string>> wanted;
    for (const Expectation& expectation : testCase.expectations) {
        if (const auto* golden = std::get_if<GoldenSource>(&expectation.source)) {
            wanted[golden->file].emplace_back(expectation.output.name);
        }
    }
    if (wanted.empty()) throw InputError(testCase.position, "the case has no golden expectation");

    const BackendResult& result = chooseBackend(*ran, backend);
    const std::vector<Plane> planes = readExr(runFolder / result.planesFile);
    std::vector<fs::path> written;
    for (const auto& [file, outputs] : wanted) {
        std::vector<Plane> chosen;
        for (const std::string& output : outputs) {
            const auto plane = std::find_if(planes.begin(), planes.end(),
                                            [&](const Plane& candidate) { return candidate.name == output; });
            if (plane == planes.end()) {
                throw InputError({(runFolder / result.planesFile).string(), 0, 0},
                                 fmt::format("has no plane \"{}\"", output));
            }
            chosen.push_back(*plane);
        }
        std::error_code failure;
        fs::create_directories(file.parent_path(), failure);
        writeExr(file, chosen, {{"case", testCase.name}});
        fs::path sidecar = file;
        sidecar += ".json";
        writeFileWhole(sidecar, formatSidecar(run, testCase.name, result, outputs));
        written.push_back(file);
        written.push_back(sidecar);
    }
    return written;
}

std::string describeGoldenOrigin(const fs::path& golden, const Fingerprint& here)
{
    fs::path sidecar = golden;
    sidecar += ".json";
    const std::string unknown = fmt::format("where {} was recorded is not known: ", golden.filename().string());
    const std::optional<std::string> text = readText(sidecar);
    if (!text) return unknown + fmt::format("it has no {}", sidecar.filename().string());
    try {
        const nlohmann::json json = nlohmann::json::parse(*text);
        const nlohmann::json& print = json.at("fingerprint");
        const std::string backend = json.at("backend").get<std::string>();
        std::string differences;
        const auto compare = [&](const char* key, const std::string& value) {
            const std::string recorded = print.at(key).get<std::string>();
            if (recorded == value) return;
            differences +=
                fmt::format("{}{} \"{}\", here \"{}\"", differences.empty() ? "" : "; ", key, recorded, value);
        };
        if (backend != here.backend) differences = fmt::format("backend {}, here {}", backend, here.backend);
        compare("api", here.api);
        compare("device", here.device);
        compare("driver", here.driver);
        compare("llvm", here.llvm);
        compare("cpu", here.cpu);
        if (differences.empty()) return {};
        return fmt::format("{} was recorded under another fingerprint: {}", golden.filename().string(), differences);
    } catch (const nlohmann::json::exception&) {
        return unknown + fmt::format("{} does not say it", sidecar.filename().string());
    }
}

} // namespace crossray
