// One case between its preparation and its last verdict: takes the backends' answers in whatever order they come and
// judges each as soon as nothing that is still to come can change its verdict.
#pragma once

#include "harness/run/answer.h"

#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

namespace crossray {

// What a case holds at most of planes that passed, for the company of one that fails.
inline constexpr size_t kMaxCompanyBytes = size_t{48} << 20;

// Thread-safe.
class CaseFlight {
  public:
    CaseFlight(const Case& testCase, PreparedCase prepared, const ExecuteOptions& options);

    const PreparedCase& prepared() const { return prepared_; }
    CaseJudge& judge() { return judge_; }

    // Of every pixel, now; else it is measured where a verdict needs it.
    void measure() { conditioning_->get(); }

    struct Settled {
        std::vector<BackendResult> results;   // with their final verdicts
        std::vector<std::string> brokenInput; // what proved the case broken, one line each
    };
    // `repeatsExactly`: the device gives the same bits each time, so that a difference between repeats is a failure.
    Settled take(Answer answer, bool repeatsExactly);
    // Nothing is to come any more: what still waits for another backend is judged by what there is.
    Settled finish();
    // Writes the planes that the options ask for and notes their files in the results: where one backend failed, those
    // of the others as well, so that the two can be compared. What is known of the case's conditioning is noted, too.
    void writePlanes(CaseResult& result) const;

  private:
    struct Waiting {
        BackendResult result;
        std::string difference; // between repeats, where it counts
    };

    bool waitsForReference(const std::string& backend) const;
    void settle(const std::string& backend, Settled& settled);
    void dropPlanes(const BackendResult& result);

    const Case& testCase_;
    PreparedCase prepared_;
    const ExecuteOptions& options_;
    std::shared_ptr<LazyConditioning> conditioning_;
    CaseJudge judge_;
    std::mutex mutex_;
    std::set<std::string> answered_;
    std::map<std::string, Waiting> waiting_;
    std::map<std::string, std::vector<Plane>> planes_; // those that are still needed
    size_t companyBytes_ = 0;                          // of those that passed and are held beside failures
};

// Whether the case runs on the backend at all.
bool runsOn(const Case& testCase, const std::string& backend);
// Why it does not; empty where it does.
std::string whyNotOn(const Case& testCase, const std::string& backend);

} // namespace crossray
