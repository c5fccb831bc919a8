#include "harness/inspect/pixel_conditioning.h"

#include "harness/pass/pass.h"
#include "harness/run/worker_explain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace crossray {

namespace {

std::string formatUlps(double value)
{
    return std::isinf(value) ? "flips" : fmt::format("{:.3g}", value);
}

} // namespace

Conditioning measureConditioning(const Case& testCase, const TraceWorkers& workers)
{
    const CaseData data(testCase);
    const Job floatJob = buildJob(data, workers.compiler, workers.shaders, Precision::kFloat);
    const Job doubleJob = buildJob(data, workers.compiler, workers.shaders, Precision::kDouble);
    return measureConditioning(testCase, floatJob, doubleJob, [&](const std::string& backend, const Job& job) {
        const JobReport report = workers.pool.run(backend, workers.core, job, workers.timeout);
        if (report.outcome != JobOutcome::kDone)
            throw EnvironmentError(fmt::format("{} gave no answer: {}", backend, report.text));
        return readPlanes(testCase, report.result);
    });
}

Conditioning measureConditioning(const Case& testCase, const Folders& folders)
{
    WorkerPool pool(WorkerOptions{});
    ShaderCompiler compiler(folders.cache / "spirv");
    const std::chrono::duration<double> timeout(std::max(testCase.timeoutSeconds, 60.0));
    return measureConditioning(testCase, TraceWorkers{pool, compiler, folders.shaders, 0, timeout});
}

std::vector<std::string> describePixelConditioning(std::span<const PixelConditioning> outputs)
{
    std::vector<std::string> lines;
    for (const PixelConditioning& output : outputs) {
        std::string line = fmt::format("{:<16} {:>8} {:>8} {:>8}", output.output, formatUlps(output.condition),
                                       formatUlps(output.float32), formatUlps(output.rounding));
        const bool isFragile = std::max(output.float32, output.rounding) > kUndecidableAbove;
        if (output.condition > kUndecidableAbove) {
            line += fmt::format("  undecidable here: {}", output.sentence);
        } else if (isFragile) {
            line += "  decidable, and lost by float arithmetic";
        }
        lines.push_back(std::move(line));
    }
    return lines;
}

} // namespace crossray
