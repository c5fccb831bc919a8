// Where each resource of a job lies in the shared buffers. Pure arithmetic, no Vulkan call.
#pragma once

#include "harness/backend/device.h"
#include "harness/backend/vulkan/spirv_interface.h"

#include <vulkan/vulkan.h>

#include <vector>

namespace crossray::vulkan {

struct ByteRange {
    VkDeviceSize offset = 0, size = 0;
};

struct JobLayout {
    std::vector<ByteRange> buffers; // by Job::buffers: uniforms in the upload buffer, storage in the device's buffer
    std::vector<std::vector<ByteRange>> images; // by Job::images: each level in the upload buffer, packed as floats
    VkDeviceSize uploadBytes = 0, storageBytes = 0;
};

// Throws InputError when the job contradicts itself (an index out of range, texels that do not fill the levels, an
// empty buffer, a program without a key), EnvironmentError when a resource exceeds what the device allows.
JobLayout layOutJob(const Job& job, const VkPhysicalDeviceLimits& limits);

// The resource of each binding of the program, in the order of interface.bindings. What the program does not use may be
// given all the same. Throws ShaderError when a binding is missing, is given twice, is of another kind or is a block
// with too few bytes.
std::vector<const Binding*> matchBindings(const Job& job, const DispatchDesc& dispatch,
                                          const SpirvInterface& interface);

uint32_t levelExtent(int size, int level);

} // namespace crossray::vulkan
