#include "harness/cli/conditioning_text.h"

#include "harness/pass/moved_inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace crossray {

namespace {

constexpr size_t kShownCases = 12;

std::string formatWorst(const ConditioningResult::Output& output)
{
    if (!output.worst) return {};
    const ConditioningResult::Worst& worst = *output.worst;
    const std::string what =
        std::isinf(worst.condition) ? std::string("flips") : fmt::format("{:.3g} ulp", worst.condition);
    return fmt::format(", worst {} at ({}, {}) for an ulp of {}", what, worst.x, worst.y,
                       nameOf(static_cast<InputGroup>(worst.cause)));
}

std::string formatOutput(const ConditioningResult::Output& output)
{
    return fmt::format("{:<16} {} of {} px undecidable, {} fragile; median {:.3g}, 95 % {:.3g}, most {:.3g} ulp{}",
                       output.output, output.undecidable, output.pixels, output.fragile, output.median, output.p95,
                       output.max, formatWorst(output));
}

uint64_t countFindings(const ConditioningResult& conditioning)
{
    uint64_t count = 0;
    for (const ConditioningResult::Output& output : conditioning.outputs)
        count += output.undecidable + output.fragile;
    return count;
}

} // namespace

std::string formatConditioning(const ConditioningResult& conditioning)
{
    std::string text =
        fmt::format("conditioning output ulp for an input ulp; undecidable above {:g}\n", conditioning.bound);
    for (const ConditioningResult::Output& output : conditioning.outputs)
        text += fmt::format("           {}\n", formatOutput(output));
    return text;
}

std::string formatConditioning(const RunResult& run)
{
    std::vector<const CaseResult*> found;
    size_t measured = 0;
    for (const CaseResult& testCase : run.cases) {
        if (!testCase.conditioning || !testCase.conditioning->note.empty()) continue;
        ++measured;
        if (countFindings(*testCase.conditioning) > 0) found.push_back(&testCase);
    }
    if (measured == 0) return {};
    std::stable_sort(found.begin(), found.end(), [](const CaseResult* a, const CaseResult* b) {
        return countFindings(*a->conditioning) > countFindings(*b->conditioning);
    });
    std::string text = fmt::format("conditioning: {} of {} cases have pixels that an ulp of input decides, or that "
                                   "float arithmetic loses\n",
                                   found.size(), measured);
    for (size_t i = 0; i < std::min(found.size(), kShownCases); ++i) {
        text += fmt::format("  {}\n", found[i]->name);
        for (const ConditioningResult::Output& output : found[i]->conditioning->outputs) {
            if (output.undecidable + output.fragile > 0) text += fmt::format("    {}\n", formatOutput(output));
        }
    }
    if (found.size() > kShownCases)
        text += fmt::format("  and {} more: run.json has all\n", found.size() - kShownCases);
    return text;
}

} // namespace crossray
