#include "harness/backend/vulkan/job_layout.h"

#include "harness/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>

namespace crossray::vulkan {
namespace {

constexpr VkDeviceSize kScalarBytes = sizeof(float);

VkDeviceSize alignUp(VkDeviceSize value, VkDeviceSize alignment)
{
    return (value + alignment - 1) / alignment * alignment;
}

// Takes `size` bytes from the end of `total`.
ByteRange take(VkDeviceSize& total, VkDeviceSize size, VkDeviceSize alignment)
{
    const ByteRange range{alignUp(total, alignment), size};
    total = range.offset + size;
    return range;
}

void checkImage(const ImageDesc& image, size_t index, const VkPhysicalDeviceLimits& limits)
{
    if (image.width < 1 || image.height < 1)
        throw InputError(
            fmt::format("image {} is {} x {}; it needs at least one texel", index, image.width, image.height));
    if (image.channels != 1 && image.channels != 4)
        throw InputError(fmt::format("image {} has {} channels; 1 and 4 are allowed", index, image.channels));
    const int mostLevels = std::bit_width(static_cast<unsigned>(std::max(image.width, image.height)));
    if (image.levels < 1 || image.levels > mostLevels)
        throw InputError(fmt::format("image {} has {} levels; {} x {} texels allow 1 to {}", index, image.levels,
                                     image.width, image.height, mostLevels));
    const auto side = static_cast<uint32_t>(std::max(image.width, image.height));
    if (side > limits.maxImageDimension2D)
        throw EnvironmentError(fmt::format("image {} is {} x {}; this device allows {} a side", index, image.width,
                                           image.height, limits.maxImageDimension2D));
}

std::vector<ByteRange> layOutImage(const ImageDesc& image, size_t index, const VkPhysicalDeviceLimits& limits,
                                   VkDeviceSize& total)
{
    checkImage(image, index, limits);
    const VkDeviceSize texelBytes = static_cast<VkDeviceSize>(image.channels) * kScalarBytes;
    const VkDeviceSize alignment = std::max(texelBytes, limits.optimalBufferCopyOffsetAlignment);
    std::vector<ByteRange> levels;
    size_t scalars = 0;
    for (int level = 0; level < image.levels; ++level) {
        const VkDeviceSize texels = VkDeviceSize{levelExtent(image.width, level)} * levelExtent(image.height, level);
        levels.push_back(take(total, texels * texelBytes, alignUp(alignment, texelBytes)));
        scalars += texels * static_cast<size_t>(image.channels);
    }
    if (image.texels.size() != scalars)
        throw InputError(
            fmt::format("image {} has {} values; its levels hold {}", index, image.texels.size(), scalars));
    return levels;
}

ByteRange layOutUniform(const BufferDesc& buffer, size_t index, const VkPhysicalDeviceLimits& limits,
                        VkDeviceSize& total)
{
    if (buffer.bytes.empty()) throw InputError(fmt::format("buffer {}: a uniform buffer without content", index));
    if (buffer.bytes.size() > limits.maxUniformBufferRange)
        throw EnvironmentError(fmt::format("buffer {}: {} bytes of uniforms; this device allows {}", index,
                                           buffer.bytes.size(), limits.maxUniformBufferRange));
    // A block ends on a multiple of 16 bytes in std140, whatever its last member is.
    return take(total, alignUp(buffer.bytes.size(), 16),
                std::max<VkDeviceSize>(limits.minUniformBufferOffsetAlignment, 16));
}

ByteRange layOutStorage(const BufferDesc& buffer, size_t index, const VkPhysicalDeviceLimits& limits,
                        VkDeviceSize& total)
{
    if (buffer.scalarCount == 0) throw InputError(fmt::format("buffer {}: a storage buffer without scalars", index));
    if (buffer.scalarCount > limits.maxStorageBufferRange / kScalarBytes)
        throw EnvironmentError(fmt::format("buffer {}: {} scalars of storage; this device allows {}", index,
                                           buffer.scalarCount, limits.maxStorageBufferRange / kScalarBytes));
    return take(total, buffer.scalarCount * kScalarBytes,
                std::max<VkDeviceSize>(limits.minStorageBufferOffsetAlignment, 16));
}

void checkIndices(const Job& job)
{
    for (size_t i = 0; i < job.programs.size(); ++i)
        if (job.programs[i].key.empty()) throw InputError(fmt::format("program {} has no key", i));
    for (size_t i = 0; i < job.dispatches.size(); ++i) {
        const DispatchDesc& dispatch = job.dispatches[i];
        if (dispatch.program >= job.programs.size())
            throw InputError(fmt::format("dispatch {}: program {} of {}", i, dispatch.program, job.programs.size()));
        for (const Binding& binding : dispatch.bindings) {
            const bool isImage = binding.what == Binding::What::kImage;
            const size_t count = isImage ? job.images.size() : job.buffers.size();
            if (binding.index >= count)
                throw InputError(fmt::format("dispatch {}, binding {}: {} {} of {}", i, binding.binding,
                                             isImage ? "image" : "buffer", binding.index, count));
        }
    }
    for (const size_t index : job.readbacks)
        if (index >= job.buffers.size() || job.buffers[index].kind != BufferKind::kStorage)
            throw InputError(fmt::format("readback of buffer {}, which is no storage buffer of the job", index));
}

void checkGroups(const Job& job, const VkPhysicalDeviceLimits& limits)
{
    for (size_t i = 0; i < job.dispatches.size(); ++i) {
        const DispatchDesc& dispatch = job.dispatches[i];
        const std::array groups{dispatch.groupsX, dispatch.groupsY, dispatch.groupsZ};
        for (size_t axis = 0; axis < groups.size(); ++axis)
            if (groups[axis] < 1 || groups[axis] > limits.maxComputeWorkGroupCount[axis])
                throw EnvironmentError(fmt::format("dispatch {}: {} groups in {}; this device allows 1 to {}", i,
                                                   groups[axis], "xyz"[axis], limits.maxComputeWorkGroupCount[axis]));
    }
}

DescriptorKind kindOf(const Job& job, const Binding& binding)
{
    if (binding.what == Binding::What::kImage) return DescriptorKind::kSampledImage;
    return job.buffers[binding.index].kind == BufferKind::kUniform ? DescriptorKind::kUniformBuffer
                                                                   : DescriptorKind::kStorageBuffer;
}

} // namespace

uint32_t levelExtent(int size, int level)
{
    return static_cast<uint32_t>(std::max(1, size >> level));
}

JobLayout layOutJob(const Job& job, const VkPhysicalDeviceLimits& limits)
{
    checkIndices(job);
    checkGroups(job, limits);
    JobLayout layout;
    for (size_t i = 0; i < job.buffers.size(); ++i)
        layout.buffers.push_back(job.buffers[i].kind == BufferKind::kUniform
                                     ? layOutUniform(job.buffers[i], i, limits, layout.uploadBytes)
                                     : layOutStorage(job.buffers[i], i, limits, layout.storageBytes));
    for (size_t i = 0; i < job.images.size(); ++i)
        layout.images.push_back(layOutImage(job.images[i], i, limits, layout.uploadBytes));
    return layout;
}

std::vector<const Binding*> matchBindings(const Job& job, const DispatchDesc& dispatch, const SpirvInterface& interface)
{
    const std::string& entry = job.programs[dispatch.program].entry;
    std::vector<const Binding*> result;
    for (const SpirvBinding& wanted : interface.bindings) {
        const Binding* given = nullptr;
        for (const Binding& candidate : dispatch.bindings) {
            if (candidate.binding != wanted.binding) continue;
            if (given != nullptr)
                throw ShaderError(
                    fmt::format("{}: binding {} ({}) is given twice", entry, wanted.binding, wanted.name));
            given = &candidate;
        }
        if (given == nullptr)
            throw ShaderError(fmt::format("{}: binding {} ({}) wants {}, the job gives nothing", entry, wanted.binding,
                                          wanted.name, nameOf(wanted.kind)));
        if (const DescriptorKind kind = kindOf(job, *given); kind != wanted.kind)
            throw ShaderError(fmt::format("{}: binding {} ({}) wants {}, the job gives {}", entry, wanted.binding,
                                          wanted.name, nameOf(wanted.kind), nameOf(kind)));
        if (wanted.kind == DescriptorKind::kUniformBuffer && job.buffers[given->index].bytes.size() < wanted.bytes)
            throw ShaderError(fmt::format("{}: binding {} ({}) is a block of {} bytes, the job gives {}", entry,
                                          wanted.binding, wanted.name, wanted.bytes,
                                          job.buffers[given->index].bytes.size()));
        result.push_back(given);
    }
    return result;
}

} // namespace crossray::vulkan
