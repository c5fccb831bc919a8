// How well a case's questions are posed, as a person reads it.
#pragma once

#include "harness/inspect/pixel_conditioning.h"
#include "harness/run/results.h"

#include <string>

namespace crossray {

// One line an output: pixels, those that are undecidable or fragile, amplification, the worst pixel.
std::string formatConditioning(const ConditioningResult& conditioning);
// Of a run: the cases with pixels that are undecidable or fragile, those with most of them first, and how many have
// none. Empty where nothing was measured.
std::string formatConditioning(const RunResult& run);

} // namespace crossray
