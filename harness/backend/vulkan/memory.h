// Memory that outlives a job, so that a small job allocates nothing: two or three buffers from which each job takes
// what it needs, and images by their shape. What a big job needed is given back when small ones follow.
#pragma once

#include "harness/backend/vulkan/context.h"
#include "harness/backend/vulkan/handles.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace crossray::vulkan {

// One buffer with its own memory that grows on demand.
class Arena {
  public:
    // `name` stands in error messages.
    Arena(const Context& context, const char* name, VkBufferUsageFlags usage, MemoryUse use);

    // Makes room for this job; what the buffer held is undefined afterwards. Throws EnvironmentError beyond the
    // device's limit.
    void reserve(VkDeviceSize bytes);
    VkBuffer buffer() const { return buffer_.get(); }
    std::byte* mapped() const { return mapped_; } // null where the host cannot map it
    bool canBeRead() const { return cached_; }    // mapped, and fast to read

  private:
    void allocate(VkDeviceSize bytes);

    const Context& context_;
    const char* name_;
    VkBufferUsageFlags usage_;
    MemoryUse use_;
    MemoryHandle memory_; // before the buffer: it outlives what is bound to it
    BufferHandle buffer_;
    VkDeviceSize capacity_ = 0;
    std::byte* mapped_ = nullptr;
    bool cached_ = false;
    int jobsWithWaste_ = 0;
};

struct ImageShape {
    uint32_t width = 0, height = 0, levels = 0;
    VkFormat format = VK_FORMAT_UNDEFINED;
    bool operator==(const ImageShape&) const = default;
};

class ImagePool {
  public:
    explicit ImagePool(const Context& context) : context_(context) {}

    struct Image {
        ImageShape shape;
        MemoryHandle memory; // before the image: it outlives what is bound to it
        ImageHandle image;
        ImageViewHandle view;
        bool inUse = false;
        int idleJobs = 0;
    };
    // An image that no one else uses until the next startJob; its content is undefined.
    const Image& acquire(const ImageShape& shape);
    // Takes all images back and drops those that no job has used for a while.
    void startJob();

  private:
    std::unique_ptr<Image> create(const ImageShape& shape) const;

    const Context& context_;
    std::vector<std::unique_ptr<Image>> images_;
};

} // namespace crossray::vulkan
