#include "harness/mutate/library.h"

#include "harness/base/error.h"
#include "harness/compile/confine.h"
#include "harness/compile/frontend.h"
#include "harness/base/hash.h"
#include "harness/compile/optimize.h"
#include "harness/compile/spirv_module.h"
#include "harness/mutate/glsl_tokens.h"

#include <algorithm>
#include <cstring>
#include <spirv_cross/spirv.hpp>

namespace crossray {

namespace fs = std::filesystem;

namespace {

// What an own tracer calls the functions of a file that it includes once more, with hooks of its own (cases/library).
constexpr std::string_view kCopyPrefix = "copyOf_";

std::map<std::string, std::set<uint32_t>> findLines(const std::vector<uint32_t>& spirv)
{
    std::map<uint32_t, std::string> strings;
    std::map<uint32_t, std::set<uint32_t>> lines;
    forEachSpirvInstruction(spirv, [&](uint32_t opcode, std::span<const uint32_t> operands) {
        if (opcode == spv::OpString) {
            const char* const text = reinterpret_cast<const char*>(&operands[1]);
            strings[operands[0]] = std::string(text, strnlen(text, (operands.size() - 1) * sizeof(uint32_t)));
        } else if (opcode == spv::OpLine) {
            lines[operands[0]].insert(operands[1]);
        }
    });
    std::map<std::string, std::set<uint32_t>> found;
    for (auto& [id, ofFile] : lines)
        found[strings[id]].merge(ofFile);
    return found;
}

// What the optimiser leaves unchecked a driver may not survive.
std::vector<uint32_t> optimizeRest(const std::vector<uint32_t>& pruned)
{
    std::vector<uint32_t> spirv = stripDebugInfo(specialize(pruned, {}, true));
    validate(spirv);
    return spirv;
}

} // namespace

MutantLibrary::MutantLibrary(fs::path shaderRoot) : root_(fs::absolute(std::move(shaderRoot)).lexically_normal())
{
    SourceSet sources;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root_)) {
        if (!entry.is_regular_file() || entry.path().extension() != ".glsl") continue;
        const std::string name = entry.path().lexically_relative(root_).generic_string();
        files_[name] = sources.open(name, entry.path());
    }
}

std::vector<std::string> MutantLibrary::fileNames() const
{
    std::vector<std::string> names;
    for (const auto& [name, file] : files_)
        names.push_back(name);
    return names;
}

const std::string& MutantLibrary::textOf(const std::string& name) const
{
    const auto found = files_.find(name);
    if (found == files_.end()) throw InputError({name}, "there is no such file in the shader library");
    return found->second.text;
}

MutantLibrary::Parsed MutantLibrary::parse(const ProgramKey& program, const ChangedFile* change) const
{
    SourceSet known;
    for (const auto& [name, file] : files_) {
        SourceFile copy = file;
        if (change != nullptr && change->name == name) copy.text = change->text;
        known.add(std::move(copy));
    }
    const bool isOwn = !program.ownTracer.empty();
    // The closure is what is read from the disk, so the library itself is parsed without the known ones.
    const bool wantsLines = isOwn || change == nullptr;
    FrontendResult result = parseShader({program.entry, root_ / program.entry}, root_, wantsLines, program.ownTracer,
                                        change == nullptr ? SourceSet{} : std::move(known));
    Parsed parsed;
    parsed.spirv = isOwn ? confineOwnTracer(result.spirv, program.ownTracer.string()) : std::move(result.spirv);
    parsed.functions = std::make_shared<const SpirvReach>(parsed.spirv);
    for (const SourceFile& file : result.sources.files())
        parsed.closure.insert(file.name);
    return parsed;
}

const MutantLibrary::Parsed& MutantLibrary::parsedOf(const ProgramKey& program)
{
    Slot<Parsed>* slot = nullptr;
    {
        const std::lock_guard lock(mutex_);
        auto& place = parsed_[{program.entry, program.ownTracer}];
        if (!place) place = std::make_unique<Slot<Parsed>>();
        slot = place.get();
    }
    const std::lock_guard lock(slot->making);
    if (!slot->done) slot->value = parse(program, nullptr);
    slot->done = true;
    return slot->value;
}

MutantLibrary::Variant& MutantLibrary::variantOf(const ProgramKey& program)
{
    const Parsed& parsed = parsedOf(program);
    Slot<Variant>* slot = nullptr;
    {
        const std::lock_guard lock(mutex_);
        auto& place = variants_[program];
        if (!place) place = std::make_unique<Slot<Variant>>();
        slot = place.get();
    }
    const std::lock_guard lock(slot->making);
    if (!slot->done) {
        Variant& variant = slot->value;
        variant.mangled = parsed.functions->find(program.specialization);
        for (const std::string& mangled : variant.mangled) {
            std::string name = mangled.substr(0, mangled.find('('));
            if (name.starts_with(kCopyPrefix)) name.erase(0, kCopyPrefix.size());
            variant.reach.insert(std::move(name));
        }
        slot->done = true;
    }
    return slot->value;
}

const std::set<std::string>& MutantLibrary::closureOf(const ProgramKey& program)
{
    return parsedOf(program).closure;
}

const std::set<std::string>& MutantLibrary::reachOf(const ProgramKey& program)
{
    return variantOf(program).reach;
}

std::vector<uint32_t> MutantLibrary::finish(const Parsed& parsed, const ProgramKey& program) const
{
    // By its own reach: a changed branch may call what the variant did not call before.
    const std::vector<uint32_t> kept =
        parsed.functions->keepOnly(parsed.functions->find(program.specialization), false);
    return optimizeRest(dropDeadFunctions(specialize(kept, program.specialization, false)));
}

MutantLibrary::Variant& MutantLibrary::compiledOf(const ProgramKey& program)
{
    Variant& variant = variantOf(program);
    Slot<Variant>* slot = nullptr;
    {
        const std::lock_guard lock(mutex_);
        slot = variants_[program].get();
    }
    const std::lock_guard lock(slot->making);
    if (!variant.isCompiled) {
        // With its lines, which change no code.
        const Parsed& parsed = parsedOf(program);
        const std::vector<uint32_t> kept = parsed.functions->keepOnly(variant.mangled, true);
        const std::vector<uint32_t> lined =
            specialize(dropDeadFunctions(specialize(kept, program.specialization, false)), {}, true);
        variant.lines = findLines(lined);
        variant.spirv = stripDebugInfo(lined);
        variant.isCompiled = true;
    }
    return variant;
}

const std::vector<uint32_t>& MutantLibrary::compile(const ProgramKey& program)
{
    return compiledOf(program).spirv;
}

bool MutantLibrary::holds(const ProgramKey& program, const std::string& file, const std::set<std::string>& functions)
{
    const Variant& variant = compiledOf(program);
    const auto lines = variant.lines.find(file);
    if (lines == variant.lines.end()) return false;
    const GlslSource source(textOf(file));
    return std::any_of(source.functions().begin(), source.functions().end(), [&](const GlslFunction& function) {
        if (!functions.contains(std::string(function.name))) return false;
        const auto first = lines->second.lower_bound(static_cast<uint32_t>(source.tokens()[function.open].line));
        return first != lines->second.end() && *first <= static_cast<uint32_t>(source.tokens()[function.close].line);
    });
}

std::vector<uint32_t> MutantLibrary::Mutant::compile(const ProgramKey& program)
{
    std::optional<Parsed>& parsed = parsed_[{program.entry, program.ownTracer}];
    if (!parsed) parsed = library_.parse(program, &change_);
    return library_.finish(*parsed, program);
}

std::string makeProgramKey(const std::vector<uint32_t>& spirv)
{
    return hashBytes(std::as_bytes(std::span(spirv))).hex();
}

CompiledShader LibraryCompiler::compile(const fs::path& shader, const CompileOptions& options)
{
    const fs::path relative = fs::absolute(shader).lexically_normal().lexically_relative(library_.root());
    CompiledShader compiled;
    if (listsOnly_ && options.ownTracer.empty()) return compiled;
    compiled.spirv = library_.compile({relative.generic_string(), options.ownTracer, options.specialization});
    compiled.key = makeProgramKey(compiled.spirv);
    compiled.localSize = findLocalSize(compiled.spirv);
    return compiled;
}

} // namespace crossray
