#include "harness/cli/verbs.h"
#include "harness/run/environment.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <unistd.h>

#include <algorithm>

namespace crossray {

int listCases(const GlobalOptions& global, const SelectionOptions& selection, bool json)
{
    const Folders folders = findFolders(global.shaders, global.cases, global.cache);
    const SelectedCases selected = selectCases(selection, folders.cases, "out/last", true);
    if (selected.exitCode) return static_cast<int>(*selected.exitCode);
    if (json) {
        auto list = nlohmann::ordered_json::array();
        for (const Case& testCase : selected.cases) {
            list.push_back({{"name", testCase.name},
                            {"summary", testCase.summary},
                            {"tags", testCase.tags},
                            {"file", testCase.file.string()},
                            {"line", testCase.position.line},
                            {"mustFail", testCase.mustFail}});
        }
        fmt::print("{}\n", list.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
    } else {
        const Style style = Style::choose(global.color, STDOUT_FILENO);
        size_t widest = 0;
        for (const Case& testCase : selected.cases)
            widest = std::max(widest, std::min<size_t>(testCase.name.size(), 48));
        std::string text;
        const bool isWrapped = isTerminal(STDOUT_FILENO); // a pipe gets a line a case
        const int width = terminalWidth(STDOUT_FILENO) - static_cast<int>(widest) - 2;
        for (const Case& testCase : selected.cases) {
            const std::string summary = isWrapped && width >= 20
                                            ? wrap(testCase.summary, width, static_cast<int>(widest) + 2)
                                            : testCase.summary;
            text += fmt::format("{:<{}}  {}\n", testCase.name, widest, style.paint(Ink::kDim, summary));
        }
        fmt::print("{}", text);
    }
    return static_cast<int>(selected.broken.empty() ? ExitCode::kAsExpected : ExitCode::kUsage);
}

} // namespace crossray
