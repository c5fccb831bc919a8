#include "harness/compile/spirv_function.h"

#include "harness/base/error.h"
#include "harness/compile/spirv_module.h"

namespace crossray {

SpirvInstruction makeInstruction(spv::Op op, const std::vector<uint32_t>& operands)
{
    SpirvInstruction instruction;
    instruction.words.push_back((static_cast<uint32_t>(operands.size() + 1) << spv::WordCountShift) |
                                static_cast<uint32_t>(op));
    instruction.words.insert(instruction.words.end(), operands.begin(), operands.end());
    return instruction;
}

SpirvModule readSpirvModule(const std::vector<uint32_t>& spirv)
{
    SpirvModule module;
    bool inFunction = false;
    forEachSpirvInstruction(spirv, [&](uint32_t opcode, std::span<const uint32_t> operands) {
        const auto op = static_cast<spv::Op>(opcode);
        SpirvInstruction instruction = makeInstruction(op, {operands.begin(), operands.end()});
        if (op == spv::OpFunction) {
            module.functions.emplace_back();
            inFunction = true;
        }
        if (!inFunction) {
            module.globals.push_back(std::move(instruction));
            return;
        }
        SpirvFunction& function = module.functions.back();
        if (op == spv::OpFunctionEnd) {
            inFunction = false;
        } else if (op == spv::OpLabel) {
            if (operands.empty()) throw ShaderError("malformed SPIR-V: a label without an id");
            function.blocks.push_back({operands[0], {}});
        } else if (function.blocks.empty()) {
            function.head.push_back(std::move(instruction));
        } else {
            function.blocks.back().body.push_back(std::move(instruction));
        }
    });
    if (inFunction) throw ShaderError("malformed SPIR-V: it ends inside a function");
    module.header.assign(spirv.begin(), spirv.begin() + 5);
    return module;
}

std::vector<uint32_t> writeSpirvModule(const SpirvModule& module)
{
    std::vector<uint32_t> spirv = module.header;
    const auto append = [&spirv](const SpirvInstruction& instruction) {
        spirv.insert(spirv.end(), instruction.words.begin(), instruction.words.end());
    };
    for (const SpirvInstruction& instruction : module.globals)
        append(instruction);
    for (const SpirvFunction& function : module.functions) {
        for (const SpirvInstruction& instruction : function.head)
            append(instruction);
        for (const SpirvBlock& block : function.blocks) {
            append(makeInstruction(spv::OpLabel, {block.label}));
            for (const SpirvInstruction& instruction : block.body)
                append(instruction);
        }
        append(makeInstruction(spv::OpFunctionEnd, {}));
    }
    return spirv;
}

} // namespace crossray
