#include "harness/backend/vulkan/spirv_interface.h"

#include "harness/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

namespace crossray::vulkan {
namespace {

// Numbers of the SPIR-V specification (unified1), under its own names.
constexpr uint32_t kMagicNumber = 0x07230203;
constexpr size_t kHeaderWords = 5;
enum Op : uint32_t {
    kOpName = 5,
    kOpEntryPoint = 15,
    kOpExecutionMode = 16,
    kOpTypeBool = 20,
    kOpTypeInt = 21,
    kOpTypeFloat = 22,
    kOpTypeVector = 23,
    kOpTypeMatrix = 24,
    kOpTypeImage = 25,
    kOpTypeSampledImage = 27,
    kOpTypeArray = 28,
    kOpTypeRuntimeArray = 29,
    kOpTypeStruct = 30,
    kOpTypePointer = 32,
    kOpConstant = 43,
    kOpConstantComposite = 44,
    kOpSpecConstant = 50,
    kOpSpecConstantComposite = 51,
    kOpFunctionCall = 57,
    kOpVariable = 59,
    kOpLoad = 61,
    kOpStore = 62,
    kOpCopyMemory = 63,
    kOpCopyMemorySized = 64,
    kOpAccessChain = 65,
    kOpInBoundsAccessChain = 66,
    kOpPtrAccessChain = 67,
    kOpArrayLength = 68,
    kOpInBoundsPtrAccessChain = 70,
    kOpDecorate = 71,
    kOpMemberDecorate = 72,
    kOpCopyObject = 83,
};
enum Decoration : uint32_t {
    kBufferBlock = 3,
    kRowMajor = 4,
    kArrayStride = 6,
    kMatrixStride = 7,
    kBuiltIn = 11,
    kBinding = 33,
    kDescriptorSet = 34,
    kOffset = 35,
};
enum StorageClass : uint32_t {
    kUniformConstant = 0,
    kUniform = 2,
    kWorkgroup = 4,
    kPushConstant = 9,
    kStorageBuffer = 12
};
constexpr uint32_t kExecutionModelGlCompute = 5;
constexpr uint32_t kExecutionModeLocalSize = 17;
constexpr uint32_t kBuiltInWorkgroupSize = 25;
constexpr uint32_t kDim2D = 1;
constexpr uint32_t kSampledWithSampler = 1;

[[noreturn]] void refuse(const std::string& text)
{
    throw ShaderError("SPIR-V: " + text);
}

struct Instruction {
    uint32_t op = 0;
    std::span<const uint32_t> words; // the first one holds op and length

    uint32_t at(size_t index) const
    {
        if (index >= words.size()) refuse(fmt::format("instruction {} is too short", op));
        return words[index];
    }
    std::string text(size_t index) const // a literal string
    {
        std::string result;
        for (size_t i = index; i < words.size(); ++i)
            for (int shift = 0; shift < 32; shift += 8) {
                const char letter = static_cast<char>((words[i] >> shift) & 0xffu);
                if (letter == '\0') return result;
                result += letter;
            }
        return result;
    }
};

class Module {
  public:
    explicit Module(std::span<const uint32_t> words);
    SpirvInterface describe() const;

  private:
    struct Variable {
        uint32_t id, pointerType, storageClass;
    };

    void read(const Instruction& instruction);
    void readUses(const Instruction& instruction);
    const Instruction& definition(uint32_t id) const;
    uint32_t constantValue(uint32_t id) const;
    uint64_t sizeOf(uint32_t type, int depth = 0) const;
    uint64_t laidOutSize(uint32_t type, int depth = 0) const;
    uint64_t laidOutMemberSize(uint32_t structType, uint32_t member, int depth) const;
    std::optional<uint32_t> decoration(uint32_t id, Decoration which) const;
    std::string nameOfId(uint32_t id) const;
    std::string nameOfVariable(const Variable& variable) const;
    DescriptorKind kindOf(const Variable& variable) const;
    void checkImage(const Variable& variable, uint32_t sampledImageType) const;
    std::array<uint32_t, 3> localSize() const;

    std::map<uint32_t, Instruction> definitions_; // types and constants by result id
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> decorations_;
    std::map<std::array<uint32_t, 3>, uint32_t> memberDecorations_; // by struct, member and decoration
    std::map<uint32_t, std::string> names_;
    std::vector<Variable> variables_;
    std::set<uint32_t> used_; // ids that stand where a function's code takes a pointer
    std::optional<uint32_t> entryPoint_, workgroupSizeConstant_;
    std::array<uint32_t, 3> localSizeMode_{1, 1, 1};
};

Module::Module(std::span<const uint32_t> words)
{
    if (words.size() < kHeaderWords || words[0] != kMagicNumber) refuse("the code does not start with a SPIR-V header");
    for (size_t position = kHeaderWords; position < words.size();) {
        const size_t length = words[position] >> 16;
        if (length == 0 || length > words.size() - position)
            refuse(fmt::format("the code is cut off at word {} of {}", position, words.size()));
        read({words[position] & 0xffffu, words.subspan(position, length)});
        position += length;
    }
    if (!entryPoint_) refuse("there is no compute entry point \"main\"");
}

void Module::read(const Instruction& instruction)
{
    switch (instruction.op) {
    case kOpName:
        names_[instruction.at(1)] = instruction.text(2);
        break;
    case kOpEntryPoint:
        if (instruction.at(1) == kExecutionModelGlCompute && instruction.text(3) == "main")
            entryPoint_ = instruction.at(2);
        break;
    case kOpExecutionMode:
        if (instruction.at(2) == kExecutionModeLocalSize && instruction.at(1) == entryPoint_)
            localSizeMode_ = {instruction.at(3), instruction.at(4), instruction.at(5)};
        break;
    case kOpDecorate:
        decorations_[{instruction.at(1), instruction.at(2)}] = instruction.words.size() > 3 ? instruction.at(3) : 0;
        if (instruction.at(2) == kBuiltIn && instruction.at(3) == kBuiltInWorkgroupSize)
            workgroupSizeConstant_ = instruction.at(1);
        break;
    case kOpMemberDecorate:
        memberDecorations_[{instruction.at(1), instruction.at(2), instruction.at(3)}] =
            instruction.words.size() > 4 ? instruction.at(4) : 0;
        break;
    case kOpConstant:
    case kOpConstantComposite:
    case kOpSpecConstant:
    case kOpSpecConstantComposite:
        definitions_[instruction.at(2)] = instruction;
        break;
    case kOpVariable:
        variables_.push_back({instruction.at(2), instruction.at(1), instruction.at(3)});
        break;
    default:
        if (instruction.op >= kOpTypeBool && instruction.op <= kOpTypePointer)
            definitions_[instruction.at(1)] = instruction;
        else
            readUses(instruction);
    }
}

void Module::readUses(const Instruction& instruction)
{
    switch (instruction.op) {
    case kOpLoad:
    case kOpAccessChain:
    case kOpInBoundsAccessChain:
    case kOpPtrAccessChain:
    case kOpInBoundsPtrAccessChain:
    case kOpArrayLength:
    case kOpCopyObject:
        used_.insert(instruction.at(3));
        break;
    case kOpStore:
        used_.insert(instruction.at(1));
        break;
    case kOpCopyMemory:
    case kOpCopyMemorySized:
        used_.insert(instruction.at(1));
        used_.insert(instruction.at(2));
        break;
    case kOpFunctionCall:
        for (size_t i = 4; i < instruction.words.size(); ++i)
            used_.insert(instruction.words[i]);
        break;
    default:
        break;
    }
}

const Instruction& Module::definition(uint32_t id) const
{
    const auto found = definitions_.find(id);
    if (found == definitions_.end()) refuse(fmt::format("id {} is used but not defined", id));
    return found->second;
}

uint32_t Module::constantValue(uint32_t id) const
{
    const Instruction& constant = definition(id);
    if (constant.op != kOpConstant && constant.op != kOpSpecConstant) refuse(fmt::format("id {} is no constant", id));
    return constant.at(3);
}

uint64_t Module::sizeOf(uint32_t type, int depth) const
{
    if (depth > 32) refuse("types are nested too deeply");
    const Instruction& definition = this->definition(type);
    switch (definition.op) {
    case kOpTypeBool:
        return 4;
    case kOpTypeInt:
    case kOpTypeFloat:
        return definition.at(2) / 8;
    case kOpTypeVector:
    case kOpTypeMatrix:
        return definition.at(3) * sizeOf(definition.at(2), depth + 1);
    case kOpTypeArray:
        return constantValue(definition.at(3)) * sizeOf(definition.at(2), depth + 1);
    case kOpTypeStruct: {
        uint64_t sum = 0;
        for (size_t i = 2; i < definition.words.size(); ++i)
            sum += sizeOf(definition.words[i], depth + 1);
        return sum;
    }
    default:
        refuse(fmt::format("type {} has no size", type));
    }
}

// Size of a type inside a block, by the offsets and strides that the code carries; a struct ends with its last member.
uint64_t Module::laidOutSize(uint32_t type, int depth) const
{
    if (depth > 32) refuse("types are nested too deeply");
    const Instruction& definition = this->definition(type);
    if (definition.op == kOpTypeArray) {
        const std::optional<uint32_t> stride = decoration(type, kArrayStride);
        if (!stride) refuse(fmt::format("array type {} in a block has no stride", type));
        return uint64_t{constantValue(definition.at(3))} * *stride;
    }
    if (definition.op != kOpTypeStruct) return sizeOf(type, depth);
    uint64_t end = 0;
    for (uint32_t member = 0; member + 2 < definition.words.size(); ++member) {
        const auto offset = memberDecorations_.find({type, member, kOffset});
        if (offset == memberDecorations_.end())
            refuse(fmt::format("member {} of block {} has no offset", member, type));
        end = std::max(end, offset->second + laidOutMemberSize(type, member, depth + 1));
    }
    return end;
}

// A matrix takes its stride from the member that it is, or is an array of.
uint64_t Module::laidOutMemberSize(uint32_t structType, uint32_t member, int depth) const
{
    const uint32_t type = definition(structType).at(member + 2);
    const Instruction& definition = this->definition(type);
    if (definition.op != kOpTypeMatrix) return laidOutSize(type, depth);
    const auto stride = memberDecorations_.find({structType, member, kMatrixStride});
    if (stride == memberDecorations_.end()) refuse(fmt::format("a matrix in block {} has no stride", structType));
    const bool rowMajor = memberDecorations_.contains({structType, member, kRowMajor});
    const uint32_t rows = this->definition(definition.at(2)).at(3);
    return uint64_t{rowMajor ? rows : definition.at(3)} * stride->second;
}

std::optional<uint32_t> Module::decoration(uint32_t id, Decoration which) const
{
    const auto found = decorations_.find({id, which});
    return found == decorations_.end() ? std::nullopt : std::optional(found->second);
}

std::string Module::nameOfId(uint32_t id) const
{
    const auto found = names_.find(id);
    return found == names_.end() ? std::string() : found->second;
}

// A block without an instance name leaves the variable's name empty; then the block's name says more.
std::string Module::nameOfVariable(const Variable& variable) const
{
    const std::string name = nameOfId(variable.id);
    return name.empty() ? nameOfId(definition(variable.pointerType).at(3)) : name;
}

void Module::checkImage(const Variable& variable, uint32_t sampledImageType) const
{
    const Instruction& image = definition(definition(sampledImageType).at(2));
    const bool plain = image.op == kOpTypeImage && image.at(3) == kDim2D && image.at(5) == 0 && image.at(6) == 0 &&
                       image.at(7) == kSampledWithSampler;
    if (!plain) refuse(fmt::format("\"{}\" is an image other than sampler2D", nameOfVariable(variable)));
}

DescriptorKind Module::kindOf(const Variable& variable) const
{
    const uint32_t pointee = definition(variable.pointerType).at(3);
    const Instruction& type = definition(pointee);
    if (type.op == kOpTypeArray || type.op == kOpTypeRuntimeArray)
        refuse(fmt::format("\"{}\" is an array of descriptors; a binding holds one", nameOfVariable(variable)));
    if (variable.storageClass == kStorageBuffer) return DescriptorKind::kStorageBuffer;
    if (variable.storageClass == kUniform)
        return decoration(pointee, kBufferBlock) ? DescriptorKind::kStorageBuffer : DescriptorKind::kUniformBuffer;
    if (type.op != kOpTypeSampledImage)
        refuse(fmt::format("\"{}\" is neither a sampler2D nor a buffer", nameOfVariable(variable)));
    checkImage(variable, pointee);
    return DescriptorKind::kSampledImage;
}

// A constant decorated WorkgroupSize wins over the execution mode, as the specification says.
std::array<uint32_t, 3> Module::localSize() const
{
    if (!workgroupSizeConstant_) return localSizeMode_;
    const Instruction& composite = definition(*workgroupSizeConstant_);
    return {constantValue(composite.at(3)), constantValue(composite.at(4)), constantValue(composite.at(5))};
}

SpirvInterface Module::describe() const
{
    SpirvInterface result;
    result.localSize = localSize();
    std::map<uint32_t, SpirvBinding> bindings;
    for (const Variable& variable : variables_) {
        if (variable.storageClass == kWorkgroup) result.sharedBytes += sizeOf(definition(variable.pointerType).at(3));
        if (!used_.contains(variable.id)) continue;
        if (variable.storageClass == kPushConstant)
            refuse(fmt::format("\"{}\" is a push constant; use a uniform block", nameOfVariable(variable)));
        if (variable.storageClass != kUniformConstant && variable.storageClass != kUniform &&
            variable.storageClass != kStorageBuffer)
            continue;
        const std::string name = nameOfVariable(variable);
        const std::optional<uint32_t> binding = decoration(variable.id, kBinding);
        if (!binding) refuse(fmt::format("\"{}\" has no layout(binding = N)", name));
        if (const uint32_t set = decoration(variable.id, kDescriptorSet).value_or(0); set != 0)
            refuse(fmt::format("\"{}\" is in descriptor set {}; only set 0 is used", name, set));
        SpirvBinding described{*binding, kindOf(variable), name};
        if (described.kind == DescriptorKind::kUniformBuffer)
            described.bytes = laidOutSize(definition(variable.pointerType).at(3));
        const auto [existing, inserted] = bindings.emplace(*binding, described);
        if (!inserted)
            refuse(fmt::format("\"{}\" and \"{}\" are both at binding {}", existing->second.name, name, *binding));
    }
    for (const auto& [number, binding] : bindings)
        result.bindings.push_back(binding);
    return result;
}

} // namespace

std::string_view nameOf(DescriptorKind kind)
{
    switch (kind) {
    case DescriptorKind::kSampledImage:
        return "a sampled image";
    case DescriptorKind::kUniformBuffer:
        return "a uniform buffer";
    case DescriptorKind::kStorageBuffer:
        return "a storage buffer";
    }
    return "";
}

SpirvInterface readSpirvInterface(std::span<const uint32_t> words)
{
    return Module(words).describe();
}

} // namespace crossray::vulkan
