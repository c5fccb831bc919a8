// How well the question of each pixel is posed: by how many units in the last place an output moves when the inputs
// move by one.
#pragma once

#include "harness/judge/judge.h"
#include "harness/pass/moved_inputs.h"
#include "harness/run/results.h"

#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace crossray {

// One output of a case: planes of one channel, 0 and above, infinite where a class, a reason or a count flips or a
// number comes or goes, never NaN.
struct OutputConditioning {
    std::string output;
    Plane condition; // on cpu64: output ulp for an input ulp, whoever computes; the largest of all moves
    Plane float32;   // the same on cpu32: with what arithmetic in float adds
    Plane rounding;  // cpu32 against cpu64, output ulp
    Plane cause;     // InputGroup that gave `condition`; kAll where no group alone went as far
};

struct Conditioning {
    std::string note; // why there is none; empty where there is
    std::vector<OutputConditioning> outputs;

    const OutputConditioning* find(std::string_view output) const;
};

// The answer of a job on "cpu32" or "cpu64". Throws what keeps it from one.
using AskCpu = std::function<std::vector<Plane>(const std::string& backend, const Job& job)>;

// Runs both jobs as they are and with each move. Where a backend gives no answer, or the case has an own tracer, which
// those backends cannot run, a note says so.
Conditioning measureConditioning(const Case& testCase, const Job& floatJob, const Job& doubleJob, const AskCpu& ask);

// Measures on first need, once. Thread-safe.
class LazyConditioning {
  public:
    explicit LazyConditioning(std::function<Conditioning()> measure) : measure_(std::move(measure)) {}
    const Conditioning& get();
    const Conditioning* known() const; // null before the first get()

  private:
    std::function<Conditioning()> measure_;
    mutable std::mutex mutex_;
    std::optional<Conditioning> made_;
};

// Units in the last place of a float between two answers of one pixel. The unit is that of the largest channel, and of
// no less than what the output is measured against: 1 for directions, weights, colours and normalised coordinates, the
// image's longer side for positions on screen, the near plane for metres.
double measureMove(const OutputInfo& output, const Camera& camera, const double* before, const double* after);

// 1 where an ulp of input becomes more than `bound` ulps of the output.
Mask findUndecidable(const Conditioning& conditioning, std::string_view output, double bound);

// One pixel in words: "HitDepth moves by 5.1e+04 ulp for an ulp of depth", "HitSuccess flips for an ulp of camera";
// empty where no input moves it.
std::string describeConditioning(const OutputConditioning& output, size_t pixel);

// All that is known of one pixel, by output.
struct PixelConditioning {
    std::string output;
    double condition = 0, float32 = 0, rounding = 0; // as in OutputConditioning
    std::string cause;                               // of inputs, in words; empty where none moves it
    std::string sentence;                            // of describeConditioning()
};
std::vector<PixelConditioning> listAt(const Conditioning& conditioning, size_t pixel);

// What run.json holds of it: pixels that trace alone.
ConditioningResult summarize(const Conditioning& conditioning, const std::vector<bool>& tracedPixels);

// The planes as a file has them: "HitDepth@condition", "HitDepth@cpu32", "HitDepth@rounding", "HitDepth@cause".
std::vector<Plane> listConditioningPlanes(const Conditioning& conditioning);

// Whether some expectation excuses pixels and so needs the measure.
bool excusesPixels(const Case& testCase);

} // namespace crossray
