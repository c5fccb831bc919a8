#include "harness/base/cpu_info.h"

#include <fstream>
#include <iterator>
#include <sstream>

namespace crossray {
namespace {

std::string collapseSpaces(std::string_view text)
{
    std::string result;
    std::istringstream words{std::string(text)};
    for (std::string word; words >> word;) {
        if (!result.empty()) result += ' ';
        result += word;
    }
    return result;
}

// Value of the first "name : value" line; empty when there is none.
std::string findField(std::string_view text, std::string_view name)
{
    while (!text.empty()) {
        const std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(line.size() < text.size() ? line.size() + 1 : line.size());
        const size_t colon = line.find(':');
        if (colon == std::string_view::npos) continue;
        if (collapseSpaces(line.substr(0, colon)) == name) return collapseSpaces(line.substr(colon + 1));
    }
    return {};
}

} // namespace

std::string parseCpuInfo(std::string_view text)
{
    const std::string vendor = findField(text, "vendor_id");
    const std::string model = findField(text, "model name");
    if (!vendor.empty() && !model.empty()) return vendor + " " + model;
    if (!vendor.empty() || !model.empty()) return vendor + model;
    const std::string implementer = findField(text, "CPU implementer");
    const std::string part = findField(text, "CPU part");
    if (!implementer.empty() && !part.empty()) return "ARM implementer " + implementer + " part " + part;
    return "unknown";
}

std::string readCpuInfo()
{
    std::ifstream file("/proc/cpuinfo");
    return parseCpuInfo(std::string(std::istreambuf_iterator<char>(file), {}));
}

} // namespace crossray
