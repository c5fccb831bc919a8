#include "harness/backend/vulkan/programs.h"

#include "harness/base/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace crossray::vulkan {
namespace {

void checkLimits(const SpirvInterface& interface, const std::string& entry, const VkPhysicalDeviceLimits& limits)
{
    const auto& size = interface.localSize;
    const uint64_t invocations = uint64_t{size[0]} * size[1] * size[2];
    if (invocations > limits.maxComputeWorkGroupInvocations)
        throw ShaderError(fmt::format("{}: a group of {} x {} x {} is {} invocations; this device allows {}", entry,
                                      size[0], size[1], size[2], invocations, limits.maxComputeWorkGroupInvocations));
    for (size_t axis = 0; axis < 3; ++axis)
        if (size[axis] > limits.maxComputeWorkGroupSize[axis])
            throw ShaderError(fmt::format("{}: a group is {} wide in {}; this device allows {}", entry, size[axis],
                                          "xyz"[axis], limits.maxComputeWorkGroupSize[axis]));
    if (interface.sharedBytes > limits.maxComputeSharedMemorySize)
        throw ShaderError(fmt::format("{}: {} bytes of shared variables; this device allows {}", entry,
                                      interface.sharedBytes, limits.maxComputeSharedMemorySize));
}

DescriptorSetLayoutHandle createSetLayout(VkDevice device, const SpirvInterface& interface)
{
    std::vector<VkDescriptorSetLayoutBinding> bindings;
    for (const SpirvBinding& binding : interface.bindings) {
        VkDescriptorSetLayoutBinding described{};
        described.binding = binding.binding;
        described.descriptorType = descriptorTypeOf(binding.kind);
        described.descriptorCount = 1;
        described.stageFlags = VK_SHADER_STAGE_COMPUTE_BIT;
        bindings.push_back(described);
    }
    VkDescriptorSetLayoutCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    info.bindingCount = static_cast<uint32_t>(bindings.size());
    info.pBindings = bindings.data();
    return makeHandle<DescriptorSetLayoutHandle>(device, vkCreateDescriptorSetLayout, info,
                                                 "vkCreateDescriptorSetLayout");
}

bool isEnvironmental(VkResult result)
{
    return result == VK_ERROR_DEVICE_LOST || result == VK_ERROR_OUT_OF_DEVICE_MEMORY ||
           result == VK_ERROR_OUT_OF_HOST_MEMORY;
}

} // namespace

VkDescriptorType descriptorTypeOf(DescriptorKind kind)
{
    switch (kind) {
    case DescriptorKind::kSampledImage:
        return VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    case DescriptorKind::kUniformBuffer:
        return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    case DescriptorKind::kStorageBuffer:
        return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    }
    return VK_DESCRIPTOR_TYPE_MAX_ENUM;
}

ProgramCache::ProgramCache(Context& context, size_t capacity) : context_(context), capacity_(capacity)
{
    VkPipelineCacheCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO;
    pipelineCache_ =
        makeHandle<PipelineCacheHandle>(context.device(), vkCreatePipelineCache, info, "vkCreatePipelineCache");
}

const Program& ProgramCache::acquire(const ProgramSource& source, bool& wasWarm)
{
    const auto found = byKey_.find(source.key);
    wasWarm = found != byKey_.end();
    if (wasWarm) {
        programs_.splice(programs_.begin(), programs_, found->second);
    } else {
        programs_.push_front(create(source));
        byKey_.emplace(source.key, programs_.begin());
    }
    return programs_.front();
}

void ProgramCache::trim()
{
    while (programs_.size() > capacity_) {
        byKey_.erase(programs_.back().key);
        programs_.pop_back();
    }
}

Program ProgramCache::create(const ProgramSource& source)
{
    Program program;
    program.key = source.key;
    try {
        program.interface = readSpirvInterface(source.spirv);
    } catch (const ShaderError& error) {
        throw ShaderError(fmt::format("{}: {}", source.entry, error.what()));
    }
    checkLimits(program.interface, source.entry, context_.limits());
    program.setLayout = createSetLayout(context_.device(), program.interface);
    VkPipelineLayoutCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    info.setLayoutCount = 1;
    info.pSetLayouts = program.setLayout.address();
    program.layout =
        makeHandle<PipelineLayoutHandle>(context_.device(), vkCreatePipelineLayout, info, "vkCreatePipelineLayout");
    program.pipeline = PipelineHandle(context_.device(), createPipeline(source, program.layout.get()));
    return program;
}

VkPipeline ProgramCache::createPipeline(const ProgramSource& source, VkPipelineLayout layout)
{
    const auto checkCompile = [&](VkResult result, const char* call) {
        if (result == VK_SUCCESS) return;
        if (isEnvironmental(result)) check(result, call);
        throw ShaderError(fmt::format("{}: the driver refuses the program: {} gave {} ({}) {}", source.entry, call,
                                      nameOf(result), static_cast<int>(result),
                                      fmt::join(context_.messages().take(), "\n")));
    };
    VkShaderModuleCreateInfo moduleInfo{};
    moduleInfo.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
    moduleInfo.codeSize = source.spirv.size() * sizeof(uint32_t);
    moduleInfo.pCode = source.spirv.data();
    VkShaderModule rawModule = VK_NULL_HANDLE;
    checkCompile(vkCreateShaderModule(context_.device(), &moduleInfo, nullptr, &rawModule), "vkCreateShaderModule");
    const ShaderModuleHandle module(context_.device(), rawModule);

    VkComputePipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.module = module.get();
    info.stage.pName = "main";
    info.layout = layout;
    VkPipeline pipeline = VK_NULL_HANDLE;
    checkCompile(vkCreateComputePipelines(context_.device(), pipelineCache_.get(), 1, &info, nullptr, &pipeline),
                 "vkCreateComputePipelines");
    return pipeline;
}

} // namespace crossray::vulkan
