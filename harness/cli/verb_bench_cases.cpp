#include "harness/bench/bench_report.h"
#include "harness/cli/verbs.h"
#include "harness/run/environment.h"

#include <fmt/format.h>

#include <filesystem>

namespace crossray {

namespace {

std::string joinCommand(const std::vector<std::string>& words)
{
    std::string text = "crossray";
    for (size_t i = 1; i < words.size(); ++i)
        text += words[i].find_first_of(" <>") == std::string::npos ? " " + words[i] : fmt::format(" '{}'", words[i]);
    return text;
}

// Prints the cheapest method within the budget; false when the case's own claim of what it needs does not hold.
bool advise(const BenchScene& scene, const std::string& asked)
{
    if (!asked.empty()) {
        const BenchPoint* const best = chooseMethod(scene, parseBudget(asked));
        fmt::print("advice: {} with {}: {}\n", scene.name, asked,
                   best == nullptr ? "no method keeps it" : best->method);
    }
    if (scene.needs.empty()) return true;
    const BenchPoint* const best = chooseMethod(scene, parseBudget(scene.budget));
    const bool holds = best != nullptr && best->kind == scene.needs;
    fmt::print("needs:  {} says that {} needs {}: {}\n", scene.name, scene.budget, scene.needs,
               holds             ? "so it is"
               : best == nullptr ? "no method keeps that budget"
                                 : fmt::format("{} keeps it", best->method));
    return holds;
}

// False when something got worse by more than the share.
bool compareWithBase(const BenchResult& result, const BenchCasesOptions& options)
{
    bool isGood = true;
    size_t moved = 0;
    for (const BenchChange& change : compareBenches(readBenchJson(options.compare), result, options.loss)) {
        fmt::print("{} {}\n", change.isLoss ? "LOSS " : "moved", change.text);
        isGood = isGood && !change.isLoss;
        ++moved;
    }
    if (moved == 0) fmt::print("nothing moved since {}\n", options.compare);
    return isGood;
}

} // namespace

int benchCases(const GlobalOptions& global, const BenchCasesOptions& options)
{
    const Folders folders = findFolders(global.shaders, global.cases, global.cache);
    const std::vector<std::string> wanted{options.backend};
    const BackendChoice backends = chooseBackends(wanted, listBackends());
    SelectionOptions selection;
    selection.arguments = options.cases;
    const SelectedCases selected = selectCases(selection, folders.cases, "", false);
    if (selected.exitCode) return static_cast<int>(*selected.exitCode);
    if (!options.budget.empty()) { // before minutes are spent
        for (const Case& testCase : selected.cases)
            checkBudget(parseBudget(options.budget), testCase);
    }

    std::vector<BenchMethod> own;
    for (const std::string& method : options.methods)
        own.push_back(makeOwnMethod(method));

    WorkerOptions workers;
    workers.mesaCacheFolder = folders.cache / "mesa";
    WorkerPool pool(workers);
    ShaderCompiler compiler(folders.cache / "spirv");
    BenchOptions bench;
    bench.backend = backends.names.front();
    bench.rounds = options.rounds;
    bench.jitter = options.jitter;
    bench.own = std::move(own);
    BenchResult result;
    result.command = joinCommand(global.commandLine);
    result.fingerprint = pool.fingerprint(bench.backend);
    fmt::print("{} ({}, {}), {}, {} round{}\n", result.fingerprint.device, result.fingerprint.api,
               result.fingerprint.driver, result.fingerprint.cpu, bench.rounds, bench.rounds == 1 ? "" : "s");
    bool isGood = true;
    size_t methods = 0;
    for (const Case& testCase : selected.cases) {
        fmt::print(stderr, "crossray: {}\n", testCase.name);
        const BenchScene scene = benchCase(testCase, bench, pool, compiler, folders);
        fmt::print("\n{}", formatBenchTable(scene));
        isGood = advise(scene, options.budget) && isGood;
        methods += scene.points.size();
        result.scenes.push_back(scene);
    }
    if (!options.output.empty()) {
        const std::vector<Chart> charts = makeBenchCharts(result);
        writeCharts(options.output, charts);
        writeTextFile(options.output + "/bench.json", formatBenchJson(result));
        writeTextFile(options.output + "/bench.csv", formatBenchCsv(result));
        writeTextFile(options.output + "/charts.json", formatChartsJson(charts));
        writeTextFile(options.output + "/charts.csv", formatChartsCsv(charts));
    }
    if (!options.compare.empty()) {
        fmt::print("\n");
        isGood = compareWithBase(result, options) && isGood;
    }
    fmt::print("\n{} methods, {} scenes\n", methods, result.scenes.size());
    return static_cast<int>(isGood ? ExitCode::kAsExpected : ExitCode::kFailed);
}

} // namespace crossray
