// A compute program and what it must find bound.
#pragma once

#include "harness/backend/device.h"
#include "harness/backend/gl/gl_handles.h"
#include "harness/backend/gl/gl_limits.h"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace crossray {

// Storage blocks, uniform blocks and samplers have separate binding numbers in GL; here they come from one list.
enum class GlResourceKind { kStorageBlock, kUniformBlock, kSampler };
const char* nameGlResourceKind(GlResourceKind kind);

struct GlResource {
    GlResourceKind kind = GlResourceKind::kStorageBlock;
    uint32_t binding = 0;
    int64_t bytes = 0; // the least that a block needs; an array without a length counts as one element
    std::string name;
};

struct GlProgram {
    GlProgramName name;
    std::vector<GlResource> resources; // those that the code really uses
    bool hasRun = false;               // the driver has made machine code of it
};

// The local size that GLSL text declares; 1 where it says nothing or no plain number.
std::array<int64_t, 3> parseLocalSize(std::string_view glsl);

// Throws ShaderError "ENTRY: ..." with the driver's log, or with the limit that the program exceeds.
GlProgram compileGlProgram(const ProgramSource& source, const GlLimits& limits);

} // namespace crossray
