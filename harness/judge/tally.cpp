#include "harness/judge/tally.h"

#include "harness/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace crossray {

namespace {

void checkBound(std::string_view what, std::string_view name, const std::optional<double>& bound)
{
    if (bound && !(*bound >= 0.0)) {
        throw InputError(
            fmt::format("{}: tolerance \"{}\" is {}, allowed is a number of at least 0", what, name, *bound));
    }
}

void checkTolerance(std::string_view what, const Tolerance& tolerance, KnownBounds known)
{
    checkBound(what, "degrees", tolerance.degrees);
    checkBound(what, "relative", tolerance.relative);
    checkBound(what, "absolute", tolerance.absolute);
    checkBound(what, "ulps", tolerance.ulps);
    checkBound(what, "floor", tolerance.floor);
    checkBound(what, "worst", tolerance.worst);
    if (!(tolerance.outlierShare >= 0.0 && tolerance.outlierShare <= 1.0)) {
        throw InputError(fmt::format("{}: outlier share is {}, allowed is 0 to 1", what, tolerance.outlierShare));
    }
    if (!(tolerance.undecidableShare >= 0.0 && tolerance.undecidableShare <= 1.0)) {
        throw InputError(
            fmt::format("{}: undecidable share is {}, allowed is 0 to 1", what, tolerance.undecidableShare));
    }
    if (tolerance.outlierShare > 0.0 && !tolerance.worst) {
        throw InputError(fmt::format("{}: an outlier share never stands alone, set \"worst\" as well", what));
    }
    if (known.degrees && !tolerance.degrees) {
        throw InputError(fmt::format("{}: the tolerance sets no bound for it, allowed is degrees", what));
    }
    if (known.numbers && !tolerance.relative && !tolerance.absolute && !tolerance.ulps) {
        throw InputError(
            fmt::format("{}: the tolerance sets no bound for it, allowed are relative, absolute and ulps", what));
    }
}

// Sorts no more than it must: each rank is found among what the one above it left below.
double selectRank(std::vector<double>& errors, size_t& end, double share)
{
    const double rank = std::ceil(share * static_cast<double>(errors.size()));
    const size_t position = std::clamp<size_t>(static_cast<size_t>(rank), 1, errors.size()) - 1;
    const auto nth = errors.begin() + static_cast<std::ptrdiff_t>(position);
    if (position < end) std::nth_element(errors.begin(), nth, errors.begin() + static_cast<std::ptrdiff_t>(end));
    end = position;
    return *nth;
}

std::vector<double> pixelValues(const Plane& plane, size_t pixel)
{
    const auto channels = static_cast<size_t>(plane.channels);
    const auto first = plane.values.begin() + static_cast<std::ptrdiff_t>(pixel * channels);
    return {first, first + plane.channels};
}

// The worst first, then how many, then what kinds where there is more to say than "beyond tolerance".
std::string formatReason(const Comparison& comparison)
{
    const PixelDifference& worst = *comparison.worst;
    const double share = 100.0 * static_cast<double>(comparison.failed) / static_cast<double>(comparison.compared);
    const std::string size = std::isfinite(worst.error) ? fmt::format(" {:.4g} {}", worst.error, comparison.unit) : "";
    std::string text = fmt::format("worst{} at ({}, {}): expected {}, actual {}; {} of {} px ({:.2f} %)", size, worst.x,
                                   worst.y, formatValues(worst.expected), formatValues(worst.actual), comparison.failed,
                                   comparison.compared, share);
    std::vector<std::pair<std::string, uint64_t>> kinds(comparison.census.begin(), comparison.census.end());
    std::stable_sort(kinds.begin(), kinds.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
    for (size_t i = 0; i < kinds.size(); ++i) {
        text += fmt::format("{}{} {}", i == 0 ? ": " : ", ", kinds[i].second, kinds[i].first);
    }
    return text;
}

// Both shares: that which is off where nothing can be decided, and that which the case excuses.
std::string formatUnexcused(const Comparison& comparison, uint64_t unexcused, const Tolerance& tolerance)
{
    const double share = 100.0 * static_cast<double>(unexcused) / static_cast<double>(comparison.compared);
    return fmt::format("; {} of them ({:.2f} %) are undecidable, and the case excuses {:g} %", unexcused, share,
                       100.0 * tolerance.undecidableShare);
}

} // namespace

void checkComparison(std::string_view what, int channels, const Plane& expected, const Plane& actual, const Mask& mask,
                     const Tolerance& tolerance, KnownBounds known)
{
    if (!expected.sameShape(actual)) {
        throw InputError(
            fmt::format("{} \"{}\": expected is {}x{} with {} channels, actual is {}x{} with {}: the same shape "
                        "is allowed",
                        what, actual.name, expected.width, expected.height, expected.channels, actual.width,
                        actual.height, actual.channels));
    }
    if (channels != 0 && expected.channels != channels) {
        throw InputError(fmt::format("{} \"{}\": the planes have {} channels, allowed are {}", what, actual.name,
                                     expected.channels, channels));
    }
    const size_t size = expected.pixelCount() * static_cast<size_t>(expected.channels);
    if (expected.values.size() != size || actual.values.size() != size) {
        throw InputError(fmt::format("{} \"{}\": the planes hold {} and {} values, allowed are {}", what, actual.name,
                                     expected.values.size(), actual.values.size(), size));
    }
    if (!mask.empty() && mask.size() != expected.pixelCount()) {
        throw InputError(fmt::format("{} \"{}\": the mask has {} pixels, allowed are {} or none", what, actual.name,
                                     mask.size(), expected.pixelCount()));
    }
    checkTolerance(what, tolerance, known);
}

Tally::Tally(const Plane& expected, const Plane& actual, const Mask& mask, std::string_view unit)
    : expected_(expected), actual_(actual), mask_(mask), unit_(unit)
{
    errors_.reserve(expected.pixelCount());
}

bool Tally::isExcusable(size_t pixel) const
{
    if (mask_.empty() || mask_[pixel] != kUndecidablePixel) return false;
    const auto channels = static_cast<size_t>(actual_.channels);
    const auto first = actual_.values.begin() + static_cast<std::ptrdiff_t>(pixel * channels);
    return std::all_of(first, first + actual_.channels, [](double value) { return std::isfinite(value); });
}

uint64_t Tally::countUnexcused(const Tolerance& tolerance)
{
    const auto excused = static_cast<double>(excusable_.size());
    const auto compared = static_cast<double>(errors_.size() + excusable_.size());
    if (excused <= tolerance.undecidableShare * compared) return 0;
    for (const Failure& failure : excusable_) {
        ++kinds_[static_cast<size_t>(failure.kind)];
        add(failure.pixel, failure.error, true);
    }
    const uint64_t count = excusable_.size();
    excusable_.clear();
    return count;
}

Comparison Tally::finish(const Tolerance& tolerance, std::string (*nameOfKind)(int))
{
    Comparison comparison;
    const uint64_t unexcused = countUnexcused(tolerance);
    comparison.unit = unit_;
    comparison.compared = errors_.size() + excusable_.size();
    comparison.failed = failed_;
    comparison.excused = excusable_.size();
    comparison.undecidable = static_cast<uint64_t>(std::count(mask_.begin(), mask_.end(), kUndecidablePixel));
    if (errors_.empty() && !excusable_.empty()) {
        comparison.reason =
            fmt::format("all {} pixels to compare are beyond the tolerance and undecidable", excusable_.size());
        return comparison;
    }
    if (errors_.empty()) {
        comparison.reason = "no pixel to compare";
        return comparison;
    }
    comparison.worst =
        PixelDifference{static_cast<int>(worstPixel_ % static_cast<size_t>(expected_.width)),
                        static_cast<int>(worstPixel_ / static_cast<size_t>(expected_.width)),
                        pixelValues(expected_, worstPixel_), pixelValues(actual_, worstPixel_), worstError_};
    setStatistics(comparison, errors_);
    for (int kind = 0; kind < kDifferenceKinds; ++kind) {
        const uint64_t count = kinds_[static_cast<size_t>(kind)];
        if (count == 0) continue;
        comparison.census[kind == kBeyondTolerance ? "beyond tolerance" : nameOfKind(kind)] += count;
    }
    // The worst failed pixel bounds all of them. An infinite bound accepts no infinite error.
    // Undecidable pixels are no outliers: what is excused is another matter.
    const double allowed = tolerance.outlierShare * static_cast<double>(comparison.compared);
    const bool outliersAccepted = tolerance.worst && static_cast<double>(failed_) <= allowed &&
                                  std::isfinite(worstError_) && worstError_ <= *tolerance.worst;
    comparison.passed = failed_ == 0 || outliersAccepted;
    if (!comparison.passed) {
        comparison.reason = formatReason(comparison);
        if (unexcused > 0) comparison.reason += formatUnexcused(comparison, unexcused, tolerance);
    }
    return comparison;
}

void setStatistics(Comparison& comparison, std::vector<double> errors)
{
    std::erase_if(errors, [](double error) { return !std::isfinite(error); });
    if (errors.empty()) return;
    double sum = 0.0;
    double largest = 0.0;
    for (const double error : errors) {
        // Divided first: the sum of huge errors would overflow.
        sum += error / static_cast<double>(errors.size());
        largest = std::max(largest, error);
    }
    comparison.mean = sum;
    comparison.max = largest;
    if (largest == 0.0) return; // bit for bit the same, as most planes are: nothing to sort
    size_t end = errors.size();
    comparison.p99 = selectRank(errors, end, 0.99);
    comparison.p95 = selectRank(errors, end, 0.95);
    comparison.median = selectRank(errors, end, 0.5);
}

std::string formatValues(const std::vector<double>& values)
{
    if (values.size() == 1) return fmt::format("{:.9g}", values[0]);
    std::string text = "(";
    for (size_t i = 0; i < values.size(); ++i)
        text += fmt::format("{}{:.9g}", i == 0 ? "" : ", ", values[i]);
    return text + ")";
}

} // namespace crossray
