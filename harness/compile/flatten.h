// Branches to selects.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace crossray {

// Turns `if (c) x = a; else x = b;` into a select wherever both sides are cheap, pure and cannot trap, innermost first:
// glslang writes every ?:, && and || as a branch. SwiftShader's compile time doubles with each such branch in a loop,
// and a driver that runs many pixels in step executes both sides anyway. Values are the same, since no arithmetic is
// changed. Expects SSA form (after the optimiser); throws ShaderError on a module whose instructions do not add up.
std::vector<uint32_t> flattenBranches(const std::vector<uint32_t>& spirv);

size_t countBranches(const std::vector<uint32_t>& spirv);

} // namespace crossray
