// Small planes for the tests of the comparators.
#pragma once

#include "harness/judge/judge.h"

#include <cmath>
#include <initializer_list>
#include <limits>
#include <vector>

namespace crossray::test {

inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInf = std::numeric_limits<double>::infinity();

// One row of pixels.
inline Plane row(int channels, std::vector<double> values)
{
    Plane plane("row", static_cast<int>(values.size()) / channels, 1, channels);
    plane.values = std::move(values);
    return plane;
}

inline Tolerance absolute(double bound)
{
    Tolerance tolerance;
    tolerance.absolute = bound;
    return tolerance;
}

inline uint64_t sumOf(const std::map<std::string, uint64_t>& census)
{
    uint64_t sum = 0;
    for (const auto& [kind, count] : census)
        sum += count;
    return sum;
}

// A unit vector `degrees` away from +z, exact for tiny angles.
inline std::vector<double> tilted(double degrees)
{
    const double radians = degrees * 0.017453292519943295769;
    return {std::sin(radians), 0.0, std::cos(radians)};
}

} // namespace crossray::test
