#include "harness/backend/vulkan/recorder.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace crossray::vulkan {
namespace {

constexpr VkAccessFlags kShaderReads = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_UNIFORM_READ_BIT;

VkImageMemoryBarrier describeTransition(VkImage image, VkImageLayout from, VkImageLayout to, VkAccessFlags source,
                                        VkAccessFlags target)
{
    VkImageMemoryBarrier barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
    barrier.srcAccessMask = source;
    barrier.dstAccessMask = target;
    barrier.oldLayout = from;
    barrier.newLayout = to;
    barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image;
    barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, VK_REMAINING_MIP_LEVELS, 0, VK_REMAINING_ARRAY_LAYERS};
    return barrier;
}

DescriptorPoolHandle createDescriptorPool(VkDevice device, uint32_t sets, uint32_t bindings)
{
    const std::array sizes{VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, bindings},
                           VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, bindings},
                           VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, bindings}};
    VkDescriptorPoolCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    info.maxSets = sets;
    info.poolSizeCount = static_cast<uint32_t>(sizes.size());
    info.pPoolSizes = sizes.data();
    return makeHandle<DescriptorPoolHandle>(device, vkCreateDescriptorPool, info, "vkCreateDescriptorPool");
}

} // namespace

Recorder::Recorder(const Context& context) : context_(context)
{
    VkCommandPoolCreateInfo poolInfo{};
    poolInfo.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    poolInfo.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
    poolInfo.queueFamilyIndex = context.queueFamily();
    commandPool_ =
        makeHandle<CommandPoolHandle>(context.device(), vkCreateCommandPool, poolInfo, "vkCreateCommandPool");
    VkCommandBufferAllocateInfo bufferInfo{};
    bufferInfo.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    bufferInfo.commandPool = commandPool_.get();
    bufferInfo.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    bufferInfo.commandBufferCount = 1;
    check(vkAllocateCommandBuffers(context.device(), &bufferInfo, &commands_), "vkAllocateCommandBuffers");
    VkFenceCreateInfo fenceInfo{};
    fenceInfo.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
    fence_ = makeHandle<FenceHandle>(context.device(), vkCreateFence, fenceInfo, "vkCreateFence");
    if (!context.hasTimestamps()) return;
    VkQueryPoolCreateInfo queryInfo{};
    queryInfo.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
    queryInfo.queryType = VK_QUERY_TYPE_TIMESTAMP;
    queryInfo.queryCount = 2;
    timestamps_ = makeHandle<QueryPoolHandle>(context.device(), vkCreateQueryPool, queryInfo, "vkCreateQueryPool");
}

void Recorder::start(uint32_t setCount, uint32_t bindingCount)
{
    if (setCapacity_ == 0 || setCount > setCapacity_ || bindingCount > bindingCapacity_) {
        setCapacity_ = std::bit_ceil(std::max({setCount, setCapacity_, 16u}));
        bindingCapacity_ = std::bit_ceil(std::max({bindingCount, bindingCapacity_, 64u}));
        descriptorPool_ = createDescriptorPool(context_.device(), setCapacity_, bindingCapacity_);
    } else {
        check(vkResetDescriptorPool(context_.device(), descriptorPool_.get(), 0), "vkResetDescriptorPool");
    }
    check(vkResetCommandPool(context_.device(), commandPool_.get(), 0), "vkResetCommandPool");
    VkCommandBufferBeginInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(vkBeginCommandBuffer(commands_, &info), "vkBeginCommandBuffer");
    if (timestamps_.get() != VK_NULL_HANDLE) vkCmdResetQueryPool(commands_, timestamps_.get(), 0, 2);
    isFirstDispatch_ = true;
}

void Recorder::clearBuffer(VkBuffer buffer, VkDeviceSize bytes)
{
    vkCmdFillBuffer(commands_, buffer, 0, bytes, 0);
}

void Recorder::uploadImage(VkBuffer from, VkImage image, std::span<const VkBufferImageCopy> levels)
{
    const VkImageMemoryBarrier before = describeTransition(
        image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 0, VK_ACCESS_TRANSFER_WRITE_BIT);
    vkCmdPipelineBarrier(commands_, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 0, nullptr, 0,
                         nullptr, 1, &before);
    vkCmdCopyBufferToImage(commands_, from, image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                           static_cast<uint32_t>(levels.size()), levels.data());
    const VkImageMemoryBarrier after =
        describeTransition(image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                           VK_ACCESS_TRANSFER_WRITE_BIT, VK_ACCESS_SHADER_READ_BIT);
    vkCmdPipelineBarrier(commands_, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, 0, 0, nullptr,
                         0, nullptr, 1, &after);
}

void Recorder::beginDispatches()
{
    memoryBarrier(VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
                  kShaderReads | VK_ACCESS_SHADER_WRITE_BIT);
    writeTimestamp(0);
}

void Recorder::dispatch(const Program& program, std::span<const Resource> resources, std::array<uint32_t, 3> groups)
{
    if (!isFirstDispatch_)
        memoryBarrier(VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_WRITE_BIT,
                      VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT);
    isFirstDispatch_ = false;

    const VkDescriptorSet set = allocateSet(program.setLayout.get());
    std::vector<VkWriteDescriptorSet> writes;
    for (size_t i = 0; i < resources.size(); ++i) {
        const SpirvBinding& binding = program.interface.bindings[i];
        VkWriteDescriptorSet write{};
        write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        write.dstSet = set;
        write.dstBinding = binding.binding;
        write.descriptorCount = 1;
        write.descriptorType = descriptorTypeOf(binding.kind);
        if (binding.kind == DescriptorKind::kSampledImage)
            write.pImageInfo = &resources[i].image;
        else
            write.pBufferInfo = &resources[i].buffer;
        writes.push_back(write);
    }
    vkUpdateDescriptorSets(context_.device(), static_cast<uint32_t>(writes.size()), writes.data(), 0, nullptr);
    vkCmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, program.pipeline.get());
    vkCmdBindDescriptorSets(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, program.layout.get(), 0, 1, &set, 0, nullptr);
    vkCmdDispatch(commands_, groups[0], groups[1], groups[2]);
}

void Recorder::endDispatches()
{
    writeTimestamp(1);
    memoryBarrier(VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT,
                  VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT,
                  VK_PIPELINE_STAGE_HOST_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT,
                  VK_ACCESS_HOST_READ_BIT | VK_ACCESS_TRANSFER_READ_BIT);
}

void Recorder::copyBuffer(VkBuffer from, VkBuffer to, std::span<const VkBufferCopy> regions)
{
    vkCmdCopyBuffer(commands_, from, to, static_cast<uint32_t>(regions.size()), regions.data());
    memoryBarrier(VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT, VK_PIPELINE_STAGE_HOST_BIT,
                  VK_ACCESS_HOST_READ_BIT);
}

void Recorder::submitAndWait()
{
    check(vkEndCommandBuffer(commands_), "vkEndCommandBuffer");
    VkSubmitInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    info.commandBufferCount = 1;
    info.pCommandBuffers = &commands_;
    check(vkResetFences(context_.device(), 1, fence_.address()), "vkResetFences");
    check(vkQueueSubmit(context_.queue(), 1, &info, fence_.get()), "vkQueueSubmit");
    // Without an end: a shader may take as long as the caller grants it, and only he can end the process.
    check(vkWaitForFences(context_.device(), 1, fence_.address(), VK_TRUE, std::numeric_limits<uint64_t>::max()),
          "vkWaitForFences");
}

double Recorder::deviceMilliseconds() const
{
    if (timestamps_.get() == VK_NULL_HANDLE) return -1;
    std::array<uint64_t, 2> ticks{};
    check(vkGetQueryPoolResults(context_.device(), timestamps_.get(), 0, 2, sizeof(ticks), ticks.data(),
                                sizeof(uint64_t), VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
          "vkGetQueryPoolResults");
    return context_.millisecondsBetween(ticks[0], ticks[1]);
}

void Recorder::memoryBarrier(VkPipelineStageFlags fromStage, VkAccessFlags from, VkPipelineStageFlags toStage,
                             VkAccessFlags to)
{
    VkMemoryBarrier barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
    barrier.srcAccessMask = from;
    barrier.dstAccessMask = to;
    vkCmdPipelineBarrier(commands_, fromStage, toStage, 0, 1, &barrier, 0, nullptr, 0, nullptr);
}

// At the bottom of the pipe: the first waits for the uploads, the second for the dispatches.
void Recorder::writeTimestamp(uint32_t index)
{
    if (timestamps_.get() != VK_NULL_HANDLE)
        vkCmdWriteTimestamp(commands_, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, timestamps_.get(), index);
}

VkDescriptorSet Recorder::allocateSet(VkDescriptorSetLayout layout)
{
    VkDescriptorSetAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    info.descriptorPool = descriptorPool_.get();
    info.descriptorSetCount = 1;
    info.pSetLayouts = &layout;
    VkDescriptorSet set = VK_NULL_HANDLE;
    check(vkAllocateDescriptorSets(context_.device(), &info, &set), "vkAllocateDescriptorSets");
    return set;
}

} // namespace crossray::vulkan
