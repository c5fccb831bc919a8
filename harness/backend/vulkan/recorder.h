// The command buffer of one job, and its way through the queue.
#pragma once

#include "harness/backend/vulkan/context.h"
#include "harness/backend/vulkan/handles.h"
#include "harness/backend/vulkan/programs.h"

#include <array>
#include <span>
#include <vector>

namespace crossray::vulkan {

// Commands are recorded in this order: start; clear and uploads; beginDispatches; dispatches; endDispatches; copies;
// submit.
class Recorder {
  public:
    explicit Recorder(const Context& context);

    // Empties the command buffer and makes room for the descriptors of this many sets and bindings.
    void start(uint32_t setCount, uint32_t bindingCount);
    void clearBuffer(VkBuffer buffer, VkDeviceSize bytes);
    // Fills all levels of an image from a buffer, one region a level, and makes the image readable by shaders.
    void uploadImage(VkBuffer from, VkImage image, std::span<const VkBufferImageCopy> levels);
    void beginDispatches();
    // What a binding of the program holds: exactly one of the two is set.
    struct Resource {
        VkDescriptorImageInfo image{};
        VkDescriptorBufferInfo buffer{};
    };
    // `resources` follow the order of program.interface.bindings. Sees what earlier dispatches wrote.
    void dispatch(const Program& program, std::span<const Resource> resources, std::array<uint32_t, 3> groups);
    void endDispatches();
    void copyBuffer(VkBuffer from, VkBuffer to, std::span<const VkBufferCopy> regions);
    // Ends the recording, runs it and waits. Throws EnvironmentError when the device is lost.
    void submitAndWait();
    // Time between beginDispatches and endDispatches by the device's clock; -1 where it has none.
    double deviceMilliseconds() const;

  private:
    void memoryBarrier(VkPipelineStageFlags fromStage, VkAccessFlags from, VkPipelineStageFlags toStage,
                       VkAccessFlags to);
    void writeTimestamp(uint32_t index);
    VkDescriptorSet allocateSet(VkDescriptorSetLayout layout);

    const Context& context_;
    CommandPoolHandle commandPool_;
    VkCommandBuffer commands_ = VK_NULL_HANDLE; // of the pool
    FenceHandle fence_;
    QueryPoolHandle timestamps_; // empty where the queue has none
    DescriptorPoolHandle descriptorPool_;
    uint32_t setCapacity_ = 0, bindingCapacity_ = 0;
    bool isFirstDispatch_ = true;
};

} // namespace crossray::vulkan
