// Ownership of Vulkan objects, and the one place that turns a VkResult into an error.
#pragma once

#include <vulkan/vulkan.h>

#include <string_view>
#include <type_traits>
#include <utility>

namespace crossray::vulkan {

// "VK_ERROR_DEVICE_LOST".
std::string_view nameOf(VkResult result);

// Throws EnvironmentError "vkQueueSubmit gave VK_ERROR_DEVICE_LOST (-4): the device is lost" unless the call succeeded.
void check(VkResult result, std::string_view call);

// An object of a device, destroyed with its owner. The device outlives it.
template <typename T, void (*kDestroy)(VkDevice, T, const VkAllocationCallbacks*)>
class DeviceHandle {
  public:
    DeviceHandle() = default;
    DeviceHandle(VkDevice device, T object) : device_(device), object_(object) {}
    DeviceHandle(DeviceHandle&& other) noexcept
        : device_(other.device_), object_(std::exchange(other.object_, T{VK_NULL_HANDLE}))
    {
    }
    DeviceHandle& operator=(DeviceHandle&& other) noexcept
    {
        std::swap(device_, other.device_);
        std::swap(object_, other.object_);
        return *this;
    }
    ~DeviceHandle()
    {
        if (object_ != VK_NULL_HANDLE) kDestroy(device_, object_, nullptr);
    }

    T get() const { return object_; }
    const T* address() const { return &object_; }

  private:
    VkDevice device_ = VK_NULL_HANDLE;
    T object_ = VK_NULL_HANDLE;
};

using BufferHandle = DeviceHandle<VkBuffer, vkDestroyBuffer>;
using CommandPoolHandle = DeviceHandle<VkCommandPool, vkDestroyCommandPool>;
using DescriptorPoolHandle = DeviceHandle<VkDescriptorPool, vkDestroyDescriptorPool>;
using DescriptorSetLayoutHandle = DeviceHandle<VkDescriptorSetLayout, vkDestroyDescriptorSetLayout>;
using FenceHandle = DeviceHandle<VkFence, vkDestroyFence>;
using ImageHandle = DeviceHandle<VkImage, vkDestroyImage>;
using ImageViewHandle = DeviceHandle<VkImageView, vkDestroyImageView>;
using MemoryHandle = DeviceHandle<VkDeviceMemory, vkFreeMemory>; // freeing unmaps
using PipelineCacheHandle = DeviceHandle<VkPipelineCache, vkDestroyPipelineCache>;
using PipelineHandle = DeviceHandle<VkPipeline, vkDestroyPipeline>;
using PipelineLayoutHandle = DeviceHandle<VkPipelineLayout, vkDestroyPipelineLayout>;
using QueryPoolHandle = DeviceHandle<VkQueryPool, vkDestroyQueryPool>;
using SamplerHandle = DeviceHandle<VkSampler, vkDestroySampler>;
using ShaderModuleHandle = DeviceHandle<VkShaderModule, vkDestroyShaderModule>;

// Makes an object with one of the vkCreate... calls that share this shape.
template <typename Handle, typename Create, typename Info>
Handle makeHandle(VkDevice device, Create create, const Info& info, std::string_view call)
{
    std::remove_const_t<std::remove_pointer_t<decltype(Handle{}.address())>> object = VK_NULL_HANDLE;
    check(create(device, &info, nullptr, &object), call);
    return Handle(device, object);
}

} // namespace crossray::vulkan
