#include "harness/compile/flatten.h"

#include "harness/base/error.h"
#include "harness/compile/spirv_function.h"
#include "harness/compile/spirv_module.h"

#include <spirv_cross/GLSL.std.450.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

namespace crossray {

namespace {

constexpr size_t kMaxHoisted = 48;  // instructions of both sides together
constexpr size_t kMaxBlocks = 5000; // of a function: the work grows with the square, and such code is no person's

bool isPureArithmetic(spv::Op op)
{
    // Whole-number division is missing: on a CPU, division by zero ends the process.
    const auto within = [op](spv::Op first, spv::Op last) { return op >= first && op <= last; };
    return within(spv::OpConvertFToU, spv::OpConvertUToF) || op == spv::OpBitcast || op == spv::OpVectorShuffle ||
           within(spv::OpCompositeConstruct, spv::OpTranspose) || within(spv::OpSNegate, spv::OpFMul) ||
           op == spv::OpFDiv || op == spv::OpFRem || op == spv::OpFMod ||
           within(spv::OpVectorTimesScalar, spv::OpDot) || within(spv::OpAny, spv::OpIsInf) ||
           within(spv::OpLogicalEqual, spv::OpFUnordGreaterThanEqual) ||
           within(spv::OpShiftRightLogical, spv::OpBitCount);
}

bool isPureExtended(uint32_t function)
{
    switch (function) {
    case GLSLstd450Modf:
    case GLSLstd450Frexp:
    case GLSLstd450InterpolateAtCentroid:
    case GLSLstd450InterpolateAtSample:
    case GLSLstd450InterpolateAtOffset:
        return false;
    default:
        return true;
    }
}

bool isLine(spv::Op op)
{
    return op == spv::OpLine || op == spv::OpNoLine;
}

// What is declared before the functions and what flattening needs to know of it.
class Globals {
  public:
    explicit Globals(SpirvModule& module);
    // A pointer to something that may be read at any time: a sampler, a member of a uniform block at constant indices.
    bool isSafePointer(uint32_t id) const { return safePointers_.count(id) > 0; }
    // Notes an access chain that leads to such a thing.
    void noteAccessChain(const SpirvInstruction& chain);
    bool isStandardSet(uint32_t id) const { return standardSets_.count(id) > 0; }
    // 1 for a scalar, 2 to 4 for a vector, 0 for a type that a select does not take.
    uint32_t selectWidth(uint32_t type) const;
    // The type of a vector of so many truth values, made where there is none yet.
    uint32_t boolVector(uint32_t width);

  private:
    SpirvModule& module_;
    uint32_t boolType_ = 0;
    std::map<uint32_t, uint32_t> widths_;
    std::map<uint32_t, uint32_t> boolVectors_; // by width
    std::set<uint32_t> constants_, standardSets_, safePointers_;
};

Globals::Globals(SpirvModule& module) : module_(module)
{
    for (const SpirvInstruction& each : module.globals) {
        switch (each.op()) {
        case spv::OpExtInstImport:
            standardSets_.insert(each.operand(0));
            break;
        case spv::OpTypeBool:
            boolType_ = each.operand(0);
            widths_[boolType_] = 1;
            break;
        case spv::OpTypeInt:
        case spv::OpTypeFloat:
            widths_[each.operand(0)] = 1;
            break;
        case spv::OpTypeVector:
            widths_[each.operand(0)] = each.operand(2);
            if (each.operand(1) == boolType_) boolVectors_[each.operand(2)] = each.operand(0);
            break;
        case spv::OpConstant:
            constants_.insert(each.operand(1));
            break;
        case spv::OpVariable:
            if (each.operand(2) == spv::StorageClassUniformConstant) safePointers_.insert(each.operand(1));
            if (each.operand(2) == spv::StorageClassUniform) safePointers_.insert(each.operand(1));
            break;
        default:
            break;
        }
    }
}

void Globals::noteAccessChain(const SpirvInstruction& chain)
{
    if (!isSafePointer(chain.operand(2))) return;
    for (size_t i = 3; i < chain.operandCount(); ++i) {
        if (constants_.count(chain.operand(i)) == 0) return;
    }
    safePointers_.insert(chain.operand(1));
}

uint32_t Globals::selectWidth(uint32_t type) const
{
    const auto found = widths_.find(type);
    return found == widths_.end() ? 0 : found->second;
}

uint32_t Globals::boolVector(uint32_t width)
{
    uint32_t& type = boolVectors_[width];
    if (type == 0) {
        type = module_.makeId();
        module_.globals.push_back(makeInstruction(spv::OpTypeVector, {type, boolType_, width}));
    }
    return type;
}

// The flattening of one function.
class Flattener {
  public:
    Flattener(SpirvModule& module, Globals& globals, SpirvFunction& function)
        : module_(module), globals_(globals), blocks_(function.blocks)
    {
        for (const SpirvBlock& block : blocks_) {
            for (const SpirvInstruction& each : block.body) {
                if (each.op() == spv::OpAccessChain || each.op() == spv::OpInBoundsAccessChain)
                    globals_.noteAccessChain(each);
            }
        }
    }
    void run()
    {
        // Innermost branches stand last; what becomes straight may make the branch around it flat as well.
        for (size_t i = blocks_.size(); i-- > 0;) {
            while (i < blocks_.size() && flattenAt(i)) {
            }
        }
    }

  private:
    struct Branch {
        uint32_t condition = 0, merge = 0;
        const SpirvBlock* whenTrue = nullptr; // null: straight to the merge block
        const SpirvBlock* whenFalse = nullptr;
    };
    void index();
    std::optional<Branch> findBranch(const SpirvBlock& block) const;
    std::optional<const SpirvBlock*> findSide(uint32_t label, uint32_t merge, uint32_t header) const;
    bool isHoistable(const SpirvInstruction& each) const;
    bool canSelect(const SpirvBlock& merge) const;
    bool flattenAt(size_t place);
    std::vector<SpirvInstruction> selectsFor(const SpirvBlock& merge, const Branch& branch, uint32_t header);

    SpirvModule& module_;
    Globals& globals_;
    std::vector<SpirvBlock>& blocks_;
    std::map<uint32_t, size_t> places_;                // of the blocks by label
    std::map<uint32_t, std::vector<uint32_t>> before_; // labels of the blocks that branch to a label
    std::map<uint32_t, int> constructs_;               // how many merge instructions name a label
};

void Flattener::index()
{
    places_.clear();
    before_.clear();
    constructs_.clear();
    for (size_t i = 0; i < blocks_.size(); ++i) {
        const SpirvBlock& block = blocks_[i];
        places_[block.label] = i;
        for (const SpirvInstruction& each : block.body) {
            switch (each.op()) {
            case spv::OpBranch:
                before_[each.operand(0)].push_back(block.label);
                break;
            case spv::OpBranchConditional:
                before_[each.operand(1)].push_back(block.label);
                before_[each.operand(2)].push_back(block.label);
                break;
            case spv::OpSwitch: // with selectors of 32 bits
                before_[each.operand(1)].push_back(block.label);
                for (size_t k = 3; k < each.operandCount(); k += 2)
                    before_[each.operand(k)].push_back(block.label);
                break;
            case spv::OpSelectionMerge:
                ++constructs_[each.operand(0)];
                break;
            case spv::OpLoopMerge:
                ++constructs_[each.operand(0)];
                ++constructs_[each.operand(1)];
                break;
            default:
                break;
            }
        }
    }
}

bool Flattener::isHoistable(const SpirvInstruction& each) const
{
    const spv::Op op = each.op();
    if (isLine(op) || isPureArithmetic(op)) return true;
    if (op == spv::OpExtInst) return globals_.isStandardSet(each.operand(2)) && isPureExtended(each.operand(3));
    if (op == spv::OpAccessChain || op == spv::OpInBoundsAccessChain) return globals_.isSafePointer(each.operand(1));
    return op == spv::OpLoad && each.operandCount() == 3 && globals_.isSafePointer(each.operand(2));
}

// A block that only computes between `header` and `merge`; null where the branch leads to `merge` itself.
std::optional<const SpirvBlock*> Flattener::findSide(uint32_t label, uint32_t merge, uint32_t header) const
{
    if (label == merge) return nullptr;
    const SpirvBlock& side = blocks_[places_.at(label)];
    if (before_.at(label) != std::vector<uint32_t>{header} || constructs_.count(label) > 0) return std::nullopt;
    const SpirvInstruction& end = side.body.back();
    if (end.op() != spv::OpBranch || end.operand(0) != merge) return std::nullopt;
    const bool pure =
        std::all_of(side.body.begin(), side.body.end() - 1, [this](const auto& each) { return isHoistable(each); });
    return pure ? std::optional(&side) : std::nullopt;
}

bool Flattener::canSelect(const SpirvBlock& merge) const
{
    for (const SpirvInstruction& each : merge.body) {
        if (isLine(each.op())) continue;
        if (each.op() != spv::OpPhi) break;
        if (globals_.selectWidth(each.operand(0)) == 0) return false;
    }
    return true;
}

std::optional<Flattener::Branch> Flattener::findBranch(const SpirvBlock& block) const
{
    if (block.body.size() < 2) return std::nullopt;
    const SpirvInstruction& end = block.body.back();
    const SpirvInstruction& announced = block.body[block.body.size() - 2];
    if (end.op() != spv::OpBranchConditional || announced.op() != spv::OpSelectionMerge) return std::nullopt;
    Branch branch{end.operand(0), announced.operand(0), nullptr, nullptr};
    if (end.operand(1) == end.operand(2) || constructs_.at(branch.merge) != 1) return std::nullopt;
    const auto whenTrue = findSide(end.operand(1), branch.merge, block.label);
    const auto whenFalse = findSide(end.operand(2), branch.merge, block.label);
    if (!whenTrue || !whenFalse) return std::nullopt;
    branch.whenTrue = *whenTrue;
    branch.whenFalse = *whenFalse;
    if (before_.at(branch.merge).size() != 2 || !canSelect(blocks_[places_.at(branch.merge)])) return std::nullopt;
    const size_t cost =
        (branch.whenTrue ? branch.whenTrue->body.size() : 0) + (branch.whenFalse ? branch.whenFalse->body.size() : 0);
    return cost <= kMaxHoisted ? std::optional(branch) : std::nullopt;
}

std::vector<SpirvInstruction> Flattener::selectsFor(const SpirvBlock& merge, const Branch& branch, uint32_t header)
{
    std::vector<SpirvInstruction> selects;
    std::map<uint32_t, uint32_t> conditions{{1, branch.condition}}; // by width
    const uint32_t fromTrue = branch.whenTrue != nullptr ? branch.whenTrue->label : header;
    for (const SpirvInstruction& phi : merge.body) {
        if (phi.op() != spv::OpPhi) continue;
        const uint32_t width = globals_.selectWidth(phi.operand(0));
        uint32_t& condition = conditions[width];
        if (condition == 0) { // a select of vectors takes a condition a component
            condition = module_.makeId();
            std::vector<uint32_t> operands{globals_.boolVector(width), condition};
            operands.insert(operands.end(), width, branch.condition);
            selects.push_back(makeInstruction(spv::OpCompositeConstruct, operands));
        }
        const bool firstIsTrue = phi.operand(3) == fromTrue;
        const uint32_t whenTrue = phi.operand(firstIsTrue ? 2 : 4), whenFalse = phi.operand(firstIsTrue ? 4 : 2);
        selects.push_back(
            makeInstruction(spv::OpSelect, {phi.operand(0), phi.operand(1), condition, whenTrue, whenFalse}));
    }
    return selects;
}

// Flattens the branch at the end of the block, if it is one, and takes the merge block in.
bool Flattener::flattenAt(size_t place)
{
    index();
    const std::optional<Branch> branch = findBranch(blocks_[place]);
    if (!branch) return false;
    SpirvBlock& header = blocks_[place];
    const SpirvBlock& merge = blocks_[places_.at(branch->merge)];
    std::vector<SpirvInstruction> body(header.body.begin(), header.body.end() - 2);
    for (const SpirvBlock* side : {branch->whenTrue, branch->whenFalse}) {
        if (side != nullptr) body.insert(body.end(), side->body.begin(), side->body.end() - 1);
    }
    const std::vector<SpirvInstruction> selects = selectsFor(merge, *branch, header.label);
    body.insert(body.end(), selects.begin(), selects.end());
    for (const SpirvInstruction& each : merge.body) {
        if (each.op() != spv::OpPhi) body.push_back(each);
    }
    const std::set<uint32_t> gone{branch->merge, branch->whenTrue ? branch->whenTrue->label : 0,
                                  branch->whenFalse ? branch->whenFalse->label : 0};
    header.body = std::move(body);
    const uint32_t kept = header.label;
    std::erase_if(blocks_, [&gone](const SpirvBlock& block) { return gone.count(block.label) > 0; });
    for (SpirvBlock& block : blocks_) { // what came from the merge block comes from the header now
        for (SpirvInstruction& each : block.body) {
            if (each.op() != spv::OpPhi) continue;
            for (size_t i = 4; i < each.words.size(); i += 2) {
                if (each.words[i] == branch->merge) each.words[i] = kept;
            }
        }
    }
    return true;
}

} // namespace

std::vector<uint32_t> flattenBranches(const std::vector<uint32_t>& spirv)
{
    SpirvModule module = readSpirvModule(spirv);
    Globals globals(module);
    for (SpirvFunction& function : module.functions) {
        if (function.blocks.size() <= kMaxBlocks) Flattener(module, globals, function).run();
    }
    return writeSpirvModule(module);
}

size_t countBranches(const std::vector<uint32_t>& spirv)
{
    size_t count = 0;
    forEachSpirvInstruction(spirv, [&count](uint32_t op, std::span<const uint32_t>) {
        if (op == spv::OpBranchConditional || op == spv::OpSwitch) ++count;
    });
    return count;
}

} // namespace crossray
