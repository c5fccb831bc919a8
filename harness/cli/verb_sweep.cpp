#include "harness/bench/chart.h"
#include "harness/cli/verbs.h"
#include "harness/run/environment.h"
#include "harness/sweep/sweep.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

namespace crossray {

namespace {

namespace fs = std::filesystem;

constexpr const char* kListName = "sweeps.toml";

std::map<std::string, std::string> parseOverrides(const std::vector<std::string>& words)
{
    std::map<std::string, std::string> overrides;
    for (const std::string& word : words) {
        const size_t equals = word.find('=');
        if (equals == 0 || equals == std::string::npos)
            throw InputError(fmt::format("--set {}: allowed is KEY=VALUE, such as camera.depth=standard", word));
        overrides[word.substr(0, equals)] = word.substr(equals + 1);
    }
    return overrides;
}

std::string defaultId(const std::string& caseName, const std::string& parameter)
{
    std::string id = caseName + "_" + parameter;
    for (char& c : id) {
        const bool isPlain = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
        if (!isPlain) c = '_';
    }
    return id;
}

std::string quoted(const std::string& word)
{
    return word.find_first_of(" []\"'*") == std::string::npos ? word : fmt::format("'{}'", word);
}

std::string commandOf(const ListedSweep& sweep)
{
    std::string text =
        fmt::format("crossray sweep {} {} {}", quoted(sweep.testCase), quoted(sweep.parameter), sweep.range);
    for (const auto& [path, value] : sweep.overrides)
        text += " --set " + quoted(fmt::format("{}={}", path, value));
    return text;
}

// Sets the exit code where there is no such case.
struct FoundPlan {
    SweepPlan plan;
    std::string summary;
    std::optional<ExitCode> exitCode;
};
FoundPlan findPlan(const ListedSweep& sweep, double width, const fs::path& caseRoot)
{
    FoundPlan found;
    SweepPlan& plan = found.plan;
    plan.keys = SweepKeys::parse(sweep.parameter);
    plan.range = SweepRange::parse(sweep.range);
    const SelectedCases selected = selectCases({{sweep.testCase}, {}, {}, {}, false}, caseRoot, {}, false);
    found.exitCode = selected.exitCode;
    if (found.exitCode) return found;
    const Case& first = selected.cases.front();
    for (const Case& other : selected.cases) {
        if (other.file == first.file) continue;
        throw InputError(fmt::format("\"{}\" is several cases, {} and {} among them; one is allowed", sweep.testCase,
                                     first.name, other.name));
    }
    plan.file = first.file;
    // Several cases of one file are one case where the parameter is what they differ in.
    plan.caseName = selected.cases.size() == 1 ? first.name : first.name.substr(0, first.name.find('['));
    plan.parameter = sweep.parameter;
    plan.overrides = sweep.overrides;
    plan.width = width;
    found.summary = first.summary;
    return found;
}

// A NaN, an infinity or a backend without an answer.
bool hasFinding(const SweepResult& result)
{
    return std::any_of(result.rows.begin(), result.rows.end(), [](const SweepRow& row) {
        return std::any_of(row.cells.begin(), row.cells.end(),
                           [](const SweepCell& cell) { return cell.notFinite > 0 || !cell.failure.empty(); });
    });
}

std::string readmeOf(const std::vector<ListedSweep>& sweeps, const std::vector<SweepResult>& results)
{
    std::string text = "# Sweeps\n\nOne parameter of a case, run through the edge where its method fails, on every "
                       "backend. `crossray sweep --all -o DIR` makes this folder\nagain from `cases/sweeps.toml`; each "
                       "curve's numbers stand in the CSV file beside it. A backend's curve that cannot be seen lies\n"
                       "under another's.\n";
    for (size_t i = 0; i < sweeps.size(); ++i) {
        const SweepResult& result = results[i];
        text += fmt::format("\n## {}\n\n![{}]({}.svg)\n\n`{}` ([numbers]({}.csv))\n\n**Shows.** {}\n\n**Edge.**",
                            sweeps[i].title, sweeps[i].title, result.id, result.command, result.id, sweeps[i].shows);
        if (result.edges.empty()) text += " None: nothing jumps in this range.";
        for (const SweepEdge& edge : result.edges)
            text += (result.edges.size() > 1 ? "\n- " : " ") + edge.sentence + ".";
        text += fmt::format("\n\n**Why.** {}\n", sweeps[i].why);
    }
    return text;
}

struct SweepTotals {
    size_t values = 0, refused = 0, edges = 0;
    bool hasFinding = false;
};

void addTotals(const SweepResult& result, SweepTotals& totals)
{
    totals.values += result.rows.size();
    totals.refused += static_cast<size_t>(std::count_if(result.rows.begin(), result.rows.end(),
                                                        [](const SweepRow& row) { return !row.refused.empty(); }));
    totals.edges += result.edges.size();
    totals.hasFinding = totals.hasFinding || hasFinding(result);
}

void writeSweep(const SweepResult& result, const SweepVerbOptions& options)
{
    if (!options.csv.empty()) writeTextFile(options.csv, formatSweepCsv(result));
    if (options.output.empty()) return;
    std::error_code ignored; // a file that cannot be written says so itself
    fs::create_directories(options.output, ignored);
    const std::string base = options.output + "/" + result.id;
    writeTextFile(base + ".svg", formatSweepSvg(result));
    writeTextFile(base + ".csv", formatSweepCsv(result));
    if (!options.all) writeTextFile(base + ".json", formatSweepJson(result));
}

std::vector<ListedSweep> findSweeps(const SweepVerbOptions& options, const fs::path& caseRoot)
{
    if (options.all) {
        if (!options.testCase.empty()) throw InputError("sweep: --all takes no case; it reads its list");
        if (!options.csv.empty() || options.json) throw InputError("sweep: --all writes to -o DIR alone");
        std::vector<ListedSweep> sweeps = readSweepList(caseRoot / kListName);
        std::erase_if(sweeps,
                      [&](const ListedSweep& sweep) { return sweep.id.find(options.filter) == std::string::npos; });
        if (sweeps.empty()) throw InputError(fmt::format("sweep: no id in the list contains \"{}\"", options.filter));
        return sweeps;
    }
    if (options.range.empty()) throw InputError("sweep: allowed is CASE PARAM FROM..TO[:STEPS][:log], or --all");
    return {{defaultId(options.testCase, options.parameter), "", options.testCase, options.parameter, options.range,
             parseOverrides(options.overrides), "", ""}};
}

} // namespace

int sweepCase(const GlobalOptions& global, const SweepVerbOptions& options)
{
    const Folders folders = findFolders(global.shaders, global.cases, global.cache);
    const std::vector<ListedSweep> sweeps = findSweeps(options, folders.cases);
    std::vector<std::string> backends = chooseBackends(options.backends, listBackends()).names;
    if (std::find(backends.begin(), backends.end(), "cpu64") == backends.end()) backends.emplace_back("cpu64");

    WorkerOptions workers;
    workers.mesaCacheFolder = folders.cache / "mesa";
    workers.cores = options.jobs > 0 ? options.jobs : countAvailableCores();
    WorkerPool pool(workers);
    ShaderCompiler compiler(folders.cache / "spirv");
    const SweepDevices devices{pool, compiler, folders.shaders, workers.cores};
    FILE* const text = options.json ? stderr : stdout; // JSON stands alone on standard output
    SweepTotals totals;
    std::vector<SweepResult> results;
    for (const ListedSweep& sweep : sweeps) {
        const FoundPlan found = findPlan(sweep, options.width, folders.cases);
        if (found.exitCode) return static_cast<int>(*found.exitCode);
        const auto measure = [&](double value, const std::vector<std::string>& asked) {
            return measureOnDevices(found.plan, value, asked, devices);
        };
        SweepResult result = runSweep(found.plan, backends, measure);
        result.id = sweep.id;
        result.summary = found.summary;
        result.command = commandOf(sweep);
        addTotals(result, totals);
        writeSweep(result, options);
        fmt::print(text, "{}\n", formatSweepTable(result));
        if (options.json) fmt::print("{}", formatSweepJson(result));
        for (SweepRow& row : result.rows)
            row.pixels = {};
        results.push_back(std::move(result));
    }
    if (options.all && !options.output.empty() && options.filter.empty())
        writeTextFile(options.output + "/README.md", readmeOf(sweeps, results));
    fmt::print(text, "{} values, {} refused, {} edges\n", totals.values, totals.refused, totals.edges);
    return static_cast<int>(totals.hasFinding ? ExitCode::kFailed : ExitCode::kAsExpected);
}

} // namespace crossray
