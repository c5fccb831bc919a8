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

// A run that takes a part of the cases says so, whatever else it is to leave unsaid.
void printPart(const SelectedCases& selected)
{
    const ShardChoice& choice = *selected.shard;
    fmt::print(stderr, "crossray: part {} of {}{}: {} of {} cases\n", choice.shard.index, choice.shard.count,
               choice.source.empty() ? "" : fmt::format(" ({})", choice.source), selected.plan.ownCases,
               selected.plan.cases);
}

} // namespace

SelectedCases selectCases(const SelectionOptions& options, const std::string& caseRoot, const std::string& lastRun,
                          bool keepGoing)
{
    Selection selection;
    selection.arguments = options.arguments;
    selection.tags = options.tags;
    if (!options.expression.empty()) selection.expression = KeyExpression::parse(options.expression);
    SelectedCases selected;
    if (!options.shard.empty()) {
        selected.shard = chooseShard(options.shard, readEnvironment);
        selection.shard = selected.shard->shard;
    }
    if (!options.timings.empty()) {
        if (!selection.shard) throw InputError("--timings parts the cases of a shard: allowed beside --shard alone");
        selection.timings = readTimings(options.timings);
    }
    if (options.lastFailed) selection.names = readLastFailures(lastRun);

    PlanResult made = makePlan(selection, caseRoot);
    selected.plan = made.plan.common;
    for (const BrokenFile& broken : made.plan.broken) {
        selected.broken.push_back(broken.line);
        fmt::print(stderr, "{}\n", broken.line);
    }
    for (const std::string& line : made.unmatched)
        fmt::print(stderr, "crossray: {}\n", line);
    selected.cases = std::move(made.plan.cases);
    if (selected.shard) printPart(selected);
    if (!selected.broken.empty() && !keepGoing) {
        selected.exitCode = ExitCode::kUsage;
    } else if (!made.unmatched.empty()) {
        selected.exitCode = ExitCode::kNothingSelected;
    } else if (selected.plan.cases == 0) { // a part may be empty
        if (selected.broken.empty()) fmt::print(stderr, "crossray: no case is selected\n");
        selected.exitCode = selected.broken.empty() ? ExitCode::kNothingSelected : ExitCode::kUsage;
    }
    return selected;
}

} // namespace crossray
