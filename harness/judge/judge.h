// The ruler: typed comparison of an output with its expectation. The judge knows the types; raw values are compared,
// never display encodings. NaN equals nothing but an expected NaN.
#pragma once

#include "harness/base/outputs.h"
#include "harness/base/plane.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace crossray {

// A pixel passes when each of its channels is within any of the bounds that are set. What is not set does not help a
// pixel to pass, nor does a bound that the output's type does not know: directions know degrees; depths, colours and
// scalars know relative, absolute and ulps; hit classes and counts are exact and need none.
struct Tolerance {
    std::optional<double> degrees;  // kDirection: angle between the two
    std::optional<double> relative; // |a - e| <= relative * |e|
    std::optional<double> absolute; // |a - e| <= absolute
    std::optional<double> ulps;     // units in the last place of a float (of a double when doublePrecision is set)
    double floor = 0;               // below this magnitude both count as zero
    bool doublePrecision = false;   // measure ulps in doubles: cpu64 against closed forms

    // Pixels beyond the bounds above that a case accepts, as a share of the compared ones. It never stands alone:
    // `worst` bounds each of them, in the type's own unit (degrees; relative error; absolute error for scalars and
    // colours).
    double outlierShare = 0;
    std::optional<double> worst;

    // Pixels beyond the bounds that are excused where the mask says that their answer cannot be decided, as a share of
    // the compared ones. NaN, infinity and what is no class or no direction are never excused; more of them than that
    // are failures, all of them.
    double undecidableShare = 0;
};

// Output ulps for an input ulp above which a pixel is "undecidable here": 6e-5 to 1.2e-4 of the answer, which is where
// the tolerances of single precision end.
inline constexpr double kUndecidableAbove = 1024;

// Budgets of a screen-space answer against the truth (domain yardstick). Unset bounds are not checked.
struct HitBudget {
    std::optional<double> recall;    // answerable rays whose hit is right, at least
    std::optional<double> precision; // right hits over claimed hits, at least
    std::optional<double> falseHits; // claimed hits among the unanswerable, at most
    double positionPx = 2.0;         // a hit is right when it lies within this distance on screen
};

// How far the length of a direction may be from 1. A float normalize() is within 1e-6; what a degenerate refraction
// leaves behind (0.66, 0) is not, and such a vector is a difference of its own kind, whatever its angle.
inline constexpr double kUnitLengthBound = 1e-4;

struct PixelDifference {
    int x = 0, y = 0;
    std::vector<double> expected, actual;
    double error =
        0; // in `unit`; infinite where no number tells how wrong it is (NaN, Inf, a zero or non-unit direction)
};

// 4x4 counts, [expected][actual] by HitClass.
struct ConfusionMatrix {
    uint64_t counts[4][4] = {};
};

struct Comparison {
    bool passed = false;
    // Of the errors: "degrees" for directions, "relative" for depths, "absolute" for colours, scalars and counts,
    // "class" (0 or 1) for hit classes, "px" for budgets; "ulp" where ulps is the tolerance's only bound.
    std::string unit;
    uint64_t compared =
        0; // pixels under the mask; none at all is a failure: an expectation that cannot fail proves nothing
    uint64_t failed = 0;      // pixels beyond the tolerance (outliers included, also when they are accepted)
    uint64_t undecidable = 0; // compared pixels that the mask says are undecidable
    uint64_t excused = 0;     // of them, those beyond the tolerance that are excused: neither failed nor in the census
    // The largest error among the failed pixels, or among all when none failed; the first in row order when several are
    // as bad.
    std::optional<PixelDifference> worst;
    // Of the finite pixel errors (the largest of the channels), by nearest rank: an error that really occurs.
    double median = 0, p95 = 0, p99 = 0, max = 0, mean = 0;
    // Every failed pixel once, by kind, the actual thing named first: "NaN for finite", "hit for miss", "beyond
    // tolerance"...
    std::map<std::string, uint64_t> census;
    std::optional<ConfusionMatrix> confusion; // hit classes; values that are no class are in the census alone
    std::map<std::string, double> metrics;    // budgets: "recall", "precision", "false", "answerable", ...
    std::string reason;                       // one line: why it failed, the worst first; empty when passed
};

// Pixels to compare; empty = all. One byte a pixel, 0 leaves it out, kUndecidablePixel compares and may excuse.
using Mask = std::vector<uint8_t>;
inline constexpr uint8_t kUndecidablePixel = 2;

// Throws InputError when the planes differ in shape, the tolerance sets no bound that its type knows, a bound is
// negative or not a number, or outliers are accepted without `worst`: a broken case, not a failed one.
//
// NaN matches NaN alone, an infinity the same infinity alone, a zero vector (no direction) a zero vector alone. No
// outlier share accepts a difference that has no finite error.
Comparison compareDirections(const Plane& expected, const Plane& actual, const Mask& mask, const Tolerance& tolerance);
Comparison compareDepths(const Plane& expected, const Plane& actual, const Mask& mask, const Tolerance& tolerance);
Comparison compareHitClasses(const Plane& expected, const Plane& actual, const Mask& mask, const Tolerance& tolerance);
Comparison compareColors(const Plane& expected, const Plane& actual, const Mask& mask, const Tolerance& tolerance);
Comparison compareScalars(const Plane& expected, const Plane& actual, const Mask& mask, const Tolerance& tolerance);
Comparison compareCounts(const Plane& expected, const Plane& actual, const Mask& mask, const Tolerance& tolerance);
// The one for the type.
Comparison compare(OutputType type, const Plane& expected, const Plane& actual, const Mask& mask,
                   const Tolerance& tolerance);

// Every value is a number, and none lies above the bound of its channel; `isMagnitude`: nor below its negative. The
// errors are what exceeds it.
Comparison compareWithBound(const Plane& bound, const Plane& actual, const Mask& mask, bool isMagnitude);

// One pixel of the truth as the budget sees it.
struct HitTruth {
    bool traced = false;       // the pixel traces a ray at all; the others are left out
    bool answerable = false;   // the true hit is visible on screen
    double hitX = 0, hitY = 0; // px, where the true hit is on screen
};

// HitSuccess and HitPositionSS (the end on screen of each claimed hit) against the truth. Without a position plane a
// claimed hit is right when the ray is answerable.
//   recall    = right hits / answerable rays           (an answerable ray is needed when it is bounded)
//   precision = right hits / all claimed hits          (a claimed hit is needed when it is bounded)
//   false     = claimed hits of unanswerable rays / unanswerable rays
// Metrics: "recall", "precision", "false" where their denominator is not 0; "traced", "answerable", "unanswerable",
// "claimed", "right", "wrong", "falseHits" as counts. The errors are the distances of the answerable rays' claimed
// hits. Confusion: answerable rays are expected to hit, the others to be unknown. Throws InputError on another size, or
// when the budget bounds nothing.
Comparison judgeHits(const std::vector<HitTruth>& truth, const Plane& hitSuccess, const Plane* hitPositionSS,
                     const HitBudget& budget);

// Units in the last place between two values, in float or in double; 0 for equal (also -0 and +0), infinity across NaN
// and where a finite value is beyond the range of a float. Counts representable numbers, denormals included: 0 to the
// smallest is 1.
double ulpDistance(double a, double b, bool doublePrecision);

} // namespace crossray
