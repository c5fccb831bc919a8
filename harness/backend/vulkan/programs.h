// Compute pipelines, kept by key for later jobs: the driver's compile costs more than everything else in a small job.
#pragma once

#include "harness/backend/vulkan/context.h"
#include "harness/backend/vulkan/handles.h"
#include "harness/backend/vulkan/spirv_interface.h"

#include <list>
#include <string>
#include <unordered_map>
#include <vector>

namespace crossray::vulkan {

VkDescriptorType descriptorTypeOf(DescriptorKind kind);

struct Program {
    std::string key;
    SpirvInterface interface;
    DescriptorSetLayoutHandle setLayout;
    PipelineLayoutHandle layout;
    PipelineHandle pipeline;
};

class ProgramCache {
  public:
    ProgramCache(Context& context, size_t capacity);

    // The program of this key, made if need be. Throws ShaderError when the code or the device's limits forbid it and
    // when the driver refuses it; EnvironmentError when the device is lost or out of memory.
    const Program& acquire(const ProgramSource& source, bool& wasWarm);
    // Drops the least recently used programs beyond the capacity. Not while a job runs: it may hold more than the
    // capacity.
    void trim();

  private:
    Program create(const ProgramSource& source);
    VkPipeline createPipeline(const ProgramSource& source, VkPipelineLayout layout);

    Context& context_;
    size_t capacity_;
    PipelineCacheHandle pipelineCache_;
    std::list<Program> programs_; // most recently used first
    std::unordered_map<std::string, std::list<Program>::iterator> byKey_;
};

} // namespace crossray::vulkan
