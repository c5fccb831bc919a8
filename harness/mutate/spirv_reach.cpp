#include "harness/mutate/spirv_reach.h"

#include "harness/compile/spirv_module.h"

#include <cstring>
#include <optional>

namespace crossray {

namespace {

using Values = std::map<uint32_t, int64_t>;

std::string readName(const SpirvInstruction& instruction, size_t firstWord)
{
    const char* const text = reinterpret_cast<const char*>(&instruction.words[firstWord]);
    return {text, strnlen(text, (instruction.words.size() - firstWord) * sizeof(uint32_t))};
}

std::optional<int64_t> compute(uint32_t op, int64_t a, int64_t b)
{
    switch (op) {
    case spv::OpIEqual:
    case spv::OpLogicalEqual:
        return a == b;
    case spv::OpINotEqual:
    case spv::OpLogicalNotEqual:
        return a != b;
    case spv::OpSLessThan:
        return a < b;
    case spv::OpSLessThanEqual:
        return a <= b;
    case spv::OpSGreaterThan:
        return a > b;
    case spv::OpSGreaterThanEqual:
        return a >= b;
    case spv::OpLogicalAnd:
        return a != 0 && b != 0;
    case spv::OpLogicalOr:
        return a != 0 || b != 0;
    case spv::OpBitwiseAnd:
        return a & b;
    case spv::OpBitwiseOr:
        return a | b;
    case spv::OpIAdd:
        return a + b;
    case spv::OpISub:
        return a - b;
    default:
        return std::nullopt;
    }
}

std::optional<int64_t> find(const Values& values, uint32_t id)
{
    const auto found = values.find(id);
    return found == values.end() ? std::nullopt : std::optional<int64_t>(found->second);
}

// `first`: the operand that is the operation's first.
std::optional<int64_t> evaluate(uint32_t op, const SpirvInstruction& instruction, size_t first, const Values& values)
{
    if (instruction.operandCount() <= first) return std::nullopt;
    const std::optional<int64_t> a = find(values, instruction.operand(first));
    if (op == spv::OpLogicalNot) return a ? std::optional<int64_t>(*a == 0) : std::nullopt;
    if (instruction.operandCount() <= first + 1) return std::nullopt;
    const std::optional<int64_t> b = find(values, instruction.operand(first + 1));
    // One side may be enough.
    if (op == spv::OpLogicalAnd && ((a && *a == 0) || (b && *b == 0))) return 0;
    if (op == spv::OpLogicalOr && ((a && *a != 0) || (b && *b != 0))) return 1;
    return a && b ? compute(op, *a, *b) : std::nullopt;
}

// The value that a phi has by those predecessors that are reached.
std::optional<int64_t> evaluatePhi(const SpirvInstruction& phi, const Values& values, const std::set<uint32_t>& reached)
{
    std::optional<int64_t> common;
    for (size_t i = 2; i + 1 < phi.operandCount(); i += 2) {
        if (!reached.contains(phi.operand(i + 1))) continue;
        const std::optional<int64_t> value = find(values, phi.operand(i));
        if (!value || (common && *common != *value)) return std::nullopt;
        common = value;
    }
    return common;
}

void reachTargets(const SpirvInstruction& end, const Values& values, std::set<uint32_t>& reached)
{
    if (end.op() == spv::OpBranch) {
        reached.insert(end.operand(0));
    } else if (end.op() == spv::OpBranchConditional) {
        const std::optional<int64_t> condition = find(values, end.operand(0));
        if (!condition || *condition != 0) reached.insert(end.operand(1));
        if (!condition || *condition == 0) reached.insert(end.operand(2));
    } else if (end.op() == spv::OpSwitch) {
        reached.insert(end.operand(1));
        for (size_t i = 3; i < end.operandCount(); i += 2)
            reached.insert(end.operand(i));
    }
}

} // namespace

SpirvReach::SpirvReach(const std::vector<uint32_t>& spirv) : module_(readSpirvModule(spirv))
{
    for (const SpirvInstruction& instruction : module_.globals) {
        if (instruction.op() == spv::OpName) names_[instruction.operand(0)] = readName(instruction, 2);
        if (instruction.op() == spv::OpEntryPoint && entry_ == 0) entry_ = instruction.operand(1);
    }
    for (size_t i = 0; i < module_.functions.size(); ++i)
        functions_[module_.functions[i].head.front().operand(1)] = i;
}

Values SpirvReach::evaluateConstants(const std::map<std::string, double>& specialization) const
{
    Values values;
    std::set<uint32_t> wholeTypes; // 32-bit integers
    for (const SpirvInstruction& instruction : module_.globals) {
        const auto op = instruction.op();
        if (op == spv::OpTypeInt) wholeTypes.insert(instruction.operand(0));
        const bool isTrue = op == spv::OpConstantTrue || op == spv::OpSpecConstantTrue;
        if (isTrue || op == spv::OpConstantFalse || op == spv::OpSpecConstantFalse)
            values[instruction.operand(1)] = isTrue ? 1 : 0;
        if ((op == spv::OpConstant || op == spv::OpSpecConstant) && wholeTypes.contains(instruction.operand(0))) {
            int64_t value = static_cast<int32_t>(instruction.operand(2));
            const auto name = names_.find(instruction.operand(1));
            const auto given = name == names_.end() ? specialization.end() : specialization.find(name->second);
            if (op == spv::OpSpecConstant && given != specialization.end()) value = static_cast<int64_t>(given->second);
            values[instruction.operand(1)] = value;
        }
        if (op != spv::OpSpecConstantOp) continue;
        if (const auto value = evaluate(instruction.operand(2), instruction, 3, values))
            values[instruction.operand(1)] = *value;
    }
    return values;
}

std::set<uint32_t> SpirvReach::findCalls(const SpirvFunction& function, Values& values) const
{
    std::set<uint32_t> calls, reached;
    if (function.blocks.empty()) return calls;
    reached.insert(function.blocks.front().label);
    // A block comes after those that dominate it. What only a later one leads to is a loop's head, which is reached
    // already.
    for (const SpirvBlock& block : function.blocks) {
        if (!reached.contains(block.label)) continue;
        for (const SpirvInstruction& instruction : block.body) {
            if (instruction.op() == spv::OpFunctionCall) calls.insert(instruction.operand(2));
            const std::optional<int64_t> value = instruction.op() == spv::OpPhi
                                                     ? evaluatePhi(instruction, values, reached)
                                                     : evaluate(instruction.op(), instruction, 2, values);
            if (value && instruction.operandCount() > 1) values[instruction.operand(1)] = *value;
        }
        reachTargets(block.body.back(), values, reached);
    }
    return calls;
}

std::set<std::string> SpirvReach::find(const std::map<std::string, double>& specialization) const
{
    Values values = evaluateConstants(specialization);
    std::set<std::string> found;
    std::set<uint32_t> seen{entry_};
    std::vector<uint32_t> open{entry_};
    while (!open.empty()) {
        const uint32_t id = open.back();
        open.pop_back();
        const auto function = functions_.find(id);
        if (function == functions_.end()) continue;
        if (const auto name = names_.find(id); name != names_.end()) found.insert(name->second);
        for (const uint32_t call : findCalls(module_.functions[function->second], values)) {
            if (seen.insert(call).second) open.push_back(call);
        }
    }
    return found;
}

bool SpirvReach::isAmong(const std::set<std::string>& names, const SpirvFunction& function) const
{
    const auto name = names_.find(function.head.front().operand(1));
    return name == names_.end() || names.contains(name->second);
}

std::vector<uint32_t> SpirvReach::keepOnly(const std::set<std::string>& kept, bool withLines) const
{
    SpirvModule module;
    module.header = module_.header;
    // The optimiser looks up what a name is of; those of what goes would lead nowhere.
    std::set<uint32_t> settable;
    for (const SpirvInstruction& instruction : module_.globals) {
        if (instruction.op() == spv::OpSpecConstant) settable.insert(instruction.operand(1));
    }
    for (const SpirvInstruction& instruction : module_.globals) { // names stand before what they are of
        const bool isDropped = instruction.op() == spv::OpName ? !settable.contains(instruction.operand(0))
                                                               : instruction.op() == spv::OpMemberName;
        if (!isDropped) module.globals.push_back(instruction);
    }
    std::set<uint32_t> called;
    for (const SpirvFunction& function : module_.functions) {
        if (!isAmong(kept, function)) continue;
        for (const SpirvBlock& block : function.blocks) {
            for (const SpirvInstruction& instruction : block.body) {
                if (instruction.op() == spv::OpFunctionCall) called.insert(instruction.operand(2));
            }
        }
    }
    for (const SpirvFunction& function : module_.functions) {
        if (isAmong(kept, function)) {
            module.functions.push_back(function);
            if (withLines) continue;
            for (SpirvBlock& block : module.functions.back().blocks)
                std::erase_if(block.body, [](const SpirvInstruction& instruction) {
                    return instruction.op() == spv::OpLine || instruction.op() == spv::OpNoLine;
                });
        } else if (called.contains(function.head.front().operand(1))) {
            SpirvBlock block;
            block.label = module.makeId();
            block.body.push_back(makeInstruction(spv::OpUnreachable, {}));
            module.functions.push_back({function.head, {std::move(block)}});
        }
    }
    return writeSpirvModule(module);
}

} // namespace crossray
