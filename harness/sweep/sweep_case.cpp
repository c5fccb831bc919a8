// The case at a value of the parameter, through the reader that a file goes through.
#include "harness/case/build.h"
#include "harness/case/case_tree.h"
#include "harness/sweep/sweep.h"

#include <fmt/format.h>

#include <algorithm>

namespace crossray {

namespace {

// As it would stand in the file.
std::string formatTomlNumber(double value, bool isInteger)
{
    return isInteger ? fmt::format("{:.0f}", value) : fmt::format("{}", value);
}

void requireOutput(Case& testCase, std::string_view name)
{
    const auto place =
        std::find_if(testCase.outputs.begin(), testCase.outputs.end(),
                     [&, id = findOutput(name)->id](const OutputInfo& output) { return output.id >= id; });
    if (place != testCase.outputs.end() && place->name == name) return;
    testCase.outputs.insert(place, *findOutput(name));
}

} // namespace

Case makeCaseAt(const SweepPlan& plan, double value)
{
    KeyValues values;
    for (const auto& [path, text] : plan.overrides)
        values[path] = parseOverride(path, text);
    for (const std::string& path : plan.keys.paths)
        values[path] = parseOverride(path, formatTomlNumber(value, plan.keys.isInteger));
    Case testCase = readCaseTree(plan.file, plan.caseName, values).testCase;
    for (const std::string_view name : {"HitSuccess", "HitReason", "IterationCount"})
        requireOutput(testCase, name);
    return testCase;
}

} // namespace crossray
