// What is compared exactly: hit classes and counts.
#include "harness/judge/judge.h"

#include "harness/judge/tally.h"

#include <cmath>

namespace crossray {

int classOf(double value)
{
    if (std::isnan(value)) return kNanClass;
    const bool isClass = value == 0.0 || value == 1.0 || value == 2.0 || value == 3.0;
    return isClass ? static_cast<int>(value) : kNotAClass;
}

std::string nameOfClass(int value)
{
    if (value == kNanClass) return "NaN";
    if (value == kNotAClass) return "no class";
    return std::string(nameOf(static_cast<HitClass>(value)));
}

namespace {

std::string nameOfClassDifference(int kind)
{
    return nameOfClass((kind - 1) / 8) + " for " + nameOfClass((kind - 1) % 8);
}

enum class CountKind { kWhole, kFraction, kInfinite, kNotANumber };

CountKind classifyCount(double value)
{
    if (std::isnan(value)) return CountKind::kNotANumber;
    if (std::isinf(value)) return CountKind::kInfinite;
    return std::trunc(value) == value ? CountKind::kWhole : CountKind::kFraction;
}

std::string nameOfCountDifference(int kind)
{
    constexpr const char* kNames[] = {"whole number", "fraction", "Inf", "NaN"};
    return std::string(kNames[(kind - 1) / 8]) + " for " + kNames[(kind - 1) % 8];
}

} // namespace

Comparison compareHitClasses(const Plane& expected, const Plane& actual, const Mask& mask, const Tolerance& tolerance)
{
    checkComparison("hit class", 1, expected, actual, mask, tolerance, {});
    Tally tally(expected, actual, mask, "class");
    ConfusionMatrix confusion;
    for (size_t pixel = 0; pixel < expected.pixelCount(); ++pixel) {
        if (!tally.isCompared(pixel)) continue;
        const int e = classOf(expected.values[pixel]);
        const int a = classOf(actual.values[pixel]);
        const bool classes = e < kNotAClass && a < kNotAClass;
        if (classes) ++confusion.counts[e][a];
        if (e == a && e != kNotAClass) {
            tally.pass(pixel, 0.0);
        } else {
            tally.fail(pixel, classes ? 1.0 : kNoDistance, a * 8 + e + 1, classes);
        }
    }
    Comparison comparison = tally.finish(tolerance, nameOfClassDifference);
    comparison.confusion = confusion;
    return comparison;
}

Comparison compareCounts(const Plane& expected, const Plane& actual, const Mask& mask, const Tolerance& tolerance)
{
    checkComparison("count", 0, expected, actual, mask, tolerance, {});
    Tally tally(expected, actual, mask, "absolute");
    const auto stride = static_cast<size_t>(expected.channels);
    for (size_t pixel = 0; pixel < expected.pixelCount(); ++pixel) {
        if (!tally.isCompared(pixel)) continue;
        double error = 0.0;
        int kind = kBeyondTolerance;
        for (size_t value = pixel * stride; value < (pixel + 1) * stride; ++value) {
            const CountKind e = classifyCount(expected.values[value]);
            const CountKind a = classifyCount(actual.values[value]);
            if (e == CountKind::kWhole && a == CountKind::kWhole) {
                error = std::max(error, std::fabs(actual.values[value] - expected.values[value]));
            } else if (e != CountKind::kNotANumber || a != CountKind::kNotANumber) {
                error = kNoDistance;
                kind = static_cast<int>(a) * 8 + static_cast<int>(e) + 1;
            }
        }
        if (error == 0.0) {
            tally.pass(pixel, 0.0);
        } else {
            tally.fail(pixel, error, kind, kind == kBeyondTolerance);
        }
    }
    return tally.finish(tolerance, nameOfCountDifference);
}

Comparison compare(OutputType type, const Plane& expected, const Plane& actual, const Mask& mask,
                   const Tolerance& tolerance)
{
    switch (type) {
    case OutputType::kDirection:
        return compareDirections(expected, actual, mask, tolerance);
    case OutputType::kDepth:
        return compareDepths(expected, actual, mask, tolerance);
    case OutputType::kHitClass:
        return compareHitClasses(expected, actual, mask, tolerance);
    case OutputType::kColor:
        return compareColors(expected, actual, mask, tolerance);
    case OutputType::kScalar:
        return compareScalars(expected, actual, mask, tolerance);
    case OutputType::kCount:
        return compareCounts(expected, actual, mask, tolerance);
    }
    return {};
}

} // namespace crossray
