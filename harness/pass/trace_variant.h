// The specialization constants of the pass screen_trace for a case; shaders/bindings/variants.glsl.
#pragma once

#include "harness/case/case.h"

#include <cstdint>
#include <map>
#include <string>

namespace crossray {

// Bit i: the case writes output i.
uint32_t makeOutputMask(const Case& testCase);

std::map<std::string, double> makeTraceVariant(const Case& testCase);

} // namespace crossray
