#include "harness/cli/failure_text.h"

#include "harness/base/outputs.h"
#include "harness/inspect/names.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <vector>

namespace crossray {

namespace {

constexpr size_t kShown = 3;         // failed expectations of one result, unless all are asked for
constexpr size_t kShownLogLines = 8; // of a worker that died

std::string_view labelOf(Verdict verdict)
{
    switch (verdict) {
    case Verdict::kFail:
        return "FAIL ";
    case Verdict::kError:
        return "ERROR";
    case Verdict::kCrash:
        return "CRASH";
    case Verdict::kTimeout:
        return "TIME ";
    case Verdict::kUnknownPass:
        return "XPASS";
    case Verdict::kMissingGolden:
        return "GOLD ";
    default:
        return "     ";
    }
}

double severityOf(const Comparison& comparison)
{
    if (comparison.compared == 0) return 0;
    return static_cast<double>(comparison.failed) / static_cast<double>(comparison.compared);
}

std::vector<const ExpectationResult*> collectFailures(const CaseResult& testCase, const BackendResult& result)
{
    std::vector<const ExpectationResult*> failed;
    for (const ExpectationResult& expectation : result.expectations) {
        if (expectation.judged && expectation.comparison.passed == testCase.mustFail) failed.push_back(&expectation);
    }
    std::stable_sort(failed.begin(), failed.end(), [](const auto* a, const auto* b) {
        return severityOf(a->comparison) > severityOf(b->comparison);
    });
    return failed;
}

std::string formatHeadline(const ExpectationResult& expectation)
{
    const Comparison& comparison = expectation.comparison;
    if (comparison.passed) return "passed in a case that must fail";
    if (!comparison.worst || !comparison.metrics.empty() || comparison.compared == 0) return comparison.reason;
    const PixelDifference& worst = *comparison.worst;
    const std::string size = std::isfinite(worst.error) ? fmt::format(" {:.4g} {}", worst.error, comparison.unit) : "";
    return fmt::format("{} of {} px ({:.2f} %), worst{} at ({}, {})", comparison.failed, comparison.compared,
                       100 * severityOf(comparison), size, worst.x, worst.y);
}

std::string formatNumbers(const ExpectationResult& expectation)
{
    const Comparison& comparison = expectation.comparison;
    std::string text;
    if (comparison.worst) {
        text = fmt::format("expected {}  actual {}   ", formatValues(expectation.output, comparison.worst->expected, 6),
                           formatValues(expectation.output, comparison.worst->actual, 6));
    }
    return text + "tolerance " + expectation.tolerance + "   (" + expectation.source + ")";
}

// The case as a verb takes it: by name, or by file where it lies outside the case folder, in which names are looked up.
std::string formatArgument(const CaseResult& testCase, const std::filesystem::path& caseFolder)
{
    const std::string& name = testCase.name;
    const std::string& file = testCase.position.file;
    if (caseFolder.empty() || file.empty()) return quoteForShell(name);
    std::error_code failure;
    const std::filesystem::path below =
        std::filesystem::relative(std::filesystem::weakly_canonical(file, failure),
                                  std::filesystem::weakly_canonical(caseFolder, failure), failure);
    if (!below.empty() && *below.begin() != "..") return quoteForShell(name);
    return quoteForShell(file + name.substr(std::min(name.find('['), name.size())));
}

// What to type next: the ray of the worst pixel, beside the backend that it is held against where it is one; else the
// case once more, with its planes.
std::string formatCommand(const CaseResult& testCase, const BackendResult& result, const ExpectationResult* worst,
                          const std::filesystem::path& caseFolder)
{
    const std::string argument = formatArgument(testCase, caseFolder);
    if (worst != nullptr && worst->comparison.worst) {
        const PixelDifference& pixel = *worst->comparison.worst;
        constexpr std::string_view kAgreement = "agree with ";
        const bool isAgreement = worst->source.starts_with(kAgreement);
        std::string others;
        if (isAgreement) others = fmt::format(",{}", worst->source.substr(kAgreement.size()));
        return fmt::format("crossray trace {} --pixel {},{} --backend {}", argument, pixel.x, pixel.y,
                           quoteForShell(result.backend + others));
    }
    return fmt::format("crossray run {} --backend {} --planes all", argument, quoteForShell(result.backend));
}

std::string indentLines(const std::string& text)
{
    std::string indented;
    size_t start = 0;
    while (start < text.size()) {
        const size_t end = std::min(text.find('\n', start), text.size());
        indented += "      " + text.substr(start, end - start) + "\n";
        start = end + 1;
    }
    return indented;
}

} // namespace

std::string quoteForShell(const std::string& text)
{
    const auto isPlain = [](char character) {
        return std::isalnum(static_cast<unsigned char>(character)) != 0 ||
               std::string_view("/._-:+,%@").find(character) != std::string_view::npos;
    };
    if (!text.empty() && std::all_of(text.begin(), text.end(), isPlain)) return text;
    std::string quoted = "'";
    for (const char character : text)
        quoted += character == '\'' ? "'\\''" : std::string(1, character);
    return quoted + "'";
}

std::string formatValues(const std::vector<double>& values, int digits)
{
    if (values.size() == 1) return fmt::format("{:.{}g}", values[0], digits);
    std::string text = "(";
    for (size_t i = 0; i < values.size(); ++i)
        text += fmt::format("{}{:.{}g}", i == 0 ? "" : ", ", values[i], digits);
    return text + ")";
}

std::string formatValues(std::string_view output, const std::vector<double>& values, int digits)
{
    const std::string number = formatValues(values, digits);
    if (values.size() != 1 || !(values[0] >= 0 && values[0] < 100) || values[0] != std::floor(values[0])) return number;
    const int index = static_cast<int>(values[0]);
    if (output == "HitSuccess" && index <= static_cast<int>(HitClass::kUnknown))
        return fmt::format("{} ({})", nameOf(static_cast<HitClass>(index)), number);
    if (output == "HitReason") return fmt::format("{} ({})", nameOfReason(index), number);
    return number;
}

std::string formatFailure(const CaseResult& testCase, const BackendResult& result, const Style& style, bool all,
                          const std::filesystem::path& caseFolder)
{
    const std::string label = style.paint(Ink::kRed, labelOf(result.verdict));
    const std::string head = fmt::format("{} {}  {}", label, style.paint(Ink::kBold, testCase.name), result.backend);
    const std::vector<const ExpectationResult*> failed = collectFailures(testCase, result);

    // Messages of the validation layer, differing repeats, crashes and errors are no matter of an expectation.
    const bool isComparison = result.verdict == Verdict::kFail && result.messages.empty() && !failed.empty() &&
                              result.reason.find("repeat ") != 0;
    if (!isComparison) {
        const size_t lineEnd = std::min(result.reason.find('\n'), result.reason.size());
        std::string text = fmt::format("{}   {}\n", head, result.reason.substr(0, lineEnd));
        if (lineEnd < result.reason.size()) text += indentLines(result.reason.substr(lineEnd + 1));
        for (size_t i = 1; i < result.messages.size(); ++i)
            text += indentLines(result.messages[i]);
        const size_t skip = all ? 0 : result.logLines.size() - std::min(result.logLines.size(), kShownLogLines);
        for (size_t i = skip; i < result.logLines.size(); ++i)
            text += indentLines(result.logLines[i]);
        return text + fmt::format("      {}   {}\n", style.paint(Ink::kDim, testCase.position.format()),
                                  formatCommand(testCase, result, nullptr, caseFolder));
    }

    std::string text;
    const size_t shown = all ? failed.size() : std::min(failed.size(), kShown);
    for (size_t i = 0; i < shown; ++i) {
        const ExpectationResult& expectation = *failed[i];
        text += i == 0 ? head : "     ";
        text += fmt::format("  {}   {}\n", expectation.output, formatHeadline(expectation));
        text += fmt::format("      {}\n", formatNumbers(expectation));
        if (!expectation.note.empty()) text += fmt::format("      {}\n", expectation.note);
        if (i == 0) {
            text += fmt::format("      {}   {}\n", style.paint(Ink::kDim, expectation.position.format()),
                                formatCommand(testCase, result, &expectation, caseFolder));
        }
    }
    if (shown < failed.size()) text += fmt::format("      and {} more failed expectations\n", failed.size() - shown);
    return text;
}

} // namespace crossray
