// What all comparators share: which pixels are looked at, the errors' statistics, the census, the worst pixel and the
// reason.
#pragma once

#include "harness/judge/judge.h"

#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace crossray {

// Kinds of difference are small numbers while pixels are counted, and get their names once a plane.
inline constexpr int kBeyondTolerance = 0;
inline constexpr int kDifferenceKinds = 64;

// The error where there is no distance: a NaN, another class, an infinity for a number.
inline constexpr double kNoDistance = std::numeric_limits<double>::infinity();

// A class as a plane's number has it: HitClass, or one of these.
inline constexpr int kNotAClass = 4;
inline constexpr int kNanClass = 5;
int classOf(double value);
std::string nameOfClass(int value);

// Throws InputError when the planes, the mask or the tolerance cannot be compared. `known` says which bounds the type
// knows.
struct KnownBounds {
    bool degrees = false;
    bool numbers = false; // relative, absolute, ulps
};
void checkComparison(std::string_view what, int channels, const Plane& expected, const Plane& actual, const Mask& mask,
                     const Tolerance& tolerance, KnownBounds known);

class Tally {
  public:
    Tally(const Plane& expected, const Plane& actual, const Mask& mask, std::string_view unit);

    bool isCompared(size_t pixel) const { return mask_.empty() || mask_[pixel] != 0; }
    void pass(size_t pixel, double error) { add(pixel, error, false); }
    void fail(size_t pixel, double error, int kind, bool isWellFormed = true)
    {
        if (isWellFormed && isExcusable(pixel)) {
            excusable_.push_back({pixel, error, kind});
            return;
        }
        ++kinds_[static_cast<size_t>(kind)];
        add(pixel, error, true);
    }

    // `nameOfKind` names each kind beyond kBeyondTolerance that occurred.
    Comparison finish(const Tolerance& tolerance, std::string (*nameOfKind)(int));

  private:
    struct Failure {
        size_t pixel = 0;
        double error = 0;
        int kind = kBeyondTolerance;
    };

    // Undecidable, and an answer all the same.
    bool isExcusable(size_t pixel) const;
    // Those beyond the share fail, all of them. Returns how many that are.
    uint64_t countUnexcused(const Tolerance& tolerance);
    void add(size_t pixel, double error, bool failed)
    {
        errors_.push_back(error);
        failed_ += failed ? 1U : 0U;
        // Strictly greater, so that the first of equals stays.
        if (errors_.size() == 1 || (failed && !worstFailed_) || (failed == worstFailed_ && error > worstError_)) {
            worstPixel_ = pixel;
            worstError_ = error;
            worstFailed_ = failed;
        }
    }

    const Plane& expected_;
    const Plane& actual_;
    const Mask& mask_;
    std::string unit_;
    std::vector<double> errors_;
    std::vector<Failure> excusable_;
    std::array<uint64_t, kDifferenceKinds> kinds_{};
    uint64_t failed_ = 0;
    size_t worstPixel_ = 0;
    double worstError_ = 0;
    bool worstFailed_ = false;
};

// Fills median, p95, p99, max and mean from the finite ones of `errors`.
void setStatistics(Comparison& comparison, std::vector<double> errors);

// "2.5", "(0.1, 0.2)", with up to nine digits.
std::string formatValues(const std::vector<double>& values);

} // namespace crossray
