// What the two translation units of the passes (float, double) offer to the CPU device.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace crossray {

// Level 0 of an image, or a storage buffer, in the precision of the kernel.
template <class Real>
struct CpuResource {
    Real* values = nullptr;
    int width = 0, height = 0, channels = 1; // images
    size_t scalarCount = 0;
};

inline constexpr uint32_t kMaxCpuBindings = 32;

// Bound resources by binding number; uniform blocks are bytes.
template <class Real>
struct CpuBindings {
    CpuResource<Real> resources[kMaxCpuBindings];
    std::span<const std::byte> uniforms[kMaxCpuBindings];
};

template <class Real>
struct CpuKernel {
    std::string_view entry;
    uint32_t localSizeX, localSizeY;
    void (*bind)(const CpuBindings<Real>& bindings);
    void (*invoke)(int x, int y); // one invocation, by its global id
};

// One TU a precision: kernels32.cpp, kernels64.cpp. State is per thread.
namespace cpu32 {
std::span<const CpuKernel<float>> kernels();
bool setVariant(std::string_view name, double value); // false: no such constant
void resetVariants();
} // namespace cpu32
namespace cpu64 {
std::span<const CpuKernel<double>> kernels();
bool setVariant(std::string_view name, double value);
void resetVariants();
} // namespace cpu64

} // namespace crossray
