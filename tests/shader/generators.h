// Random input for the property tests: whole numbers that RapidCheck draws and shrinks, mapped to scalars.
#pragma once

#include "tests/shader/shader_test.h"

// Uniform in [lo, hi].
inline Real drawReal(Real lo, Real hi)
{
    constexpr int kSteps = 1 << 20;
    return lo + (hi - lo) * static_cast<Real>(*rc::gen::inRange(0, kSteps + 1)) / static_cast<Real>(kSteps);
}

// 10^x for x uniform in [lo, hi].
inline Real drawMagnitude(Real lo, Real hi)
{
    return std::pow(Real(10), drawReal(lo, hi));
}

// A number of the kind that breaks code: zeros, units, tiny, huge, not a number; or an ordinary one.
inline Real drawHostile()
{
    const std::vector<Real> values{Real(0),      Real(-0.0), Real(1),    Real(-1),    Real(0.5),  Real(1e-30),
                                   Real(-1e-20), Real(1e-7), Real(1e20), Real(-1e30), Real(3e38), Real(65504),
                                   kNaN,         kInfinity,  -kInfinity, Real(0.1),   Real(-3)};
    const int pick = *rc::gen::inRange(0, static_cast<int>(values.size()) + 4);
    return pick < static_cast<int>(values.size()) ? values[static_cast<size_t>(pick)] : drawReal(-5, 5);
}

template <typename Vector>
Vector drawUnitVector()
{
    // Archimedes: height and angle uniform.
    const Real z = drawReal(-1, 1);
    const Real angle = drawReal(0, Real(6.283185307179586));
    const Real r = std::sqrt(std::max(Real(0), 1 - z * z));
    return Vector(r * std::cos(angle), r * std::sin(angle), z);
}
template <typename Vector>
Vector drawPoint(Real extent)
{
    return Vector(drawReal(-extent, extent), drawReal(-extent, extent), drawReal(-extent, extent));
}
template <typename Vector>
Vector drawHostileVector()
{
    return Vector(drawHostile(), drawHostile(), drawHostile());
}
