#include "harness/cli/browser.h"
#include "harness/cli/verbs.h"

#include "harness/base/text.h"
#include "harness/report/report.h"
#include "harness/run/run_at_hand.h"
#include "harness/run/run_json.h"

#include <fmt/format.h>

namespace crossray {

namespace fs = std::filesystem;

namespace {

std::string readJsonText(const std::string& file)
{
    std::optional<std::string> text = readText(file);
    if (!text) throw InputError({file, 0, 0}, "there is no such file; allowed are JSON files that crossray wrote");
    return std::move(*text);
}

fs::path chooseTarget(const ReportVerbOptions& options, const fs::path& runFolder)
{
    if (!options.isSingle) return options.output.empty() ? runFolder / "report" : fs::path(options.output);
    if (options.output.empty()) return runFolder / "report.html";
    const fs::path given = options.output;
    return given.extension() == ".html" ? given : given / "report.html";
}

} // namespace

int reportRun(const ReportVerbOptions& options)
{
    const fs::path file = findRunJson(options.run);
    const fs::path runFolder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    const RunAtHand atHand = readRunAtHand(options.run);
    const RunResult& run = atHand.run;
    ReportOptions report;
    if (std::string left = describeLeftOut(run.cases.size(), atHand.cases); !left.empty())
        report.leftOut.push_back(std::move(left));
    report.isSingle = options.isSingle;
    report.runFolder = runFolder.generic_string();
    for (const std::string& trace : options.traces)
        report.traces.push_back({trace, readJsonText(trace)});
    for (const std::string& bench : options.benches)
        report.benches.push_back({bench, readJsonText(bench)});
    for (const std::string& cubemap : options.cubemaps)
        report.cubemaps.push_back({cubemap, readCubemap(cubemap)});
    const fs::path target = chooseTarget(options, runFolder);
    const ReportSummary summary = writeReport(run, runFolder, target, report);
    for (const std::string& line : summary.leftOut)
        fmt::print("left out: {}\n", line);
    const fs::path page = options.isSingle ? target : target / "index.html";
    fmt::print("{}: {} in {} file{}, {:.1f} MB\n", page.generic_string(), formatCounts(countVerdicts(run)),
               summary.files, summary.files == 1 ? "" : "s", static_cast<double>(summary.bytes) * 1e-6);
    if (options.open) openInBrowser(fs::absolute(page).string());
    return static_cast<int>(ExitCode::kAsExpected);
}

} // namespace crossray
