#include "harness/backend/vulkan/memory.h"

#include "harness/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace crossray::vulkan {
namespace {

constexpr int kKeepForJobs = 16;
constexpr VkDeviceSize kSmallestArena = VkDeviceSize{1} << 20;
constexpr VkDeviceSize kAlwaysKept = VkDeviceSize{16} << 20;

MemoryHandle allocateMemory(const Context& context, VkDeviceSize bytes, uint32_t type, const char* what)
{
    if (bytes > context.maxAllocation())
        throw EnvironmentError(
            fmt::format("{} take {} bytes; the device allows {} in one piece", what, bytes, context.maxAllocation()));
    VkMemoryAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    info.allocationSize = bytes;
    info.memoryTypeIndex = type;
    return makeHandle<MemoryHandle>(context.device(), vkAllocateMemory, info, "vkAllocateMemory");
}

} // namespace

Arena::Arena(const Context& context, const char* name, VkBufferUsageFlags usage, MemoryUse use)
    : context_(context), name_(name), usage_(usage), use_(use)
{
}

void Arena::reserve(VkDeviceSize bytes)
{
    const bool wasteful = capacity_ > kAlwaysKept && bytes < capacity_ / 4;
    jobsWithWaste_ = wasteful ? jobsWithWaste_ + 1 : 0;
    if (bytes > capacity_ || jobsWithWaste_ > kKeepForJobs) allocate(bytes);
}

void Arena::allocate(VkDeviceSize bytes)
{
    // Released first: old and new together might not fit.
    buffer_ = {};
    memory_ = {};
    mapped_ = nullptr;
    capacity_ = 0;
    jobsWithWaste_ = 0;
    if (bytes > context_.maxAllocation())
        throw EnvironmentError(fmt::format("the job's {} take {} bytes; the device allows {} in one piece", name_,
                                           bytes, context_.maxAllocation()));
    const VkDeviceSize capacity =
        std::min(std::bit_ceil(std::max(bytes, kSmallestArena)), std::max(bytes, context_.maxAllocation() / 2));

    VkBufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    info.size = capacity;
    info.usage = usage_;
    BufferHandle buffer = makeHandle<BufferHandle>(context_.device(), vkCreateBuffer, info, "vkCreateBuffer");
    VkMemoryRequirements needs{};
    vkGetBufferMemoryRequirements(context_.device(), buffer.get(), &needs);
    const uint32_t type = context_.chooseMemoryType(needs.memoryTypeBits, use_);
    memory_ = allocateMemory(context_, needs.size, type, name_);
    check(vkBindBufferMemory(context_.device(), buffer.get(), memory_.get(), 0), "vkBindBufferMemory");

    constexpr VkMemoryPropertyFlags kMappable =
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    const VkMemoryPropertyFlags flags = context_.memoryTypeFlags(type);
    if ((flags & kMappable) == kMappable) {
        void* address = nullptr;
        check(vkMapMemory(context_.device(), memory_.get(), 0, VK_WHOLE_SIZE, 0, &address), "vkMapMemory");
        mapped_ = static_cast<std::byte*>(address);
    }
    cached_ = mapped_ != nullptr && (flags & VK_MEMORY_PROPERTY_HOST_CACHED_BIT) != 0;
    buffer_ = std::move(buffer);
    capacity_ = capacity;
}

const ImagePool::Image& ImagePool::acquire(const ImageShape& shape)
{
    auto found = std::find_if(images_.begin(), images_.end(),
                              [&](const auto& image) { return !image->inUse && image->shape == shape; });
    if (found == images_.end()) found = images_.insert(found, create(shape));
    (*found)->inUse = true;
    (*found)->idleJobs = 0;
    return **found;
}

void ImagePool::startJob()
{
    for (const auto& image : images_) {
        image->inUse = false;
        ++image->idleJobs;
    }
    std::erase_if(images_, [](const auto& image) { return image->idleJobs > kKeepForJobs; });
}

std::unique_ptr<ImagePool::Image> ImagePool::create(const ImageShape& shape) const
{
    VkImageCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = shape.format;
    info.extent = {shape.width, shape.height, 1};
    info.mipLevels = shape.levels;
    info.arrayLayers = 1;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.tiling = VK_IMAGE_TILING_OPTIMAL;
    info.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    auto result = std::make_unique<Image>();
    result->shape = shape;
    result->image = makeHandle<ImageHandle>(context_.device(), vkCreateImage, info, "vkCreateImage");

    VkMemoryRequirements needs{};
    vkGetImageMemoryRequirements(context_.device(), result->image.get(), &needs);
    const uint32_t type = context_.chooseMemoryType(needs.memoryTypeBits, MemoryUse::kDevice);
    result->memory = allocateMemory(context_, needs.size, type, "one image's texels");
    check(vkBindImageMemory(context_.device(), result->image.get(), result->memory.get(), 0), "vkBindImageMemory");

    VkImageViewCreateInfo view{};
    view.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
    view.image = result->image.get();
    view.viewType = VK_IMAGE_VIEW_TYPE_2D;
    view.format = shape.format;
    view.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, shape.levels, 0, 1};
    result->view = makeHandle<ImageViewHandle>(context_.device(), vkCreateImageView, view, "vkCreateImageView");
    return result;
}

} // namespace crossray::vulkan
