#include "harness/run/steps.h"

#include "harness/base/stopwatch.h"

#include "harness/run/worker_explain.h"

#include <csignal>

#include <sys/types.h>

namespace crossray {

namespace {

using Clock = std::chrono::steady_clock;

PreparedCase prepareCase(const Case& testCase, bool needsFloat, bool needsDouble, ShaderCompiler& compiler,
                         const std::filesystem::path& shaderRoot)
{
    PreparedCase prepared;
    const Clock::time_point start = Clock::now();
    prepared.data = std::make_shared<const CaseData>(testCase);
    prepared.prepareMs = millisecondsSince(start);
    const Clock::time_point compileStart = Clock::now();
    if (needsFloat) prepared.floatJob = buildJob(*prepared.data, compiler, shaderRoot, Precision::kFloat);
    if (needsDouble) prepared.doubleJob = buildJob(*prepared.data, compiler, shaderRoot, Precision::kDouble);
    prepared.inputKey = computeInputKey(testCase, prepared.floatJob ? *prepared.floatJob : *prepared.doubleJob);
    prepared.compileMs = millisecondsSince(compileStart);
    return prepared;
}

} // namespace

ExecuteSteps makeSteps(WorkerPool& pool, ShaderCompiler& compiler, const std::filesystem::path& shaderRoot,
                       std::span<const std::string> backends)
{
    ExecuteSteps steps;
    steps.prepare = [&compiler, shaderRoot](const Case& testCase, bool needsFloat, bool needsDouble) {
        return prepareCase(testCase, needsFloat, needsDouble, compiler, shaderRoot);
    };
    steps.run = [&pool, &compiler, shaderRoot](const std::string& backend, int core, const Job& job,
                                               std::chrono::duration<double> timeout) {
        return runExplained(pool, compiler, shaderRoot, backend, core, job, timeout);
    };
    steps.open = [&pool](const std::string& backend, int core) { return pool.fingerprint(backend, core); };
    steps.readPlanes = [](const Case& testCase, const JobResult& result) { return readPlanes(testCase, result); };
    steps.killWorkers = [&pool, names = std::vector<std::string>(backends.begin(), backends.end())] {
        for (const std::string& backend : names) {
            for (const int process : pool.processIds(backend))
                kill(process, SIGKILL);
        }
    };
    return steps;
}

} // namespace crossray
