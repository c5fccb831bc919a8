#include "harness/cli/failure_text.h"
#include "harness/cli/verbs.h"
#include "harness/run/environment.h"
#include "harness/run/golden.h"
#include "harness/run/run_json.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace crossray {

namespace {

int listFailures(const RunResult& run)
{
    const std::vector<GoldenFailure> failures = listGoldenFailures(run);
    for (const GoldenFailure& failure : failures) {
        fmt::print("{}  {}  {}: {}\n      {}   crossray review --accept {}\n", failure.caseName, failure.output,
                   fmt::join(failure.backends, " "), failure.reason, failure.position.format(),
                   quoteForShell(failure.caseName));
    }
    if (failures.empty()) fmt::print("no golden expectation failed or lacks its file\n");
    return static_cast<int>(failures.empty() ? ExitCode::kAsExpected : ExitCode::kFailed);
}

} // namespace

int reviewGoldens(const GlobalOptions& global, const ReviewOptions& options)
{
    const RunResult run = readRun(options.run);
    if (options.accept.empty()) return listFailures(run);
    const Folders folders = findFolders(global.shaders, global.cases, global.cache);
    const SelectedCases selected =
        selectCases({{options.accept}, {}, {}, {}, false}, folders.cases, options.run, false);
    if (selected.exitCode) return static_cast<int>(*selected.exitCode);
    for (const Case& testCase : selected.cases) {
        for (const auto& file : acceptGoldens(testCase, run, findRunJson(options.run).parent_path(), options.backend))
            fmt::print("recorded {}\n", file.string());
    }
    return static_cast<int>(ExitCode::kAsExpected);
}

} // namespace crossray
