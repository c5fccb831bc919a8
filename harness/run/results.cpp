#include "harness/run/results.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace crossray {

namespace {

struct VerdictInfo {
    Verdict verdict;
    std::string_view name;
    Tally tally;
};

constexpr std::array kVerdicts{
    VerdictInfo{Verdict::kPass, "pass", Tally::kPassed},
    VerdictInfo{Verdict::kFail, "fail", Tally::kFailed},
    VerdictInfo{Verdict::kError, "error", Tally::kFailed},
    VerdictInfo{Verdict::kCrash, "crash", Tally::kFailed},
    VerdictInfo{Verdict::kTimeout, "timeout", Tally::kFailed},
    VerdictInfo{Verdict::kSkip, "skip", Tally::kSkipped},
    VerdictInfo{Verdict::kKnownFail, "known-fail", Tally::kSkipped},
    VerdictInfo{Verdict::kUnknownPass, "unknown-pass", Tally::kFailed},
    VerdictInfo{Verdict::kMissingGolden, "missing-golden", Tally::kFailed},
};

constexpr auto kVerdictValues = [] {
    std::array<Verdict, kVerdicts.size()> values{};
    std::transform(kVerdicts.begin(), kVerdicts.end(), values.begin(), [](const auto& info) { return info.verdict; });
    return values;
}();

} // namespace

std::span<const Verdict> allVerdicts()
{
    return kVerdictValues;
}

std::string_view nameOf(Verdict verdict)
{
    return kVerdicts[static_cast<size_t>(verdict)].name;
}

std::optional<Verdict> findVerdict(std::string_view name)
{
    for (const VerdictInfo& info : kVerdicts) {
        if (info.name == name) return info.verdict;
    }
    return std::nullopt;
}

Tally tallyOf(Verdict verdict)
{
    return kVerdicts[static_cast<size_t>(verdict)].tally;
}

void addToCounts(RunCounts& counts, const CaseResult& testCase)
{
    for (const BackendResult& result : testCase.backends) {
        ++counts.byVerdict[result.verdict];
        switch (tallyOf(result.verdict)) {
        case Tally::kPassed:
            ++counts.passed;
            break;
        case Tally::kFailed:
            ++counts.failed;
            break;
        case Tally::kSkipped:
            ++counts.skipped;
            break;
        }
    }
}

RunCounts countVerdicts(const RunResult& run)
{
    if (run.countsOfAll) return *run.countsOfAll;
    RunCounts counts;
    for (const CaseResult& testCase : run.cases)
        addToCounts(counts, testCase);
    return counts;
}

namespace {

double shareOf(const Comparison& comparison)
{
    if (comparison.compared == 0) return 0;
    return static_cast<double>(comparison.failed) / static_cast<double>(comparison.compared);
}

} // namespace

const ExpectationResult* findWorstExpectation(const CaseResult& testCase, const BackendResult& result)
{
    const ExpectationResult* worst = nullptr;
    for (const ExpectationResult& expectation : result.expectations) {
        const bool failed = expectation.judged && expectation.comparison.passed == testCase.mustFail;
        if (!failed && !expectation.missingGolden) continue;
        if (worst == nullptr || shareOf(expectation.comparison) > shareOf(worst->comparison)) worst = &expectation;
    }
    return worst;
}

std::string formatCounts(const RunCounts& counts)
{
    return fmt::format("{} passed, {} failed, {} skipped", counts.passed, counts.failed, counts.skipped);
}

ExitCode computeExitCode(const RunResult& run)
{
    if (run.interrupted) return ExitCode::kInterrupted;
    const bool lacksDevice = std::any_of(run.backends.begin(), run.backends.end(),
                                         [](const auto& item) { return !item.second.environmentError.empty(); });
    if (lacksDevice) return ExitCode::kEnvironment;
    if (!run.brokenFiles.empty()) return ExitCode::kUsage;
    if (!run.missingParts.empty()) return ExitCode::kFailed;
    return countVerdicts(run).failed > 0 ? ExitCode::kFailed : ExitCode::kAsExpected;
}

} // namespace crossray
