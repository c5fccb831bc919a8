#include "harness/judge/judge.h"

#include <bit>
#include <cmath>
#include <limits>

namespace crossray {

namespace {

// Sign-magnitude bits as an ordered integer, so that neighbours differ by 1 and both zeros are 0.
template <typename Signed, typename Float>
Signed orderedBits(Float value)
{
    const Signed bits = std::bit_cast<Signed>(value);
    return bits >= 0 ? bits : std::numeric_limits<Signed>::min() - bits;
}

} // namespace

double ulpDistance(double a, double b, bool doublePrecision)
{
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    if (std::isnan(a) || std::isnan(b)) return kInfinity;
    if (a == b) return 0.0;
    if (doublePrecision) {
        const int64_t orderedA = orderedBits<int64_t>(a);
        const int64_t orderedB = orderedBits<int64_t>(b);
        // Unsigned: the distance from one end to the other does not fit a signed number.
        const uint64_t low = static_cast<uint64_t>(orderedA < orderedB ? orderedA : orderedB);
        const uint64_t high = static_cast<uint64_t>(orderedA < orderedB ? orderedB : orderedA);
        return static_cast<double>(high - low);
    }
    const float floatA = static_cast<float>(a);
    const float floatB = static_cast<float>(b);
    // Two different doubles that both overflow would look equal.
    if (std::isinf(floatA) != std::isinf(a) || std::isinf(floatB) != std::isinf(b)) return kInfinity;
    const int64_t distance = int64_t{orderedBits<int32_t>(floatA)} - int64_t{orderedBits<int32_t>(floatB)};
    return static_cast<double>(distance < 0 ? -distance : distance);
}

} // namespace crossray
