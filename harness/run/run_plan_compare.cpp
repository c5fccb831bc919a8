// Two plans against each other, as merge does; apart from what a plan is made of.
#include "harness/run/run_plan.h"

#include "harness/base/hash.h"

#include <fmt/format.h>

#include <algorithm>

namespace crossray {

std::string hashNames(std::vector<std::string> names)
{
    std::sort(names.begin(), names.end());
    Hasher hasher;
    for (const std::string& name : names)
        hasher.addString(name);
    return hasher.finish().hex();
}

std::vector<std::string> comparePlans(const RunPlan& first, const RunPlan& second)
{
    std::vector<std::string> differences;
    if (first.names != second.names || first.cases != second.cases) {
        differences.push_back(fmt::format("other cases are selected ({} against {})", first.cases, second.cases));
    } else if (first.contents != second.contents) {
        differences.push_back("the files of the cases differ");
    }
    if (first.shaders != second.shaders) differences.push_back("the shaders differ");
    if (first.harness != second.harness) {
        differences.push_back(fmt::format("the harness differs ({} against {})", first.harness, second.harness));
    }
    if (first.options != second.options) {
        differences.push_back(fmt::format("the options differ ({} against {})", first.options, second.options));
    }
    if (first.partition != second.partition) {
        differences.push_back(
            fmt::format("the cases are parted otherwise ({} against {})", first.partition, second.partition));
    }
    return differences;
}

} // namespace crossray
