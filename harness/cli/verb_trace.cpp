#include "harness/cli/trace_text.h"
#include "harness/cli/verbs.h"
#include "harness/inspect/pixel_conditioning.h"
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

void addConditioning(const Case& testCase, const Folders& folders, bool isAskedFor, PixelTrace& trace)
{
    const Camera& camera = testCase.camera;
    if (!isAskedFor && camera.width * camera.height > kMeasuredUnasked) {
        trace.conditioningNote =
            fmt::format("{} x {} pixels take their time; --conditioning measures them", camera.width, camera.height);
        return;
    }
    const Conditioning conditioning = measureConditioning(testCase, folders);
    trace.conditioningNote = conditioning.note;
    const size_t pixel =
        static_cast<size_t>(trace.pixel.y) * static_cast<size_t>(camera.width) + static_cast<size_t>(trace.pixel.x);
    trace.conditioning = listAt(conditioning, pixel);
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
    PixelTrace trace = tracePixel(testCase, pixel, backends.names, folders);
    addConditioning(testCase, folders, options.conditioning, trace);
    if (options.json) {
        fmt::print("{}", formatTraceJson(trace));
    } else {
        fmt::print("{}", formatTrace(trace, Style::choose(global.color, STDOUT_FILENO)));
    }
    return static_cast<int>(ExitCode::kAsExpected);
}

} // namespace crossray
