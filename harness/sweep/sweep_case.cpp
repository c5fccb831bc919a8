// The case at a value of the parameter, through the reader that a file goes through.
#include "harness/base/error.h"
#include "harness/sweep/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace crossray {

namespace {

// "ior=1.2", "size=5x7" of "name[ior=1.2,size=5x7]".
std::set<std::string> labelsOf(const std::string& name)
{
    std::set<std::string> labels;
    const size_t bracket = name.find('[');
    if (bracket == std::string::npos) return labels;
    std::string rest = name.substr(bracket + 1, name.size() - bracket - 2);
    while (true) {
        const size_t comma = rest.find(',');
        labels.insert(rest.substr(0, comma));
        if (comma == std::string::npos) return labels;
        rest.erase(0, comma + 1);
    }
}

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
    std::map<std::string, std::string> overrides = plan.overrides;
    for (const std::string& path : plan.keys.paths)
        overrides[path] = formatTomlNumber(value, plan.keys.isInteger);
    std::vector<Case> cases = readCaseFile(plan.file, overrides);
    // An override takes its key out of [expand], so a sub-case has lost that label here.
    const std::set<std::string> wanted = labelsOf(plan.caseName);
    std::string names;
    std::vector<Case> chosen;
    for (Case& testCase : cases) {
        const std::set<std::string> labels = labelsOf(testCase.name);
        names += (names.empty() ? "" : ", ") + testCase.name;
        if (cases.size() == 1 || std::includes(wanted.begin(), wanted.end(), labels.begin(), labels.end()))
            chosen.push_back(std::move(testCase));
    }
    if (chosen.size() != 1) {
        throw InputError(fmt::format("\"{}\" is {} cases when {} is set; one is allowed: {}", plan.caseName,
                                     cases.size(), plan.parameter, names));
    }
    Case testCase = std::move(chosen.front());
    for (const std::string_view name : {"HitSuccess", "HitReason", "IterationCount"})
        requireOutput(testCase, name);
    return testCase;
}

} // namespace crossray
