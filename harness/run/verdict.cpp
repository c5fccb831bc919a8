#include "harness/run/verdict.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>

namespace crossray {

namespace {

bool hasFailed(const ExpectationResult& expectation)
{
    return expectation.judged && !expectation.comparison.passed;
}

// The share of failed pixels says which failure to show first.
double severityOf(const ExpectationResult& expectation)
{
    const Comparison& comparison = expectation.comparison;
    if (comparison.compared == 0) return 0;
    return static_cast<double>(comparison.failed) / static_cast<double>(comparison.compared);
}

Judgement judgeMustFail(const BackendResult& result)
{
    for (const ExpectationResult& expectation : result.expectations) {
        if (expectation.judged && expectation.comparison.passed) {
            return {Verdict::kFail, fmt::format("{}: {} passed in a case that must fail", expectation.position.format(),
                                                expectation.output)};
        }
    }
    return {Verdict::kPass, {}};
}

Judgement judgeExpectations(const BackendResult& result)
{
    const ExpectationResult* worst = nullptr;
    int failed = 0;
    for (const ExpectationResult& expectation : result.expectations) {
        if (!hasFailed(expectation)) continue;
        ++failed;
        if (worst == nullptr || severityOf(expectation) > severityOf(*worst)) worst = &expectation;
    }
    if (worst == nullptr) return {Verdict::kPass, {}};
    const std::string others = failed > 1 ? fmt::format(" (and {} more)", failed - 1) : "";
    return {Verdict::kFail, fmt::format("{}: {}{}", worst->output, worst->comparison.reason, others)};
}

} // namespace

Judgement judgeAnswer(const Case& testCase, const BackendResult& result, bool isReference)
{
    if (!result.messages.empty()) {
        return {Verdict::kFail, fmt::format("validation: {}", result.messages.front())};
    }
    for (const ExpectationResult& expectation : result.expectations) {
        if (expectation.missingGolden) {
            return {Verdict::kMissingGolden,
                    fmt::format("{}: {}: {}", expectation.position.format(), expectation.source, expectation.note)};
        }
    }
    const auto& all = result.expectations;
    if (std::none_of(all.begin(), all.end(), [](const auto& expectation) { return expectation.judged; })) {
        if (isReference) return {Verdict::kPass, {}};
        const std::string why = all.empty() ? "no expectation speaks of this backend" : all.front().note;
        return {Verdict::kSkip, why};
    }
    return testCase.mustFail ? judgeMustFail(result) : judgeExpectations(result);
}

Judgement applyKnownFailures(const Case& testCase, const std::string& backend, std::string_view today,
                             Judgement judgement)
{
    const bool failed = tallyOf(judgement.verdict) == Tally::kFailed && judgement.verdict != Verdict::kMissingGolden;
    const bool passed = judgement.verdict == Verdict::kPass;
    if (!failed && !passed) return judgement;
    for (const KnownFailure& known : testCase.knownFailures) {
        const bool isMeant = known.backends.empty() ||
                             std::find(known.backends.begin(), known.backends.end(), backend) != known.backends.end();
        if (!isMeant) continue;
        if (known.until < today) {
            if (failed) judgement.reason += fmt::format(" (known failure {} ended on {})", known.issue, known.until);
            continue;
        }
        if (passed) {
            return {Verdict::kUnknownPass,
                    fmt::format("passes, although {} says that it fails until {}: remove the entry", known.issue,
                                known.until)};
        }
        return {Verdict::kKnownFail,
                fmt::format("{} until {}: {} ({})", known.issue, known.until, known.reason, judgement.reason)};
    }
    return judgement;
}

std::string formatToday()
{
    return fmt::format("{:%Y-%m-%d}",
                       fmt::gmtime(std::chrono::system_clock::to_time_t(std::chrono::system_clock::now())));
}

} // namespace crossray
