// A run as JUnit XML: one suite a backend, one test a case.
#pragma once

#include "harness/run/results.h"

#include <map>
#include <string>

namespace crossray {

std::string formatJunit(const RunResult& run);

// The same one case after another, for a run whose cases are not all at hand.
class JunitWriter {
  public:
    explicit JunitWriter(std::string started) : started_(std::move(started)) {}
    void add(const CaseResult& testCase);
    std::string finish() const;

  private:
    struct Suite {
        std::string tests;
        size_t count = 0, failures = 0, errors = 0, skipped = 0;
    };
    std::string started_;
    std::map<std::string, Suite> suites_; // by backend
};

// A run as GitHub's workflow commands, one line a failed verdict: the failure shows beside the case's line in a pull
// request.
std::string formatGithubAnnotations(const RunResult& run);

} // namespace crossray
