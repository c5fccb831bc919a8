// Device on Vulkan 1.1 compute: lavapipe, SwiftShader, or any other driver by the device's name.
#pragma once

#include "harness/backend/device.h"

#include <memory>
#include <string>

namespace crossray {

// Knobs that only tests and measurements turn.
struct VulkanTuning {
    size_t programCapacity = 512; // programs kept for later jobs
    bool alwaysStage = false;     // copy results to a readback buffer even where the device's own memory can be mapped
};

// Opens the first device whose name contains options.vulkanDeviceName; where that is empty, the name that the backend
// implies: "lavapipe" -> "llvmpipe", "swiftshader" -> "SwiftShader", "vulkan:NAME" -> "NAME", anything else -> the
// first device. The environment that chooses the drivers (VK_ICD_FILENAMES) must be set before. Throws EnvironmentError
// that lists the devices found when none matches, and when options.validation asks for a layer that is not installed.
std::unique_ptr<Device> makeVulkanDevice(const std::string& backendName, const DeviceOptions& options,
                                         const VulkanTuning& tuning = {});

} // namespace crossray
