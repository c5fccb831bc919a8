// Instance, physical device, logical device and queue; what the device can do; and the messages of the validation
// layer.
#pragma once

#include "harness/backend/device.h"
#include "harness/backend/vulkan/handles.h"

#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace crossray::vulkan {

// Warnings and errors of the validation layer, from whichever thread reports them.
class MessageLog {
  public:
    void add(std::string text);
    std::vector<std::string> take(); // and empties it

  private:
    static constexpr size_t kMostMessages = 100; // a shader that is wrong in each dispatch says so often enough

    std::mutex mutex_;
    std::vector<std::string> messages_;
    size_t dropped_ = 0;
};

// How memory is used decides the memory type.
enum class MemoryUse {
    kUpload,   // written once by the host, read once by the device
    kDevice,   // fast for the device; mappable where that costs nothing (software devices, integrated GPUs)
    kReadback, // written by the device, read by the host
};

class Context {
  public:
    // Opens the first device whose name contains `deviceName`. Throws EnvironmentError.
    Context(const std::string& deviceName, bool validation);
    ~Context();
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    VkDevice device() const { return device_; }
    VkQueue queue() const { return queue_; }
    uint32_t queueFamily() const { return queueFamily_; }
    const VkPhysicalDeviceLimits& limits() const { return properties_.limits; }
    VkDeviceSize maxAllocation() const { return maxAllocation_; }
    bool hasTimestamps() const { return timestampBits_ > 0; }
    // Difference of two timestamps of the queue, which may have wrapped round.
    double millisecondsBetween(uint64_t begin, uint64_t end) const;
    // Throws EnvironmentError when the device cannot sample the format with this filter.
    void requireSampling(VkFormat format, ImageFilter filter) const;

    // Index of the memory type for a use among those that `allowed` (memoryTypeBits) names.
    uint32_t chooseMemoryType(uint32_t allowed, MemoryUse use) const;
    VkMemoryPropertyFlags memoryTypeFlags(uint32_t index) const;

    Fingerprint describe(const std::string& backendName) const;
    MessageLog& messages() { return messages_; }

  private:
    void createInstance(bool validation);
    void createMessenger();
    void choosePhysicalDevice(const std::string& deviceName);
    void createDevice();
    void destroy();

    MessageLog messages_; // before the instance: the layer writes to it until the instance is gone
    VkInstance instance_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    VkPhysicalDevice physicalDevice_ = VK_NULL_HANDLE;
    VkDevice device_ = VK_NULL_HANDLE;
    VkQueue queue_ = VK_NULL_HANDLE;
    uint32_t queueFamily_ = 0;
    uint32_t timestampBits_ = 0;
    VkDeviceSize maxAllocation_ = 0;
    VkPhysicalDeviceProperties properties_{};
    VkPhysicalDeviceMemoryProperties memory_{};
    std::string driver_; // "llvmpipe Mesa 22.3.6 (LLVM 15.0.6)"
};

// "15.0.6" from "llvmpipe (LLVM 15.0.6, 256 bits)"; "" where the text names none.
std::string parseLlvmVersion(const std::string& text);

} // namespace crossray::vulkan
