// SPIRV-Tools: specialization, optimisation, validation, disassembly.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace crossray {

// Sets the constants by name and freezes every specialization constant, so that the optimiser sees plain constants.
// Throws InputError that lists the known names when one is unknown.
std::vector<uint32_t> specialize(const std::vector<uint32_t>& spirv, const std::map<std::string, double>& values,
                                 bool optimize);
// Without what the constants of a frozen module rule out: branches, and functions that are then called by none. What
// specialize() makes of the rest is the same, and much sooner.
std::vector<uint32_t> dropDeadFunctions(const std::vector<uint32_t>& spirv);
std::vector<uint32_t> stripDebugInfo(const std::vector<uint32_t>& spirv);
// Throws ShaderError when the module breaks the rules of Vulkan 1.1.
void validate(const std::vector<uint32_t>& spirv);
std::string disassembleSpirv(const std::vector<uint32_t>& spirv);

} // namespace crossray
