#include "harness/cli/progress.h"

#include "harness/cli/failure_text.h"

#include <fmt/format.h>

#include <unistd.h>

namespace crossray {

ProgressMode chooseProgress(ProgressMode mode)
{
    if (mode != ProgressMode::kAuto) return mode;
    return isTerminal(STDERR_FILENO) ? ProgressMode::kBar : ProgressMode::kLines;
}

std::string formatCaseLine(const CaseResult& testCase, const Style& style)
{
    std::map<Verdict, std::string> backendsOf;
    double milliseconds = testCase.prepareMs + testCase.compileMs;
    int ran = 0;
    bool failed = false, passed = false;
    for (const BackendResult& result : testCase.backends) {
        milliseconds += result.times.worker + result.times.judge;
        failed = failed || tallyOf(result.verdict) == Tally::kFailed;
        passed = passed || result.verdict == Verdict::kPass;
        if (result.verdict != Verdict::kSkip) ++ran;
        std::string& list = backendsOf[result.verdict];
        list += list.empty() ? result.backend : " " + result.backend;
    }
    const std::string label = failed   ? style.paint(Ink::kRed, "FAIL ")
                              : passed ? style.paint(Ink::kGreen, "pass ")
                                       : style.paint(Ink::kYellow, "skip ");
    std::string others;
    for (const auto& [verdict, backends] : backendsOf) {
        if (verdict != Verdict::kPass && verdict != Verdict::kSkip)
            others += fmt::format(", {}: {}", nameOf(verdict), backends);
    }
    const std::string from =
        testCase.answeredBy.empty() ? fmt::format("{:.0f} ms", milliseconds) : "from the " + testCase.answeredBy;
    return fmt::format("{} {:<44} {} backend{}{}, {}\n", label, testCase.name, ran, ran == 1 ? "" : "s", others, from);
}

void Progress::startBackend(const std::string& backend, const CaseResult& testCase)
{
    current_ = testCase.name + " on " + backend;
}

void Progress::finishBackend(const CaseResult& testCase, const BackendResult& result)
{
    ++finished_;
    switch (tallyOf(result.verdict)) {
    case Tally::kPassed:
        ++counts_.passed;
        break;
    case Tally::kFailed:
        ++counts_.failed;
        break;
    case Tally::kSkipped:
        ++counts_.skipped;
        break;
    }
    if (tallyOf(result.verdict) == Tally::kFailed) {
        // One broken shader breaks many cases; it is told once in full.
        const bool isNew = result.verdict != Verdict::kError || shownErrors_.insert(result.reason).second;
        if (!isNew) {
            ++repeatedErrors_;
            return;
        }
        printText(formatFailure(testCase, result, options_.style, options_.verbose, options_.caseFolder));
    } else if (options_.verbose) {
        printText(fmt::format("{:<14} {}  {}  {:.1f} ms{}{}\n", nameOf(result.verdict), testCase.name, result.backend,
                              result.times.worker, result.reason.empty() ? "" : "  ", result.reason));
    }
}

void Progress::finishCase(const CaseResult& testCase)
{
    ++finishedCases_;
    if (options_.mode == ProgressMode::kLines && !options_.quiet && !options_.verbose) {
        printText(formatCaseLine(testCase, options_.style));
    }
}

std::string Progress::formatBar(int width, double seconds) const
{
    const double done =
        options_.resultCount == 0 ? 1.0 : static_cast<double>(finished_) / static_cast<double>(options_.resultCount);
    constexpr int kCells = 20;
    const int filled = static_cast<int>(done * kCells);
    const std::string bar =
        std::string(static_cast<size_t>(filled), '#') + std::string(static_cast<size_t>(kCells - filled), '-');
    // The first verdicts carry the workers' start; before a few are in, no guess is worth showing.
    const std::string left =
        finished_ < 5 || done <= 0 ? "" : fmt::format(", {:.0f} s left", seconds * (1 - done) / done);
    const std::string failed = counts_.failed > 0 ? fmt::format(", {} failed", counts_.failed) : "";
    const std::string text = fmt::format("[{}] {}/{} cases, {} passed{}{}  {}", bar, finishedCases_, options_.caseCount,
                                         counts_.passed, failed, left, current_);
    return clip(text, width - 1);
}

void Progress::tick()
{
    if (options_.mode != ProgressMode::kBar || options_.quiet) return;
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    fmt::print(options_.bar, "\r\x1b[2K{}", formatBar(terminalWidth(fileno(options_.bar)), seconds));
    std::fflush(options_.bar);
    barIsShown_ = true;
}

void Progress::clearBar()
{
    if (!barIsShown_) return;
    fmt::print(options_.bar, "\r\x1b[2K");
    std::fflush(options_.bar);
    barIsShown_ = false;
}

void Progress::finish()
{
    clearBar();
    if (repeatedErrors_ > 0) printText(fmt::format("ERROR {} more with the errors above\n", repeatedErrors_));
}

void Progress::printText(const std::string& text)
{
    clearBar();
    fmt::print(options_.text, "{}", text);
    std::fflush(options_.text);
}

} // namespace crossray
