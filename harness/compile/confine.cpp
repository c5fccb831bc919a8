#include "harness/compile/confine.h"

#include "harness/base/error.h"
#include "harness/compile/spirv_function.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <optional>
#include <set>

namespace crossray {

namespace {

constexpr const char* kInterfaceFile = "pass/own_interface.glsl";

std::string readText(const SpirvInstruction& instruction, size_t firstOperand)
{
    std::string text;
    for (size_t i = firstOperand; i < instruction.operandCount(); ++i) {
        const uint32_t word = instruction.operand(i);
        char bytes[sizeof(word)];
        std::memcpy(bytes, &word, sizeof(word));
        text.append(bytes, sizeof(word));
    }
    return text.c_str();
}

// What a statement of the person's file is called in a message.
struct Line {
    uint32_t file = 0; // OpString
    uint32_t line = 0;
};

// Pointers that an instruction goes through.
std::vector<uint32_t> pointersOf(const SpirvInstruction& instruction)
{
    switch (instruction.op()) {
    case spv::OpLoad:
    case spv::OpAccessChain:
    case spv::OpInBoundsAccessChain:
    case spv::OpArrayLength:
    case spv::OpImageTexelPointer:
        return {instruction.operand(2)};
    case spv::OpStore:
        return {instruction.operand(0)};
    case spv::OpCopyMemory:
        return {instruction.operand(0), instruction.operand(1)};
    case spv::OpFunctionCall:
        return {instruction.words.begin() + 4, instruction.words.end()};
    default:
        return {};
    }
}

class Confinement {
  public:
    Confinement(SpirvModule module, std::string file) : module_(std::move(module)), file_(std::move(file))
    {
        for (const SpirvInstruction& instruction : module_.globals)
            readGlobal(instruction);
        for (size_t i = 0; i < module_.functions.size(); ++i)
            functionOf_[module_.functions[i].head.at(0).operand(1)] = i;
    }

    std::vector<uint32_t> confine()
    {
        for (const auto& [id, index] : functionOf_) {
            const std::string name = textOf(names_, id);
            if (name.starts_with("traceOwn(")) visit(index, {});
            if ((name == "main" || name.starts_with("main("))) checkInitialisers(index);
        }
        for (const size_t index : own_)
            gateLoops(module_.functions[index]);
        return writeSpirvModule(module_);
    }

  private:
    static std::string textOf(const std::map<uint32_t, std::string>& texts, uint32_t id)
    {
        const auto found = texts.find(id);
        return found == texts.end() ? std::string() : found->second;
    }

    void readGlobal(const SpirvInstruction& instruction)
    {
        const spv::Op op = instruction.op();
        if (op == spv::OpName) names_[instruction.operand(0)] = readText(instruction, 1);
        if (op == spv::OpString) strings_[instruction.operand(0)] = readText(instruction, 1);
        if (op == spv::OpTypeBool) boolType_ = instruction.operand(0);
        if (op == spv::OpTypeInt && instruction.operand(1) == 32 && instruction.operand(2) == 1)
            intType_ = instruction.operand(0);
        if (op == spv::OpTypeVoid) voidType_ = instruction.operand(0);
        if (op == spv::OpTypePointer) pointees_[instruction.operand(0)] = instruction.operand(2);
        if (op != spv::OpVariable) return;
        const uint32_t id = instruction.operand(1);
        const auto storage = static_cast<spv::StorageClass>(instruction.operand(2));
        std::string& name = names_[id];
        if (name.empty()) name = textOf(names_, pointees_[instruction.operand(0)]); // a block without one: its type's
        if (name == "ownRounds") rounds_ = id;
        if (name == "ownEndlessLine") endlessLine_ = id;
        const bool isCounter =
            name == "ownRounds" || name == "ownEndlessLine" || name == "ownCoarsestLevel" || name == "fetchCount";
        if (isCounter || (storage != spv::StorageClassPrivate && storage != spv::StorageClassInput)) kept_.insert(id);
    }

    bool isOwn(const Line& line) const { return textOf(strings_, line.file) == kOwnTracerInclude; }

    // Lines hold from their instruction to the next one, or to the block's end.
    static void follow(const SpirvInstruction& instruction, Line& line)
    {
        if (instruction.op() == spv::OpLine) line = {instruction.operand(0), instruction.operand(1)};
        if (instruction.op() == spv::OpNoLine) line = {};
    }

    bool isOfInterface(const SpirvFunction& function) const
    {
        for (const SpirvBlock& block : function.blocks) {
            for (const SpirvInstruction& instruction : block.body) {
                if (instruction.op() == spv::OpLine) return textOf(strings_, instruction.operand(0)) == kInterfaceFile;
            }
        }
        return false;
    }

    // Of one function that the tracer reaches; `caller` is the last line of the person's file on the way to it.
    void visit(size_t index, const Line& caller)
    {
        const SpirvFunction& function = module_.functions[index];
        if (isOfInterface(function) || !own_.insert(index).second) return;
        for (const SpirvBlock& block : function.blocks) {
            Line line;
            for (const SpirvInstruction& instruction : block.body) {
                follow(instruction, line);
                check(instruction, isOwn(line) ? line : caller);
            }
        }
    }

    // Global variables of the person's file get their first values in main().
    void checkInitialisers(size_t index)
    {
        for (const SpirvBlock& block : module_.functions[index].blocks) {
            Line line;
            for (const SpirvInstruction& instruction : block.body) {
                follow(instruction, line);
                if (isOwn(line)) check(instruction, line);
            }
        }
    }

    void check(const SpirvInstruction& instruction, const Line& line)
    {
        for (const uint32_t pointer : pointersOf(instruction)) {
            if (!kept_.contains(pointer)) continue;
            const std::string name = textOf(names_, pointer);
            throw ShaderError(fmt::format("{}: error: reaches '{}' past the interface; a tracer reads by the functions "
                                          "own...() of {} alone",
                                          SourcePosition{file_, static_cast<int>(line.line)}.format(),
                                          name.empty() ? "a resource" : name, kInterfaceFile));
        }
        if (instruction.op() == spv::OpFunctionCall) visit(functionOf_.at(instruction.operand(2)), line);
    }

    uint32_t constant(uint32_t value)
    {
        uint32_t& id = constants_[value];
        if (id == 0) {
            id = module_.makeId();
            module_.globals.push_back(makeInstruction(spv::OpConstant, {intType_, id, value}));
        }
        return id;
    }

    // A block after an endless loop was said never to be reached. Now it can be.
    void returnWhereUnreachable(SpirvFunction& function)
    {
        const uint32_t type = function.head.at(0).operand(0);
        for (SpirvBlock& block : function.blocks) {
            if (block.body.empty() || block.body.back().op() != spv::OpUnreachable) continue;
            if (type == voidType_) {
                block.body.back() = makeInstruction(spv::OpReturn, {});
                continue;
            }
            const uint32_t null = module_.makeId();
            module_.globals.push_back(makeInstruction(spv::OpConstantNull, {type, null}));
            block.body.back() = makeInstruction(spv::OpReturnValue, {null});
        }
    }

    struct Loop {
        uint32_t header = 0, merge = 0, line = 0;
    };

    // A loop's line stands in its header: that of its head, for do-while that of its condition.
    static std::vector<Loop> findLoops(const SpirvFunction& function)
    {
        std::vector<Loop> loops;
        for (const SpirvBlock& block : function.blocks) {
            Line line;
            for (const SpirvInstruction& instruction : block.body) {
                follow(instruction, line);
                if (instruction.op() == spv::OpLoopMerge)
                    loops.push_back({block.label, instruction.operand(0), line.line});
            }
        }
        return loops;
    }

    // The branch into the loop's body: that of its condition, which leaves for the merge block; without one before the
    // body, that of its header.
    static SpirvBlock* findGate(SpirvFunction& function, const Loop& loop)
    {
        SpirvBlock* header = nullptr;
        for (SpirvBlock& block : function.blocks) {
            if (block.label == loop.header) header = &block;
            const SpirvInstruction& end = block.body.back();
            if (end.op() != spv::OpBranchConditional) continue;
            const bool leaves = end.operand(1) == loop.merge || end.operand(2) == loop.merge;
            const bool goesBack = end.operand(1) == loop.header || end.operand(2) == loop.header;
            if (leaves && !goesBack) return &block;
        }
        return header;
    }

    void gateLoops(SpirvFunction& function)
    {
        returnWhereUnreachable(function);
        for (const Loop& loop : findLoops(function))
            gateLoop(*findGate(function, loop), loop);
    }

    void gateLoop(SpirvBlock& block, const Loop& loop)
    {
        SpirvInstruction end = block.body.back();
        block.body.pop_back();
        std::optional<SpirvInstruction> merge;
        if (!block.body.empty() && block.body.back().op() == spv::OpLoopMerge) {
            merge = block.body.back();
            block.body.pop_back();
        }
        const auto emit = [&](spv::Op op, uint32_t type, const std::vector<uint32_t>& operands) {
            const uint32_t id = module_.makeId();
            std::vector<uint32_t> words{type, id};
            words.insert(words.end(), operands.begin(), operands.end());
            block.body.push_back(makeInstruction(op, words));
            return id;
        };
        const bool isConditional = end.op() == spv::OpBranchConditional;
        uint32_t body = end.operand(isConditional ? 1 : 0);
        std::optional<uint32_t> wants;
        if (isConditional) {
            wants = end.operand(0);
            if (body == loop.merge) { // "until"
                wants = emit(spv::OpLogicalNot, boolType_, {*wants});
                body = end.operand(2);
            }
        }
        const uint32_t rounds = emit(spv::OpLoad, intType_, {rounds_});
        const uint32_t isLeft = emit(spv::OpSLessThan, boolType_, {rounds, constant(kMostOwnRounds)});
        const uint32_t isOver = emit(spv::OpLogicalNot, boolType_, {isLeft});
        const uint32_t goes = wants ? emit(spv::OpLogicalAnd, boolType_, {*wants, isLeft}) : isLeft;
        const uint32_t isCut = wants ? emit(spv::OpLogicalAnd, boolType_, {*wants, isOver}) : isOver;
        const uint32_t more = emit(spv::OpIAdd, intType_, {rounds, constant(1)});
        const uint32_t counted = emit(spv::OpSelect, intType_, {goes, more, rounds});
        block.body.push_back(makeInstruction(spv::OpStore, {rounds_, counted}));
        const uint32_t known = emit(spv::OpLoad, intType_, {endlessLine_});
        const uint32_t isFirst = emit(spv::OpIEqual, boolType_, {known, constant(0)});
        const uint32_t isNews = emit(spv::OpLogicalAnd, boolType_, {isCut, isFirst});
        const uint32_t line = emit(spv::OpSelect, intType_, {isNews, constant(std::max(loop.line, 1u)), known});
        block.body.push_back(makeInstruction(spv::OpStore, {endlessLine_, line}));
        if (merge) block.body.push_back(*merge);
        block.body.push_back(makeInstruction(spv::OpBranchConditional, {goes, body, loop.merge}));
    }

    SpirvModule module_;
    std::string file_;
    std::map<uint32_t, std::string> names_, strings_;
    std::map<uint32_t, uint32_t> pointees_; // types by those of their pointers
    std::map<uint32_t, size_t> functionOf_; // by id
    std::set<uint32_t> kept_;               // variables that only the interface may go through
    std::set<size_t> own_;                  // functions that the tracer reaches
    std::map<uint32_t, uint32_t> constants_;
    uint32_t boolType_ = 0, intType_ = 0, voidType_ = 0, rounds_ = 0, endlessLine_ = 0;
};

} // namespace

std::vector<uint32_t> confineOwnTracer(const std::vector<uint32_t>& spirv, const std::string& file)
{
    return Confinement(readSpirvModule(spirv), file).confine();
}

} // namespace crossray
