// A person's own tracer between the harness's own code: what it may do, and how its loops are counted.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace crossray {

// The include of shaders/entry/own_trace.comp that a person's file stands in for, and what the file must define.
inline constexpr const char* kOwnTracerInclude = "own/tracer.glsl";
inline constexpr const char* kOwnTracerFunction = "OwnHit traceOwn(OwnRay ray)";
// Rounds of all loops of one ray together, after which the loop is taken for endless. Below 65535, where some drivers
// silently end a loop.
inline constexpr uint32_t kMostOwnRounds = 60000;

// Checks and completes SPIR-V with lines, as glslang makes it, before any optimisation. Of all that traceOwn() calls,
// and of what the person's file does elsewhere: it may read resources and the harness's own variables through the
// functions of shaders/pass/own_interface.glsl alone, so that each read is counted; else a ShaderError names the
// person's line. Each loop gets a gate before its body that adds a round to `ownRounds`, ends the loop after
// kMostOwnRounds, and then puts its line into `ownEndlessLine`. `file` is what messages call the person's file.
std::vector<uint32_t> confineOwnTracer(const std::vector<uint32_t>& spirv, const std::string& file);

} // namespace crossray
