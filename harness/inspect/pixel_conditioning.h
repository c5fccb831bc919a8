// What is known of a case's pixels beside their answers: how far an ulp of input moves them.
#pragma once

#include "harness/inspect/pixel_trace.h"

#include <span>
#include <string>
#include <vector>

namespace crossray {

// Pixels up to which a trace measures it unasked: a fraction of a second.
inline constexpr int kMeasuredUnasked = 128 * 128;

// On cpu32 and cpu64 of these workers. What keeps them from an answer is the note.
Conditioning measureConditioning(const Case& testCase, const TraceWorkers& workers);
Conditioning measureConditioning(const Case& testCase, const Folders& folders);

// One line an output: "HitDepth  1.7 (cpu32 2.5, rounding 0.8)" and, above the bound, why it is undecidable.
std::vector<std::string> describePixelConditioning(std::span<const PixelConditioning> outputs);

} // namespace crossray
