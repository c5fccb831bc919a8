// Holds what the backends answered against a case's expectations. Expected planes are made once a case, on first need.
#pragma once

#include "harness/expect/expect.h"
#include "harness/run/conditioning.h"
#include "harness/run/results.h"

#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

namespace crossray {

// "analytic mirror_direction", "truth hit_depth", "constant", "golden hiz.exr", "agree with cpu64".
std::string describeSource(const ExpectationSource& source);
// "0.0001 relative or 4 ulp, below 1e-07 zero; 1 % may be off by up to 0.5", or the bounds of a hit budget.
std::string describeTolerance(const Expectation& expectation);
bool isAgreement(const Expectation& expectation);
// What the list of an agreement is held against: its last backend.
const std::string& referenceOf(const AgreeSource& source);

// Thread-safe: several backends of a case may be judged at once.
class CaseJudge {
  public:
    // `conditioning` says which pixels an expectation may excuse; without it none is. It is asked where a pixel is
    // beyond its tolerance, and at no other time.
    explicit CaseJudge(std::shared_ptr<const CaseData> data, std::shared_ptr<LazyConditioning> conditioning = {})
        : data_(std::move(data)), conditioning_(std::move(conditioning))
    {
    }

    // The expectations that have a plane of their own and speak of this backend. Throws InputError for a broken case.
    std::vector<ExpectationResult> judgeAlone(const std::string& backend, std::span<const Plane> planes);
    // The agreements that name this backend; a reference that gave no planes leaves them unjudged, with a note.
    std::vector<ExpectationResult> judgeAgreements(const std::string& backend,
                                                   const std::map<std::string, std::vector<Plane>>& planesOfBackends);
    // The backends that this one is held against.
    std::vector<std::string> referencesOf(const std::string& backend) const;
    // Whether some other backend is held against this one.
    bool isReference(const std::string& backend) const;

    // The expected planes made so far, named "HitDepth@2" by output and place among the expectations; of a budget the
    // hit classes that it counts as right.
    std::vector<Plane> takeExpectedPlanes() const;
    // Which pixels the expectations compare, where it is not all: "mask@0,2" by their places; 1 compared, 0 not, 2
    // where the backend's HitSuccess says hit.
    std::vector<Plane> makeMaskPlanes() const;

  private:
    struct Made {
        bool done = false;
        std::shared_ptr<const Plane>
            plane; // shared with the threads that compare against it; null for a missing golden
    };

    ExpectationResult startResult(size_t index) const;
    Comparison compareWith(const Expectation& expectation, const Plane& expected, std::span<const Plane> planes);
    Comparison compareWithTruth(const Expectation& expectation, std::span<const Plane> planes);
    std::shared_ptr<const Plane> expectedPlane(size_t index);
    Mask maskFor(const Expectation& expectation, std::span<const Plane> planes);

    std::shared_ptr<const CaseData> data_; // shared with the preparation's cache of the same case
    std::shared_ptr<LazyConditioning> conditioning_;
    mutable std::mutex mutex_; // the truth is made on first use, inside CaseData
    std::map<size_t, Made> expected_;
    std::shared_ptr<const std::vector<HitTruth>> hitTruth_; // shared like the planes
};

} // namespace crossray
