// A SPIR-V module as editable instructions: everything before the first function, and functions as blocks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <spirv_cross/spirv.hpp>
#include <vector>

namespace crossray {

struct SpirvInstruction {
    std::vector<uint32_t> words; // the first holds length and opcode
    spv::Op op() const { return static_cast<spv::Op>(words[0] & spv::OpCodeMask); }
    size_t operandCount() const { return words.size() - 1; }
    uint32_t operand(size_t index) const { return words.at(index + 1); }
};
SpirvInstruction makeInstruction(spv::Op op, const std::vector<uint32_t>& operands);

struct SpirvBlock {
    uint32_t label = 0;
    std::vector<SpirvInstruction> body; // without the label, with the terminator
};

struct SpirvFunction {
    std::vector<SpirvInstruction> head; // OpFunction and its parameters
    std::vector<SpirvBlock> blocks;
};

struct SpirvModule {
    std::vector<uint32_t> header; // five words; the fourth is the bound of ids
    std::vector<SpirvInstruction> globals;
    std::vector<SpirvFunction> functions;
    uint32_t makeId() { return header[3]++; }
};

// Throws ShaderError on a module whose instructions do not add up.
SpirvModule readSpirvModule(const std::vector<uint32_t>& spirv);
std::vector<uint32_t> writeSpirvModule(const SpirvModule& module);

} // namespace crossray
