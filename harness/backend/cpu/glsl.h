// Compiles the GLSL library as C++, in float or in double: include this, then the .glsl files and the bodies of their
// hooks, then glsl_end.h.
//
//     #define CROSSRAY_GLSL_PRECISION 64            // or 32
//     #include "harness/backend/cpu/glsl.h"         // opens namespace crossray::cpu64 and an unnamed namespace in it
//     #include "crossray/project/hiz.glsl"
//     vec2 fetchDepthPyramid(ivec2 cell, int level) { ... }
//     #include "harness/backend/cpu/glsl_end.h"     // closes both
//
// The rest of the unit reaches the names through `using namespace crossray::cpu64`. All names have internal linkage, so
// that units with different hooks live in one program. Include every C++ header before this one.
//
// A float unit is compiled with -fsingle-precision-constant, so that 0.5 is a float there, as in GLSL (CMake sets it
// for *32.cpp of this folder). One unit holds one precision.
//
// What it offers: GLM's scalars, vec2..4, ivec2..4, uvec2..4, bvec2..4, mat3, mat4, swizzles that are read (v.xyz), and
// GLSL's operators and built-in functions as overloads whose arguments' types are given, not deduced.
//
// What it does not offer: arrays' constructors, not(), `f` suffixes (a float in a double unit), and in double the bit
// casts floatBitsToInt and its kin. The library does not write through swizzles.
#pragma once

#include "harness/backend/cpu/glsl_glm.h"

#include <bit>
#include <cmath>
#include <cstdint>

#if !defined(CROSSRAY_GLSL_PRECISION) || (CROSSRAY_GLSL_PRECISION != 32 && CROSSRAY_GLSL_PRECISION != 64)
#error "define CROSSRAY_GLSL_PRECISION as 32 or 64 before including harness/backend/cpu/glsl.h"
#endif

// A unit uses some of what it includes.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-variable"

#if CROSSRAY_GLSL_PRECISION == 64
#define float double
namespace crossray::cpu64 {
#else
static_assert(sizeof(0.5) == sizeof(float), "compile this unit with -fsingle-precision-constant");
namespace crossray::cpu32 {
#endif
namespace {

// A template of nothing, whose arguments still convert: its body, and what GLM's templates make of it, is compiled
// where it is called. A unit calls few of the 405.
// clang-format off
#define CROSSRAY_LAZY template <int = 0> inline
// clang-format on
#include "harness/backend/cpu/glsl_types.inl"
#include "harness/backend/cpu/glsl_functions.inl"
#undef CROSSRAY_LAZY
