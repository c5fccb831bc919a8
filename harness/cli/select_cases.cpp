#include "harness/cli/verbs.h"
#include "harness/run/plan.h"
#include "harness/run/run_json.h"

#include <fmt/format.h>

namespace crossray {

namespace {

std::set<std::string> readLastFailures(const std::string& lastRun)
{
    std::set<std::string> names;
    for (const CaseResult& testCase : readRun(lastRun).cases) {
        for (const BackendResult& result : testCase.backends) {
            if (tallyOf(result.verdict) == Tally::kFailed) names.insert(testCase.name);
        }
    }
    return names;
}

} // namespace

SelectedCases selectCases(const SelectionOptions& options, const std::string& caseRoot, const std::string& lastRun,
                          bool keepGoing)
{
    Selection selection;
    selection.arguments = options.arguments;
    selection.tags = options.tags;
    if (!options.expression.empty()) selection.expression = KeyExpression::parse(options.expression);
    if (!options.shard.empty()) selection.shard = Shard::parse(options.shard);
    if (options.lastFailed) selection.names = readLastFailures(lastRun);

    PlanResult made = makePlan(selection, caseRoot);
    SelectedCases selected;
    for (const BrokenFile& broken : made.plan.broken) {
        selected.broken.push_back(broken.line);
        fmt::print(stderr, "{}\n", broken.line);
    }
    for (const std::string& line : made.unmatched)
        fmt::print(stderr, "crossray: {}\n", line);
    selected.cases = std::move(made.plan.cases);
    if (!selected.broken.empty() && !keepGoing) {
        selected.exitCode = ExitCode::kUsage;
    } else if (!made.unmatched.empty()) {
        selected.exitCode = ExitCode::kNothingSelected;
    } else if (selected.cases.empty()) {
        if (selected.broken.empty()) fmt::print(stderr, "crossray: no case is selected\n");
        selected.exitCode = selected.broken.empty() ? ExitCode::kNothingSelected : ExitCode::kUsage;
    }
    return selected;
}

} // namespace crossray
