#include "harness/cli/trace_text.h"
#include "harness/cli/verbs.h"
#include "harness/inspect/trace_json.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <unistd.h>

#include <algorithm>

namespace crossray {

namespace {

constexpr size_t kShownNames = 4;

// The one case of that name. Throws InputError where it stands for several.
const Case& chooseOne(const std::string& name, const std::vector<Case>& cases)
{
    const auto exact = std::find_if(cases.begin(), cases.end(), [&](const Case& each) { return each.name == name; });
    if (exact != cases.end()) return *exact;
    if (cases.size() == 1) return cases.front();
    std::vector<std::string> names;
    for (size_t i = 0; i < std::min(cases.size(), kShownNames); ++i)
        names.push_back(cases[i].name);
    throw InputError(fmt::format("{} stands for {} cases; name one: {}{}", name, cases.size(), fmt::join(names, ", "),
                                 cases.size() > kShownNames ? ", ..." : ""));
}

} // namespace

int traceCase(const GlobalOptions& global, const TraceOptions& options)
{
    const glm::ivec2 pixel = parsePixel(options.pixel);
    const std::vector<std::string> wanted =
        options.backends.empty() ? std::vector<std::string>{"lavapipe"} : options.backends;
    const BackendChoice backends = chooseBackends(wanted, listBackends());
    if (backends.names.size() > 2) {
        throw InputError(
            fmt::format("--backend: {} backends; one is shown alone, two side by side", backends.names.size()));
    }
    const Folders folders = findFolders(global.shaders, global.cases, global.cache);
    const SelectedCases selected = selectCases({{options.testCase}, {}, {}, {}, false}, folders.cases, {}, false);
    if (selected.exitCode) return static_cast<int>(*selected.exitCode);
    const Case& testCase = chooseOne(options.testCase, selected.cases);
    const PixelTrace trace = tracePixel(testCase, pixel, backends.names, folders);
    if (options.json) {
        fmt::print("{}", formatTraceJson(trace));
    } else {
        fmt::print("{}", formatTrace(trace, Style::choose(global.color, STDOUT_FILENO)));
    }
    return static_cast<int>(ExitCode::kAsExpected);
}

} // namespace crossray
