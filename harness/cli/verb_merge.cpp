#include "harness/cli/verbs.h"

#include "harness/report/report.h"
#include "harness/run/inputs.h"
#include "harness/run/merge.h"

#include <fmt/format.h>

namespace crossray {

namespace fs = std::filesystem;

namespace {

void writePages(const MergedRun& merged, const MergeVerbOptions& options)
{
    ReportOptions report;
    report.runFolder = options.output;
    if (std::string left = describeLeftOut(merged.run.cases.size(), merged.cases); !left.empty())
        report.leftOut.push_back(std::move(left));
    try {
        writeReport(merged.run, options.output, fs::path(options.output) / "report", report);
    } catch (const Error& error) {
        fmt::print(stderr, "crossray: no report: {}\n", error.what());
    }
}

} // namespace

int mergeRuns(const GlobalOptions& global, const MergeVerbOptions& options)
{
    MergeOptions merge;
    merge.inputs.assign(options.runs.begin(), options.runs.end());
    merge.output = options.output;
    merge.junit = options.junit;
    merge.isPartial = options.isPartial;
    const PassedCases passedBefore = readPassedCases(options.output);
    const MergedRun merged = mergeRuns(merge, global.commandLine);
    const RunResult& run = merged.run;
    if (options.report) writePages(merged, options);
    // What --changed reads; for runs beyond what is at hand nobody would.
    if (!run.validation && run.cases.size() == merged.cases)
        writePassedCases(options.output, mergePassedCases(passedBefore, run));

    for (const std::string& note : merged.notes)
        fmt::print(stderr, "crossray: {}\n", note);
    for (const std::string& shard : run.missingParts)
        fmt::print(stderr, "crossray: shard {} is missing\n", shard);
    if (!options.quiet) {
        fmt::print("{} cases of {} shards; results in {}/run.json{}\n", merged.cases, run.parts.size(), options.output,
                   options.report ? fmt::format(", pages in {}/report/index.html", options.output) : "");
    }
    fmt::print("{}\n", formatCounts(countVerdicts(run)));
    return run.exitCode;
}

} // namespace crossray
