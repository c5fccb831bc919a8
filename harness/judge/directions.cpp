#include "harness/judge/judge.h"

#include "harness/judge/tally.h"

#include <cmath>
#include <limits>

namespace crossray {

namespace {

enum class VectorKind { kDirection, kZero, kNonUnit, kNan, kInfinity };

VectorKind kindOf(const double* v)
{
    const double squared = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    constexpr double kLow = (1.0 - kUnitLengthBound) * (1.0 - kUnitLengthBound);
    constexpr double kHigh = (1.0 + kUnitLengthBound) * (1.0 + kUnitLengthBound);
    if (squared >= kLow && squared <= kHigh) return VectorKind::kDirection;
    if (std::isnan(v[0]) || std::isnan(v[1]) || std::isnan(v[2])) return VectorKind::kNan;
    if (std::isinf(v[0]) || std::isinf(v[1]) || std::isinf(v[2])) return VectorKind::kInfinity;
    // Not by the square, which underflows for tiny vectors.
    if (v[0] == 0.0 && v[1] == 0.0 && v[2] == 0.0) return VectorKind::kZero;
    return VectorKind::kNonUnit;
}

constexpr int differenceKind(VectorKind expected, VectorKind actual)
{
    return static_cast<int>(actual) * 8 + static_cast<int>(expected) + 1;
}

std::string nameOfVectorDifference(int kind)
{
    constexpr const char* kNames[] = {"direction", "zero vector", "non-unit vector", "NaN", "Inf"};
    const int actual = (kind - 1) / 8;
    const int expected = (kind - 1) % 8;
    const int firstNonFinite = static_cast<int>(VectorKind::kNan);
    // Beside NaN and infinity it only matters that the other one is finite.
    const bool anyNonFinite = actual >= firstNonFinite || expected >= firstNonFinite;
    const auto name = [&](int index) { return anyNonFinite && index < firstNonFinite ? "finite" : kNames[index]; };
    return std::string(name(actual)) + " for " + name(expected);
}

// Angle between two unit vectors in degrees, from the sine and the cosine: acos(dot) alone is blind below 1e-6 degrees
// in double and below 0.02 degrees in float. The cross product is taken with the difference, which is exact for near
// vectors, so that tiny angles keep their digits.
double angleDegrees(const double* e, const double* a)
{
    constexpr double kDegrees = 57.295779513082320877;
    const double dx = a[0] - e[0], dy = a[1] - e[1], dz = a[2] - e[2];
    const double cx = dy * e[2] - dz * e[1];
    const double cy = dz * e[0] - dx * e[2];
    const double cz = dx * e[1] - dy * e[0];
    const double sine = std::sqrt(cx * cx + cy * cy + cz * cz);
    const double cosine = a[0] * e[0] + a[1] * e[1] + a[2] * e[2];
    const double t = sine / cosine;
    // atan's series, exact to the last bit here and several times as fast as the call.
    if (cosine > 0.0 && t < 0.01) {
        const double t2 = t * t;
        return t * (1.0 - t2 * (1.0 / 3.0 - t2 * (1.0 / 5.0 - t2 / 7.0))) * kDegrees;
    }
    return std::atan2(sine, cosine) * kDegrees;
}

} // namespace

Comparison compareDirections(const Plane& expected, const Plane& actual, const Mask& mask, const Tolerance& tolerance)
{
    checkComparison("direction", 3, expected, actual, mask, tolerance, {.degrees = true});
    Tally tally(expected, actual, mask, "degrees");
    const size_t pixels = expected.pixelCount();
    for (size_t pixel = 0; pixel < pixels; ++pixel) {
        if (!tally.isCompared(pixel)) continue;
        const double* e = &expected.values[pixel * 3];
        const double* a = &actual.values[pixel * 3];
        const VectorKind expectedKind = kindOf(e);
        const VectorKind actualKind = kindOf(a);
        if (expectedKind == VectorKind::kDirection && actualKind == VectorKind::kDirection) {
            const double error = angleDegrees(e, a);
            if (error <= *tolerance.degrees) {
                tally.pass(pixel, error);
            } else {
                tally.fail(pixel, error, kBeyondTolerance);
            }
            continue;
        }
        const bool same =
            expectedKind == actualKind && (expectedKind == VectorKind::kZero || expectedKind == VectorKind::kNan);
        if (same) {
            tally.pass(pixel, 0.0);
        } else {
            tally.fail(pixel, std::numeric_limits<double>::infinity(), differenceKind(expectedKind, actualKind),
                       actualKind == VectorKind::kDirection || actualKind == VectorKind::kZero);
        }
    }
    return tally.finish(tolerance, nameOfVectorDifference);
}

} // namespace crossray
