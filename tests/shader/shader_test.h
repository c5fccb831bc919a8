// What every test of the shader library includes, before harness/backend/cpu/glsl.h. The tests are built twice, as
// test_shader32 and test_shader64; a literal is a float in the former. Closed forms are written here in C++ on the
// library's scalar or in double, and not by the library's own functions.
#pragma once

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <ostream>
#include <vector>

#if CROSSRAY_GLSL_PRECISION == 64
using Real = double;
#define CROSSRAY_SHADER_NAMESPACE crossray::cpu64
#else
using Real = float;
#define CROSSRAY_SHADER_NAMESPACE crossray::cpu32
#endif

constexpr Real kNaN = std::numeric_limits<Real>::quiet_NaN();
constexpr Real kInfinity = std::numeric_limits<Real>::infinity();
// A handful of roundings.
constexpr Real kUlps = 16 * std::numeric_limits<Real>::epsilon();
