#include "harness/bench/throughput.h"
#include "harness/cli/verbs.h"
#include "harness/run/environment.h"

#include <fmt/format.h>

#include <fstream>

namespace crossray {

int benchThroughput(const GlobalOptions& global, const ThroughputVerbOptions& options)
{
    const Folders folders = findFolders(global.shaders, global.cases, global.cache);
    const BackendChoice backends = chooseBackends(options.backends, listBackends());
    for (const std::string& note : backends.notes)
        fmt::print(stderr, "crossray: {}\n", note);

    ThroughputOptions measured;
    measured.backends = backends.names;
    measured.cases = options.cases;
    measured.cores = options.cores;
    measured.rounds = options.rounds;
    fmt::print("{} distinct 64x64 HiZ cases, milliseconds a case, median of {} rounds\n\n", options.cases,
               options.rounds);
    fmt::print("{:<12} {:>5} {:>6} {:>9} {:>9} {:>9} {:>9} {:>7}\n", "backend", "cores", "cache", "median", "fastest",
               "slowest", "shader", "failed");
    int failed = 0;
    const std::vector<ThroughputPoint> points = measureThroughput(measured, folders, [&](const ThroughputPoint& point) {
        fmt::print("{:<12} {:>5} {:>6} {:>9.3f} {:>9.3f} {:>9.3f} {:>9.3f} {:>7}\n", point.backend, point.cores,
                   nameOf(point.state), point.millisecondsPerCase, point.fastest, point.slowest,
                   point.shaderMilliseconds, point.failed);
        std::fflush(stdout);
        failed += point.failed;
    });
    if (!options.output.empty()) {
        std::ofstream file(options.output);
        file << formatThroughputJson(points);
        if (!file.flush()) throw InputError(fmt::format("{}: cannot be written", options.output));
    }
    return static_cast<int>(failed == 0 ? ExitCode::kAsExpected : ExitCode::kFailed);
}

} // namespace crossray
