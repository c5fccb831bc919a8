// What a run keeps to show why a case failed: of each failure the trace of its worst pixel, on the backend that failed
// and beside it on cpu64, so that the first step where the two part is seen.
#pragma once

#include "harness/inspect/pixel_trace.h"
#include "harness/run/results.h"

#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <span>
#include <string>

namespace crossray {

struct WorstTraceLimits {
    size_t most = 40; // traces of a run; each failing case has one before any has two
    std::chrono::duration<double> time{8};
    int threads = 1;
};

// Traces a pixel on the backends within `timeout` for each; called from several threads, each with a `core` of its own.
using TraceStep =
    std::function<PixelTrace(const Case& testCase, glm::ivec2 pixel, std::span<const std::string> backends, int core,
                             std::chrono::duration<double> timeout)>;

// Of tracePixel() with these workers; both outlive it.
TraceStep makeTraceStep(WorkerPool& pool, ShaderCompiler& compiler, const std::filesystem::path& shaders);

// Writes the traces below the run's folder and notes their files in `run`, or why a failure has none. Only verdicts
// "fail" with a worst pixel are traced. Throws nothing: a trace that fails is a note, too.
void keepWorstTraces(RunResult& run, std::span<const Case> cases, const std::filesystem::path& runFolder,
                     const TraceStep& trace, const WorstTraceLimits& limits, const std::atomic<bool>& interrupted);

} // namespace crossray
