// What this project reads from a SPIR-V module by itself.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace crossray {

// Calls visit(opcode, operands) for each instruction. Throws ShaderError on words that are no module.
void forEachSpirvInstruction(const std::vector<uint32_t>& spirv,
                             const std::function<void(uint32_t opcode, std::span<const uint32_t> operands)>& visit);

enum class SpecializationType { kBool, kInt, kUint, kFloat, kDouble };

struct SpecializationConstant {
    std::string name; // OpName: the name in the source
    uint32_t specId = 0;
    SpecializationType type = SpecializationType::kInt;
    double defaultValue = 0;
};

// All functions throw ShaderError on a module whose instructions do not add up.
std::vector<SpecializationConstant> findSpecializationConstants(const std::vector<uint32_t>& spirv);
// Of the first entry point; {1, 1, 1} for a stage that has none. A size that hangs on specialization constants is read
// from their current defaults.
std::array<uint32_t, 3> findLocalSize(const std::vector<uint32_t>& spirv);
// Writes the size into the execution mode: the optimiser takes the constant that overrides it for dead.
void setLocalSize(std::vector<uint32_t>& spirv, const std::array<uint32_t, 3>& size);
// Forbids the optimiser to fuse or to regroup any float arithmetic: a fused multiply-add or (x * 2) * 3 as x * 6 rounds
// otherwise than the source says, and drivers differ in whether they fuse.
std::vector<uint32_t> forbidContraction(const std::vector<uint32_t>& spirv);
// Takes all NoContraction decorations away again, those of the source's `precise` too.
std::vector<uint32_t> allowContraction(const std::vector<uint32_t>& spirv);
// Numbers of the bindings that the module declares; after optimisation, those that it uses.
std::set<uint32_t> findBindings(const std::vector<uint32_t>& spirv);
// Whether some variable is both loaded and stored to (or is handed to a call, which may do both).
bool loadsWhatItStores(const std::vector<uint32_t>& spirv);
size_t countSpirvInstructions(const std::vector<uint32_t>& spirv);

// The words of a constant of the given type. Throws InputError that says what is allowed when the value does not fit.
std::vector<uint32_t> encodeConstant(const SpecializationConstant& constant, double value);

} // namespace crossray
