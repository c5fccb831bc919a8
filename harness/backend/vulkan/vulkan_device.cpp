#include "harness/backend/vulkan/vulkan_device.h"

#include "harness/backend/vulkan/context.h"
#include "harness/backend/vulkan/job_layout.h"
#include "harness/backend/vulkan/memory.h"
#include "harness/backend/vulkan/programs.h"
#include "harness/backend/vulkan/recorder.h"
#include "harness/base/stopwatch.h"

#include <algorithm>
#include <cstring>

namespace crossray {
namespace vulkan {
namespace {

SamplerHandle createSampler(VkDevice device, ImageFilter filter)
{
    const bool linear = filter == ImageFilter::kLinear;
    VkSamplerCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
    info.magFilter = info.minFilter = linear ? VK_FILTER_LINEAR : VK_FILTER_NEAREST;
    info.mipmapMode = linear ? VK_SAMPLER_MIPMAP_MODE_LINEAR : VK_SAMPLER_MIPMAP_MODE_NEAREST;
    info.addressModeU = info.addressModeV = info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    info.maxLod = VK_LOD_CLAMP_NONE;
    return makeHandle<SamplerHandle>(device, vkCreateSampler, info, "vkCreateSampler");
}

VkFormat formatOf(const ImageDesc& image)
{
    return image.channels == 1 ? VK_FORMAT_R32_SFLOAT : VK_FORMAT_R32G32B32A32_SFLOAT;
}

class VulkanDevice final : public Device {
  public:
    VulkanDevice(const std::string& backendName, const std::string& deviceName, bool validation,
                 const VulkanTuning& tuning);
    ~VulkanDevice() override;

    Fingerprint fingerprint() const override { return context_.describe(backendName_); }
    JobResult run(const Job& job) override;

  private:
    std::vector<const Program*> acquirePrograms(const Job& job, bool& allWarm);
    void writeUploads(const Job& job, const JobLayout& layout);
    void recordUploads(const Job& job, const JobLayout& layout);
    void recordDispatches(const Job& job, const JobLayout& layout, const std::vector<const Program*>& programs);
    Recorder::Resource describeResource(const Job& job, const JobLayout& layout, const Binding& binding) const;
    // Prepares the copy of what is read back where the device's own memory cannot be read.
    void recordReadbacks(const Job& job, const JobLayout& layout);
    bool readsDirectly() const { return storage_.canBeRead() && !tuning_.alwaysStage; }
    std::vector<std::vector<double>> readBack(const Job& job, const JobLayout& layout) const;

    std::string backendName_;
    VulkanTuning tuning_;
    Context context_;
    ProgramCache programs_;
    Arena uploads_, storage_, readbacks_;
    ImagePool imagePool_;
    SamplerHandle nearest_, linear_;
    Recorder recorder_;
    std::vector<const ImagePool::Image*> images_; // of the job that runs, by Job::images
};

VulkanDevice::VulkanDevice(const std::string& backendName, const std::string& deviceName, bool validation,
                           const VulkanTuning& tuning)
    : backendName_(backendName), tuning_(tuning), context_(deviceName, validation),
      programs_(context_, tuning.programCapacity),
      uploads_(context_, "uniforms and texels", VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT,
               MemoryUse::kUpload),
      storage_(context_, "storage buffers",
               VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
               MemoryUse::kDevice),
      readbacks_(context_, "readbacks", VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryUse::kReadback), imagePool_(context_),
      nearest_(createSampler(context_.device(), ImageFilter::kNearest)),
      linear_(createSampler(context_.device(), ImageFilter::kLinear)), recorder_(context_)
{
}

// An error may have left work in the queue, and what it uses is about to be destroyed.
VulkanDevice::~VulkanDevice()
{
    vkDeviceWaitIdle(context_.device());
}

JobResult VulkanDevice::run(const Job& job)
{
    JobResult result;
    const JobLayout layout = layOutJob(job, context_.limits());
    Stopwatch watch;
    programs_.trim(); // what an earlier job left beyond the capacity
    const std::vector<const Program*> programs = acquirePrograms(job, result.programsWereWarm);
    result.times.program = watch.lap();

    writeUploads(job, layout);
    recordUploads(job, layout);
    recordDispatches(job, layout, programs);
    recordReadbacks(job, layout);
    result.times.upload = watch.lap();

    recorder_.submitAndWait();
    result.times.dispatch = watch.lap();

    result.readbacks = readBack(job, layout);
    result.times.readback = watch.lap();
    result.times.device = recorder_.deviceMilliseconds();
    result.messages = context_.messages().take();
    return result;
}

std::vector<const Program*> VulkanDevice::acquirePrograms(const Job& job, bool& allWarm)
{
    std::vector<const Program*> result;
    allWarm = true;
    for (const ProgramSource& source : job.programs) {
        bool warm = false;
        result.push_back(&programs_.acquire(source, warm));
        allWarm = allWarm && warm;
    }
    return result;
}

void VulkanDevice::writeUploads(const Job& job, const JobLayout& layout)
{
    uploads_.reserve(layout.uploadBytes);
    storage_.reserve(layout.storageBytes);
    for (size_t i = 0; i < job.buffers.size(); ++i) {
        if (job.buffers[i].kind != BufferKind::kUniform) continue;
        const auto& bytes = job.buffers[i].bytes;
        std::byte* target = uploads_.mapped() + layout.buffers[i].offset;
        std::memcpy(target, bytes.data(), bytes.size());
        std::memset(target + bytes.size(), 0, layout.buffers[i].size - bytes.size());
    }
    for (size_t i = 0; i < job.images.size(); ++i) {
        const double* source = job.images[i].texels.data();
        for (const ByteRange& level : layout.images[i]) {
            float* target = reinterpret_cast<float*>(uploads_.mapped() + level.offset);
            const size_t count = level.size / sizeof(float);
            std::transform(source, source + count, target, [](double value) { return static_cast<float>(value); });
            source += count;
        }
    }
}

void VulkanDevice::recordUploads(const Job& job, const JobLayout& layout)
{
    size_t bindingCount = 0;
    for (const DispatchDesc& dispatch : job.dispatches)
        bindingCount += dispatch.bindings.size();
    recorder_.start(static_cast<uint32_t>(job.dispatches.size()), static_cast<uint32_t>(bindingCount));
    if (layout.storageBytes > 0) recorder_.clearBuffer(storage_.buffer(), layout.storageBytes);

    imagePool_.startJob();
    images_.clear();
    for (size_t i = 0; i < job.images.size(); ++i) {
        const ImageDesc& desc = job.images[i];
        context_.requireSampling(formatOf(desc), desc.filter);
        const ImageShape shape{levelExtent(desc.width, 0), levelExtent(desc.height, 0),
                               static_cast<uint32_t>(desc.levels), formatOf(desc)};
        images_.push_back(&imagePool_.acquire(shape));
        std::vector<VkBufferImageCopy> copies;
        for (int level = 0; level < desc.levels; ++level) {
            VkBufferImageCopy copy{};
            copy.bufferOffset = layout.images[i][static_cast<size_t>(level)].offset;
            copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, static_cast<uint32_t>(level), 0, 1};
            copy.imageExtent = {levelExtent(desc.width, level), levelExtent(desc.height, level), 1};
            copies.push_back(copy);
        }
        recorder_.uploadImage(uploads_.buffer(), images_.back()->image.get(), copies);
    }
}

void VulkanDevice::recordDispatches(const Job& job, const JobLayout& layout,
                                    const std::vector<const Program*>& programs)
{
    recorder_.beginDispatches();
    for (const DispatchDesc& dispatch : job.dispatches) {
        const Program& program = *programs[dispatch.program];
        std::vector<Recorder::Resource> resources;
        for (const Binding* binding : matchBindings(job, dispatch, program.interface))
            resources.push_back(describeResource(job, layout, *binding));
        recorder_.dispatch(program, resources, {dispatch.groupsX, dispatch.groupsY, dispatch.groupsZ});
    }
    recorder_.endDispatches();
}

Recorder::Resource VulkanDevice::describeResource(const Job& job, const JobLayout& layout, const Binding& binding) const
{
    Recorder::Resource resource;
    if (binding.what == Binding::What::kImage) {
        const bool linear = job.images[binding.index].filter == ImageFilter::kLinear;
        resource.image = {linear ? linear_.get() : nearest_.get(), images_[binding.index]->view.get(),
                          VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    } else {
        const bool uniform = job.buffers[binding.index].kind == BufferKind::kUniform;
        const ByteRange& range = layout.buffers[binding.index];
        resource.buffer = {uniform ? uploads_.buffer() : storage_.buffer(), range.offset, range.size};
    }
    return resource;
}

void VulkanDevice::recordReadbacks(const Job& job, const JobLayout& layout)
{
    if (readsDirectly() || job.readbacks.empty()) return;
    std::vector<VkBufferCopy> regions;
    VkDeviceSize total = 0;
    for (const size_t index : job.readbacks) {
        const ByteRange& range = layout.buffers[index];
        regions.push_back({range.offset, total, range.size});
        total += range.size;
    }
    readbacks_.reserve(total);
    recorder_.copyBuffer(storage_.buffer(), readbacks_.buffer(), regions);
}

std::vector<std::vector<double>> VulkanDevice::readBack(const Job& job, const JobLayout& layout) const
{
    std::vector<std::vector<double>> result;
    VkDeviceSize staged = 0;
    for (const size_t index : job.readbacks) {
        const ByteRange& range = layout.buffers[index];
        const std::byte* source = readsDirectly() ? storage_.mapped() + range.offset
                                                  : readbacks_.mapped() + std::exchange(staged, staged + range.size);
        const float* values = reinterpret_cast<const float*>(source);
        result.emplace_back(values, values + range.size / sizeof(float));
    }
    return result;
}

std::string impliedDeviceName(const std::string& backendName)
{
    const std::string prefix = "vulkan:";
    if (backendName.starts_with(prefix)) return backendName.substr(prefix.size());
    if (backendName == "lavapipe") return "llvmpipe";
    if (backendName == "swiftshader") return "SwiftShader";
    return {};
}

} // namespace
} // namespace vulkan

std::unique_ptr<Device> makeVulkanDevice(const std::string& backendName, const DeviceOptions& options,
                                         const VulkanTuning& tuning)
{
    const std::string deviceName =
        options.vulkanDeviceName.empty() ? vulkan::impliedDeviceName(backendName) : options.vulkanDeviceName;
    return std::make_unique<vulkan::VulkanDevice>(backendName, deviceName, options.validation, tuning);
}

} // namespace crossray
