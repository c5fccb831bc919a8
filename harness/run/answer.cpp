#include "harness/run/answer.h"

#include "harness/run/plane_files.h"

#include <fmt/format.h>

#include <algorithm>

namespace crossray {

namespace {

void addTimes(const JobTimes& from, StageTimes& to)
{
    to.program += from.program;
    to.upload += from.upload;
    to.dispatch += from.dispatch;
    to.readback += from.readback;
    if (from.device >= 0) to.device = std::max(to.device, 0.0) + from.device;
}

void describeOutcome(const JobReport& report, std::chrono::duration<double> timeout, BackendResult& result)
{
    result.logLines = report.logLines;
    result.reason = report.text;
    switch (report.outcome) {
    case JobOutcome::kCrash:
        result.verdict = Verdict::kCrash;
        break;
    case JobOutcome::kTimeout:
        result.verdict = Verdict::kTimeout;
        if (result.reason.empty()) result.reason = fmt::format("no answer within {:g} s", timeout.count());
        break;
    default:
        result.verdict = Verdict::kError;
        break;
    }
}

} // namespace

bool isSoftwareRasterizer(const Fingerprint& fingerprint)
{
    if (fingerprint.api == "none") return true;
    const auto names = {"llvmpipe", "softpipe", "SwiftShader"};
    return std::any_of(names.begin(), names.end(),
                       [&](const char* name) { return fingerprint.device.find(name) != std::string::npos; });
}

BackendResult makeErrorResult(const std::string& backend, const std::string& error)
{
    BackendResult result;
    result.backend = backend;
    result.verdict = Verdict::kError;
    result.reason = error;
    return result;
}

Answer fetchAnswer(const Case& testCase, const PreparedCase& prepared, const std::string& backend, int core,
                   const ExecuteOptions& options, const ExecuteSteps& steps, const std::atomic<bool>& interrupted)
{
    const Job& job = usesDoubles(backend) ? *prepared.doubleJob : *prepared.floatJob;
    const std::chrono::duration<double> timeout(options.timeoutSeconds.value_or(testCase.timeoutSeconds));
    Answer answer;
    answer.result.backend = backend;
    for (int repeat = 0; repeat < options.repeat && !(repeat > 0 && interrupted); ++repeat) {
        const JobReport report = steps.run(backend, core, job, timeout);
        answer.result.times.worker += report.milliseconds;
        if (report.outcome != JobOutcome::kDone) {
            describeOutcome(report, timeout, answer.result);
            answer.planes.clear();
            return answer;
        }
        addTimes(report.result.times, answer.result.times);
        std::vector<Plane> planes = steps.readPlanes(testCase, report.result);
        if (repeat == 0) {
            answer.planes = std::move(planes);
            answer.result.messages = report.result.messages;
            answer.result.programsWereWarm = report.result.programsWereWarm;
        } else if (answer.difference.empty()) {
            answer.difference = describeDifference(answer.planes, planes, repeat + 1);
        }
    }
    return answer;
}

Answer askBackend(const Case& testCase, const PreparedCase& prepared, CaseJudge& judge, const std::string& backend,
                  int core, const ExecuteOptions& options, const ExecuteSteps& steps,
                  const std::atomic<bool>& interrupted)
{
    Answer answer = fetchAnswer(testCase, prepared, backend, core, options, steps, interrupted);
    if (answer.planes.empty()) return answer;
    const auto start = std::chrono::steady_clock::now();
    answer.result.expectations = judge.judgeAlone(backend, answer.planes);
    answer.result.times.judge =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return answer;
}

} // namespace crossray
