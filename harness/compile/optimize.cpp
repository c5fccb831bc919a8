#include "harness/compile/optimize.h"

#include "harness/base/error.h"
#include "harness/compile/flatten.h"
#include "harness/compile/spirv_module.h"

#include <fmt/format.h>
#include <spirv-tools/libspirv.hpp>
#include <spirv-tools/optimizer.hpp>

#include <algorithm>
#include <unordered_map>

namespace crossray {

namespace {

constexpr spv_target_env kEnvironment = SPV_ENV_VULKAN_1_1;

spvtools::MessageConsumer collectInto(std::string& text)
{
    return [&text](spv_message_level_t level, const char*, const spv_position_t&, const char* message) {
        if (level > SPV_MSG_ERROR) return;
        if (!text.empty()) text += '\n';
        text += message;
    };
}

std::vector<uint32_t> runPasses(spvtools::Optimizer& optimizer, const std::vector<uint32_t>& spirv)
{
    std::string messages;
    optimizer.SetMessageConsumer(collectInto(messages));
    spvtools::OptimizerOptions options;
    options.set_run_validator(false); // the result is validated once, at the end
    std::vector<uint32_t> result;
    if (!optimizer.Run(spirv.data(), spirv.size(), &result, options)) {
        throw ShaderError("the SPIR-V optimiser failed: " + (messages.empty() ? "no message" : messages));
    }
    return result;
}

std::unordered_map<uint32_t, std::vector<uint32_t>> encodeValues(const std::vector<uint32_t>& spirv,
                                                                 const std::map<std::string, double>& values)
{
    std::unordered_map<uint32_t, std::vector<uint32_t>> encoded;
    if (values.empty()) return encoded;
    const std::vector<SpecializationConstant> constants = findSpecializationConstants(spirv);
    for (const auto& [name, value] : values) {
        const auto found = std::find_if(constants.begin(), constants.end(),
                                        [&name = name](const auto& constant) { return constant.name == name; });
        if (found == constants.end()) {
            std::vector<std::string> known;
            for (const SpecializationConstant& constant : constants)
                known.push_back(constant.name);
            std::sort(known.begin(), known.end());
            throw InputError(known.empty()
                                 ? fmt::format("unknown specialization constant \"{}\"; the shader has none", name)
                                 : fmt::format("unknown specialization constant \"{}\"; the shader has {}", name,
                                               fmt::join(known, ", ")));
        }
        encoded[found->specId] = encodeConstant(*found, value);
    }
    return encoded;
}

} // namespace

std::vector<uint32_t> specialize(const std::vector<uint32_t>& spirv, const std::map<std::string, double>& values,
                                 bool optimize)
{
    spvtools::Optimizer freezer(kEnvironment);
    if (const auto encoded = encodeValues(spirv, values); !encoded.empty()) {
        freezer.RegisterPass(spvtools::CreateSetSpecConstantDefaultValuePass(encoded));
    }
    freezer.RegisterPass(spvtools::CreateFreezeSpecConstantValuePass());
    freezer.RegisterPass(spvtools::CreateFoldSpecConstantOpAndCompositePass());
    std::vector<uint32_t> frozen = runPasses(freezer, spirv);
    setLocalSize(frozen, findLocalSize(frozen));
    if (!optimize) return frozen;

    // The first round inlines and propagates the variant's constants; with its dead branches gone and the small ones
    // flattened, a shorter second round hoists out of loops and folds what the first could not.
    spvtools::Optimizer first(kEnvironment);
    first.RegisterPerformancePasses();
    const std::vector<uint32_t> straight = flattenBranches(runPasses(first, forbidContraction(frozen)));
    spvtools::Optimizer second(kEnvironment);
    // Up to SPIRV-Tools 2023.1 this pass takes a load out of a loop that stores to the same place (its issue 5075): a
    // table in a loop then answers by what it held before.
    if (!loadsWhatItStores(straight)) second.RegisterPass(spvtools::CreateLoopInvariantCodeMotionPass());
    second.RegisterPass(spvtools::CreateCCPPass());
    second.RegisterPass(spvtools::CreateDeadBranchElimPass());
    second.RegisterPass(spvtools::CreateRedundancyEliminationPass());
    second.RegisterPass(spvtools::CreateSimplificationPass());
    second.RegisterPass(spvtools::CreateAggressiveDCEPass());
    second.RegisterPass(spvtools::CreateCFGCleanupPass());
    second.RegisterPass(spvtools::CreateBlockMergePass());
    second.RegisterPass(spvtools::CreateEliminateDeadConstantPass());
    second.RegisterPass(spvtools::CreateCompactIdsPass());
    return allowContraction(runPasses(second, straight));
}

std::vector<uint32_t> dropDeadFunctions(const std::vector<uint32_t>& spirv)
{
    spvtools::Optimizer optimizer(kEnvironment);
    optimizer.RegisterPass(spvtools::CreateDeadBranchElimPass());
    optimizer.RegisterPass(spvtools::CreateEliminateDeadFunctionsPass());
    return runPasses(optimizer, spirv);
}

std::vector<uint32_t> stripDebugInfo(const std::vector<uint32_t>& spirv)
{
    spvtools::Optimizer optimizer(kEnvironment);
    optimizer.RegisterPass(spvtools::CreateStripDebugInfoPass());
    optimizer.RegisterPass(spvtools::CreateCompactIdsPass());
    return runPasses(optimizer, spirv);
}

void validate(const std::vector<uint32_t>& spirv)
{
    std::string messages;
    spvtools::SpirvTools tools(kEnvironment);
    tools.SetMessageConsumer(collectInto(messages));
    if (!tools.Validate(spirv)) throw ShaderError("invalid SPIR-V: " + messages);
}

std::string disassembleSpirv(const std::vector<uint32_t>& spirv)
{
    std::string messages;
    spvtools::SpirvTools tools(kEnvironment);
    tools.SetMessageConsumer(collectInto(messages));
    std::string text;
    const uint32_t options = SPV_BINARY_TO_TEXT_OPTION_INDENT | SPV_BINARY_TO_TEXT_OPTION_FRIENDLY_NAMES;
    if (!tools.Disassemble(spirv, &text, options)) throw ShaderError("this is no SPIR-V module: " + messages);
    return text;
}

} // namespace crossray
