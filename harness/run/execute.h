// Runs a plan: prepares the cases, hands their jobs to the backends' workers, judges what comes back.
#pragma once

#include "harness/pass/pass.h"
#include "harness/run/case_judge.h"
#include "harness/run/inputs.h"
#include "harness/run/results.h"
#include "harness/run/worker_pool.h"

#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace crossray {

enum class KeepPlanes { kNone, kFailed, kAll };

struct ExecuteOptions {
    std::vector<std::string> backends;
    int cores = 1;
    int repeat = 1;
    int maxFailures = 0;                  // stop after so many failed verdicts; 0: never
    bool keepGoing = false;               // a broken case does not stop the others
    std::optional<double> timeoutSeconds; // instead of the cases' own
    KeepPlanes keepPlanes = KeepPlanes::kFailed;
    bool conditioning = false;               // of every case, not only of those that excuse pixels by it
    std::filesystem::path outputFolder;      // planes go below it; empty: nowhere
    std::optional<PassedCases> passedBefore; // leave out what has passed with the same inputs
    std::string today;                       // for known failures
    std::chrono::steady_clock::time_point processStart = std::chrono::steady_clock::now();
};

// A case ready to run.
struct PreparedCase {
    std::shared_ptr<const CaseData> data;   // kept by the judge, too
    std::optional<Job> floatJob, doubleJob; // only the precisions that some backend asks for
    std::string inputKey;
    double prepareMs = 0, compileMs = 0;
    AskCpu askCpu; // for the conditioning
};

// The steps that touch the world, so that the order of things can be tested without devices. All are called from
// several threads at once.
struct ExecuteSteps {
    // Throws InputError or ShaderError.
    std::function<PreparedCase(const Case&, bool needsFloat, bool needsDouble)> prepare;
    std::function<JobReport(const std::string& backend, int core, const Job&, std::chrono::duration<double> timeout)>
        run;
    // Starts the worker when there is none. Throws EnvironmentError.
    std::function<Fingerprint(const std::string& backend, int core)> open;
    std::function<std::vector<Plane>(const Case&, const JobResult&)> readPlanes;
    std::function<void()> killWorkers; // on interruption; may be called again

    // What is known already of a case; null where nothing can be. Every backend's device is open by then.
    using Devices = std::map<std::string, Fingerprint>;
    std::function<std::optional<CaseResult>(const Case&, const Devices&)> recall;
    // Called with each case whose backends have all answered or been skipped; null where nothing is kept.
    std::function<void(const Case&, const PreparedCase&, const CaseResult&, const Devices&)> keep;
};

// What happens, as it happens. Calls come one at a time, from any thread.
class RunObserver {
  public:
    virtual ~RunObserver() = default;
    virtual void startBackend(const std::string& backend, const CaseResult& testCase) = 0;   // a job is handed over
    virtual void finishBackend(const CaseResult& testCase, const BackendResult& result) = 0; // a verdict is known
    virtual void finishCase(const CaseResult& testCase) = 0;
    virtual void tick() = 0; // ten times a second
};

// What is known of a case before any backend has answered.
CaseResult startCaseResult(const Case& testCase);

// Whether the backend computes in doubles and so needs the job of that precision.
bool usesDoubles(const std::string& backend);

// Fills cases, backends, brokenFiles, interrupted, stoppedEarly, firstVerdictMs and seconds of `run`. Cases that were
// not reached have no entry for the backends that did not answer.
void execute(const std::vector<Case>& cases, const ExecuteOptions& options, const ExecuteSteps& steps,
             RunObserver& observer, const std::atomic<bool>& interrupted, RunResult& run);

} // namespace crossray
