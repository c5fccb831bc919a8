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
std::vector<uint32_t> stripDebugInfo(const std::vector<uint32_t>& spirv);
// Throws ShaderError when the module breaks the rules of Vulkan 1.1.
void validate(const std::vector<uint32_t>& spirv);
std::string disassembleSpirv(const std::vector<uint32_t>& spirv);

} // namespace crossray
