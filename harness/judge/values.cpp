// Depths, colours and scalars: numbers compared by relative error, absolute error and units in the last place.
#include "harness/judge/judge.h"

#include "harness/base/error.h"
#include "harness/judge/tally.h"

#include <cmath>

namespace crossray {

namespace {

enum class NumberKind { kFinite, kNan, kPlusInfinity, kMinusInfinity, kZero };

NumberKind kindOf(double value)
{
    if (std::isfinite(value)) return NumberKind::kFinite;
    if (std::isnan(value)) return NumberKind::kNan;
    return value > 0.0 ? NumberKind::kPlusInfinity : NumberKind::kMinusInfinity;
}

constexpr int differenceKind(NumberKind expected, NumberKind actual)
{
    return static_cast<int>(actual) * 8 + static_cast<int>(expected) + 1;
}

std::string nameOfNumberDifference(int kind)
{
    constexpr const char* kNames[] = {"finite", "NaN", "Inf", "-Inf", "zero"};
    return std::string(kNames[(kind - 1) / 8]) + " for " + kNames[(kind - 1) % 8];
}

enum class Measure { kRelative, kAbsolute, kUlp };

struct ChannelDifference {
    double error = 0;
    bool failed = false;
};

double relativeError(double expected, double actual, double difference)
{
    if (difference == 0.0) return 0.0;
    // The difference of two huge values can overflow where its ratio does not.
    if (std::isinf(difference)) return std::fabs(actual / expected - 1.0);
    return expected == 0.0 ? kNoDistance : difference / std::fabs(expected);
}

ChannelDifference measureFinite(double expected, double actual, const Tolerance& tolerance, Measure measure)
{
    if (expected == actual) return {};
    if (std::fabs(expected) < tolerance.floor && std::fabs(actual) < tolerance.floor) return {};
    const double difference = std::fabs(actual - expected);
    double relative = 0.0;
    if (tolerance.relative || measure == Measure::kRelative) relative = relativeError(expected, actual, difference);
    double ulps = 0.0;
    if (tolerance.ulps || measure == Measure::kUlp) ulps = ulpDistance(expected, actual, tolerance.doublePrecision);
    const bool within = (tolerance.relative && relative <= *tolerance.relative) ||
                        (tolerance.absolute && difference <= *tolerance.absolute) ||
                        (tolerance.ulps && ulps <= *tolerance.ulps);
    const double error = measure == Measure::kRelative ? relative : measure == Measure::kAbsolute ? difference : ulps;
    return {error, !within};
}

Comparison compareNumbers(std::string_view what, int channels, bool zeroMeansNone, Measure measure,
                          const Plane& expected, const Plane& actual, const Mask& mask, const Tolerance& tolerance)
{
    checkComparison(what, channels, expected, actual, mask, tolerance, {.numbers = true});
    // Where only ulps are asked for they tell more than another unit; `worst` keeps to the type's own.
    if (!tolerance.relative && !tolerance.absolute && !tolerance.worst) measure = Measure::kUlp;
    Tally tally(expected, actual, mask,
                measure == Measure::kRelative   ? "relative"
                : measure == Measure::kAbsolute ? "absolute"
                                                : "ulp");
    const size_t pixels = expected.pixelCount();
    const auto stride = static_cast<size_t>(expected.channels);
    for (size_t pixel = 0; pixel < pixels; ++pixel) {
        if (!tally.isCompared(pixel)) continue;
        double error = 0.0;
        bool failed = false;
        int kind = kBeyondTolerance;
        for (size_t value = pixel * stride; value < (pixel + 1) * stride; ++value) {
            const double e = expected.values[value];
            const double a = actual.values[value];
            if (std::isfinite(e) && std::isfinite(a)) {
                const ChannelDifference channel = measureFinite(e, a, tolerance, measure);
                error = std::max(error, channel.error);
                failed = failed || channel.failed;
                if (zeroMeansNone && channel.failed && (e == 0.0 || a == 0.0)) {
                    kind = differenceKind(e == 0.0 ? NumberKind::kZero : NumberKind::kFinite,
                                          a == 0.0 ? NumberKind::kZero : NumberKind::kFinite);
                }
                continue;
            }
            const NumberKind expectedKind = kindOf(e);
            const NumberKind actualKind = kindOf(a);
            if (expectedKind == actualKind) continue;
            error = kNoDistance;
            failed = true;
            kind = differenceKind(expectedKind, actualKind);
            break;
        }
        if (failed) {
            tally.fail(pixel, error, kind);
        } else {
            tally.pass(pixel, error);
        }
    }
    return tally.finish(tolerance, nameOfNumberDifference);
}

} // namespace

Comparison compareDepths(const Plane& expected, const Plane& actual, const Mask& mask, const Tolerance& tolerance)
{
    // A depth of exactly 0 means "none", so that against anything else is worth a name.
    return compareNumbers("depth", 1, true, Measure::kRelative, expected, actual, mask, tolerance);
}

Comparison compareColors(const Plane& expected, const Plane& actual, const Mask& mask, const Tolerance& tolerance)
{
    return compareNumbers("colour", 3, false, Measure::kAbsolute, expected, actual, mask, tolerance);
}

Comparison compareScalars(const Plane& expected, const Plane& actual, const Mask& mask, const Tolerance& tolerance)
{
    return compareNumbers("scalar", 0, false, Measure::kAbsolute, expected, actual, mask, tolerance);
}

Comparison compareWithBound(const Plane& bound, const Plane& actual, const Mask& mask, bool isMagnitude)
{
    checkComparison("bound", 0, bound, actual, mask, {}, {});
    Tally tally(bound, actual, mask, "absolute");
    const auto stride = static_cast<size_t>(bound.channels);
    for (size_t pixel = 0; pixel < bound.pixelCount(); ++pixel) {
        if (!tally.isCompared(pixel)) continue;
        double error = 0.0;
        int kind = kBeyondTolerance;
        for (size_t value = pixel * stride; value < (pixel + 1) * stride; ++value) {
            const double b = bound.values[value];
            const double a = isMagnitude ? std::fabs(actual.values[value]) : actual.values[value];
            const bool isNumber = std::isfinite(a);
            if (isNumber && a <= b) continue;
            error = isNumber ? std::max(error, a - b) : kNoDistance;
            if (!isNumber) kind = differenceKind(NumberKind::kFinite, kindOf(actual.values[value]));
        }
        if (error > 0.0) {
            tally.fail(pixel, error, kind);
        } else {
            tally.pass(pixel, 0.0);
        }
    }
    return tally.finish({}, nameOfNumberDifference);
}

} // namespace crossray
