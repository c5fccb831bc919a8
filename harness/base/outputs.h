// The outputs that the shaders can write: the debug modes as raw planes. One table for the shaders' store hook, the judge, the
// case format and the documents; the numbers are shared with shaders/crossray/shared/outputs.glsl.
#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace crossray {

// How an output is compared.
enum class OutputType {
    kDirection, // unit vector, compared by angle
    kDepth,     // metres along the view axis, compared by relative error and ULP
    kHitClass,  // 0 no raycast, 1 hit, 2 miss, 3 unknown; compared exactly, or by recall, precision and false-hit budgets
    kColor,     // linear RGB radiance, compared by absolute and relative error
    kScalar,    // weights, NDC positions; compared by absolute and relative error
    kCount,     // whole numbers, compared exactly
};

struct OutputInfo {
    int id; // bit and slot order in the shaders' output mask
    std::string_view name;
    OutputType type;
    int channels;
    std::string_view unit;    // "" where there is none
    std::string_view summary; // one line for `crossray show` and the documents
};

// All outputs in id order.
std::span<const OutputInfo> allOutputs();
std::optional<OutputInfo> findOutput(std::string_view name);

// Values of the HitSuccess plane.
enum class HitClass : int { kNoRaycast = 0, kHit = 1, kMiss = 2, kUnknown = 3 };
std::string_view nameOf(HitClass hitClass);

} // namespace crossray
