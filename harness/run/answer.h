// One question to one backend: a prepared case's job, its answer, and what can be said about it without the other
// backends.
#pragma once

#include "harness/run/execute.h"

#include <atomic>
#include <string>
#include <vector>

namespace crossray {

struct Answer {
    BackendResult result;      // without a verdict, unless there are no planes
    std::vector<Plane> planes; // empty: error, crash or timeout
    std::string difference;    // between repeats; empty when there is none
};

// Runs the job as often as the options ask, and judges nothing. Throws InputError when the case turns out to be broken.
Answer fetchAnswer(const Case& testCase, const PreparedCase& prepared, const std::string& backend, int core,
                   const ExecuteOptions& options, const ExecuteSteps& steps, const std::atomic<bool>& interrupted);

// The same with the expectations that need no other backend judged.
Answer askBackend(const Case& testCase, const PreparedCase& prepared, CaseJudge& judge, const std::string& backend,
                  int core, const ExecuteOptions& options, const ExecuteSteps& steps,
                  const std::atomic<bool>& interrupted);

BackendResult makeErrorResult(const std::string& backend, const std::string& error);

// Whether the device gives the same bits for the same job, so that a repeat that differs is a failure.
bool isSoftwareRasterizer(const Fingerprint& fingerprint);

} // namespace crossray
