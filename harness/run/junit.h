// A run as JUnit XML: one suite a backend, one test a case.
#pragma once

#include "harness/run/results.h"

#include <string>

namespace crossray {

std::string formatJunit(const RunResult& run);

// A run as GitHub's workflow commands, one line a failed verdict: the failure shows beside the case's line in a pull
// request.
std::string formatGithubAnnotations(const RunResult& run);

} // namespace crossray
