#include "harness/compile/spirv_module.h"

#include "harness/base/error.h"

#include <fmt/format.h>
#include <spirv_cross/spirv.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <span>

namespace crossray {

namespace {

constexpr size_t kHeaderWords = 5;

// Calls visit(opcode, operands) for each instruction.
template <typename Visit>
void forEachInstruction(const std::vector<uint32_t>& spirv, Visit visit)
{
    if (spirv.size() < kHeaderWords || spirv[0] != spv::MagicNumber) throw ShaderError("this is no SPIR-V module");
    for (size_t at = kHeaderWords; at < spirv.size();) {
        const size_t length = spirv[at] >> spv::WordCountShift;
        if (length == 0 || length > spirv.size() - at) {
            throw ShaderError(fmt::format("malformed SPIR-V: the instruction at word {} has {} words", at, length));
        }
        visit(static_cast<spv::Op>(spirv[at] & spv::OpCodeMask), std::span(spirv).subspan(at + 1, length - 1));
        at += length;
    }
}

void requireOperands(std::span<const uint32_t> operands, size_t count)
{
    if (operands.size() < count) throw ShaderError("malformed SPIR-V: an instruction lacks operands");
}

std::string readText(std::span<const uint32_t> words)
{
    std::string text(words.size() * sizeof(uint32_t), '\0');
    std::memcpy(text.data(), words.data(), text.size());
    text.resize(std::strlen(text.c_str()));
    return text;
}

bool isFloatArithmetic(spv::Op op)
{
    switch (op) {
    case spv::OpFAdd:
    case spv::OpFSub:
    case spv::OpFMul:
    case spv::OpFDiv:
    case spv::OpFRem:
    case spv::OpFMod:
    case spv::OpFNegate:
    case spv::OpVectorTimesScalar:
    case spv::OpMatrixTimesScalar:
    case spv::OpVectorTimesMatrix:
    case spv::OpMatrixTimesVector:
    case spv::OpMatrixTimesMatrix:
    case spv::OpOuterProduct:
    case spv::OpDot:
        return true;
    default:
        return false;
    }
}

double decodeConstant(SpecializationType type, std::span<const uint32_t> words)
{
    switch (type) {
    case SpecializationType::kBool:
        return words.empty() || words[0] != 0 ? 1 : 0;
    case SpecializationType::kInt:
        return static_cast<int32_t>(words[0]);
    case SpecializationType::kUint:
        return words[0];
    case SpecializationType::kFloat:
        return static_cast<double>(std::bit_cast<float>(words[0]));
    case SpecializationType::kDouble:
        requireOperands(words, 2);
        return std::bit_cast<double>(words[0] | (static_cast<uint64_t>(words[1]) << 32));
    }
    return 0;
}

} // namespace

void forEachSpirvInstruction(const std::vector<uint32_t>& spirv,
                             const std::function<void(uint32_t opcode, std::span<const uint32_t> operands)>& visit)
{
    forEachInstruction(spirv, [&visit](spv::Op op, std::span<const uint32_t> operands) {
        visit(static_cast<uint32_t>(op), operands);
    });
}

std::vector<SpecializationConstant> findSpecializationConstants(const std::vector<uint32_t>& spirv)
{
    std::map<uint32_t, std::string> names;
    std::map<uint32_t, uint32_t> specIds;
    std::map<uint32_t, SpecializationType> types;
    std::vector<SpecializationConstant> result;
    const auto add = [&](uint32_t id, SpecializationType type, double value) {
        const auto specId = specIds.find(id);
        if (specId != specIds.end()) result.push_back({names[id], specId->second, type, value});
    };
    forEachInstruction(spirv, [&](spv::Op op, std::span<const uint32_t> operands) {
        switch (op) {
        case spv::OpName:
            requireOperands(operands, 2);
            names[operands[0]] = readText(operands.subspan(1));
            break;
        case spv::OpDecorate:
            requireOperands(operands, 2);
            if (operands[1] != spv::DecorationSpecId) break;
            requireOperands(operands, 3);
            specIds[operands[0]] = operands[2];
            break;
        case spv::OpTypeInt:
            requireOperands(operands, 3);
            if (operands[1] == 32)
                types[operands[0]] = operands[2] != 0 ? SpecializationType::kInt : SpecializationType::kUint;
            break;
        case spv::OpTypeFloat:
            requireOperands(operands, 2);
            if (operands[1] == 32) types[operands[0]] = SpecializationType::kFloat;
            if (operands[1] == 64) types[operands[0]] = SpecializationType::kDouble;
            break;
        case spv::OpSpecConstantTrue:
        case spv::OpSpecConstantFalse:
            requireOperands(operands, 2);
            add(operands[1], SpecializationType::kBool, op == spv::OpSpecConstantTrue ? 1 : 0);
            break;
        case spv::OpSpecConstant:
            requireOperands(operands, 3);
            if (const auto type = types.find(operands[0]); type != types.end()) {
                add(operands[1], type->second, decodeConstant(type->second, operands.subspan(2)));
            }
            break;
        default:
            break;
        }
    });
    return result;
}

std::array<uint32_t, 3> findLocalSize(const std::vector<uint32_t>& spirv)
{
    std::array<uint32_t, 3> size{1, 1, 1};
    uint32_t workgroupSize = 0; // the id that bears the built-in, which wins over the execution mode
    std::map<uint32_t, uint32_t> constants;
    forEachInstruction(spirv, [&](spv::Op op, std::span<const uint32_t> operands) {
        if (op == spv::OpExecutionMode && operands.size() >= 5 && operands[1] == spv::ExecutionModeLocalSize) {
            size = {operands[2], operands[3], operands[4]};
        } else if (op == spv::OpDecorate && operands.size() >= 3 && operands[1] == spv::DecorationBuiltIn &&
                   operands[2] == spv::BuiltInWorkgroupSize) {
            workgroupSize = operands[0];
        } else if ((op == spv::OpConstant || op == spv::OpSpecConstant) && operands.size() == 3) {
            constants[operands[1]] = operands[2];
        } else if ((op == spv::OpConstantComposite || op == spv::OpSpecConstantComposite) && operands.size() == 5 &&
                   workgroupSize != 0 && operands[1] == workgroupSize) {
            size = {constants[operands[2]], constants[operands[3]], constants[operands[4]]};
        }
    });
    return size;
}

void setLocalSize(std::vector<uint32_t>& spirv, const std::array<uint32_t, 3>& size)
{
    std::vector<size_t> places;
    forEachInstruction(spirv, [&](spv::Op op, std::span<const uint32_t> operands) {
        if (op != spv::OpExecutionMode || operands.size() < 5 || operands[1] != spv::ExecutionModeLocalSize) return;
        places.push_back(static_cast<size_t>(operands.data() + 2 - spirv.data()));
    });
    for (const size_t place : places)
        std::copy(size.begin(), size.end(), spirv.begin() + static_cast<std::ptrdiff_t>(place));
}

std::vector<uint32_t> forbidContraction(const std::vector<uint32_t>& spirv)
{
    std::vector<uint32_t> ids;
    size_t annotations = 0; // where the first decoration stands, or would stand: before the first type
    forEachInstruction(spirv, [&](spv::Op op, std::span<const uint32_t> operands) {
        const auto place = static_cast<size_t>(operands.data() - spirv.data()) - 1;
        if (annotations == 0 && (op == spv::OpDecorate || op == spv::OpMemberDecorate || op == spv::OpTypeVoid)) {
            annotations = place;
        }
        if (isFloatArithmetic(op) && operands.size() >= 2) ids.push_back(operands[1]);
    });
    if (annotations == 0) return spirv;
    std::vector<uint32_t> result(spirv.begin(), spirv.begin() + static_cast<std::ptrdiff_t>(annotations));
    for (const uint32_t id : ids) {
        result.insert(result.end(), {(3u << spv::WordCountShift) | spv::OpDecorate, id, spv::DecorationNoContraction});
    }
    result.insert(result.end(), spirv.begin() + static_cast<std::ptrdiff_t>(annotations), spirv.end());
    return result;
}

std::vector<uint32_t> allowContraction(const std::vector<uint32_t>& spirv)
{
    std::vector<uint32_t> result(spirv.begin(),
                                 spirv.begin() + static_cast<std::ptrdiff_t>(std::min(kHeaderWords, spirv.size())));
    forEachInstruction(spirv, [&](spv::Op op, std::span<const uint32_t> operands) {
        if (op == spv::OpDecorate && operands.size() == 2 && operands[1] == spv::DecorationNoContraction) return;
        result.insert(result.end(), operands.data() - 1, operands.data() + operands.size());
    });
    return result;
}

std::set<uint32_t> findBindings(const std::vector<uint32_t>& spirv)
{
    std::set<uint32_t> bindings;
    forEachInstruction(spirv, [&](spv::Op op, std::span<const uint32_t> operands) {
        const bool isBinding = op == spv::OpDecorate && operands.size() == 3 && operands[1] == spv::DecorationBinding;
        if (isBinding) bindings.insert(operands[2]);
    });
    return bindings;
}

bool loadsWhatItStores(const std::vector<uint32_t>& spirv)
{
    std::map<uint32_t, uint32_t> variables; // pointer -> the variable that it points into
    std::set<uint32_t> loaded, stored;
    const auto note = [&](std::set<uint32_t>& kind, uint32_t pointer) {
        if (const auto found = variables.find(pointer); found != variables.end()) kind.insert(found->second);
    };
    forEachInstruction(spirv, [&](spv::Op op, std::span<const uint32_t> operands) {
        switch (op) {
        case spv::OpVariable:
        case spv::OpFunctionParameter:
            requireOperands(operands, 2);
            variables[operands[1]] = operands[1];
            break;
        case spv::OpAccessChain:
        case spv::OpInBoundsAccessChain:
        case spv::OpCopyObject:
            requireOperands(operands, 3);
            if (const auto found = variables.find(operands[2]); found != variables.end())
                variables[operands[1]] = found->second;
            break;
        case spv::OpLoad:
            requireOperands(operands, 3);
            note(loaded, operands[2]);
            break;
        case spv::OpStore:
            requireOperands(operands, 2);
            note(stored, operands[0]);
            break;
        default: { // what is handed on may be read and written there
            size_t first = operands.size();
            if (op == spv::OpFunctionCall) first = 3;
            if (op == spv::OpExtInst) first = 4;
            if (op == spv::OpCopyMemory || op == spv::OpCopyMemorySized) first = 0;
            if (op >= spv::OpAtomicLoad && op <= spv::OpAtomicXor) first = op == spv::OpAtomicStore ? 0 : 2;
            for (size_t i = first; i < operands.size(); ++i) {
                note(loaded, operands[i]);
                note(stored, operands[i]);
            }
        }
        }
    });
    return std::any_of(loaded.begin(), loaded.end(), [&](uint32_t variable) { return stored.count(variable) > 0; });
}

size_t countSpirvInstructions(const std::vector<uint32_t>& spirv)
{
    size_t count = 0;
    forEachInstruction(spirv, [&](spv::Op, std::span<const uint32_t>) { ++count; });
    return count;
}

std::vector<uint32_t> encodeConstant(const SpecializationConstant& constant, double value)
{
    const auto refuse = [&](const char* allowed) {
        throw InputError(fmt::format("specialization constant {} = {}: allowed is {}", constant.name, value, allowed));
    };
    const bool whole = std::isfinite(value) && value == std::trunc(value);
    switch (constant.type) {
    case SpecializationType::kBool:
        if (value != 0 && value != 1) refuse("0 or 1");
        return {value != 0 ? 1u : 0u};
    case SpecializationType::kInt:
        if (!whole || std::abs(value) > std::numeric_limits<int32_t>::max()) refuse("a whole number of 32 bits");
        return {std::bit_cast<uint32_t>(static_cast<int32_t>(value))};
    case SpecializationType::kUint:
        if (!whole || value < 0 || value > std::numeric_limits<uint32_t>::max())
            refuse("a whole number from 0 to 2^32-1");
        return {static_cast<uint32_t>(value)};
    case SpecializationType::kFloat:
        return {std::bit_cast<uint32_t>(static_cast<float>(value))};
    case SpecializationType::kDouble: {
        const auto bits = std::bit_cast<uint64_t>(value);
        return {static_cast<uint32_t>(bits), static_cast<uint32_t>(bits >> 32)};
    }
    }
    return {};
}

} // namespace crossray
