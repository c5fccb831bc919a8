// What a compute shader's SPIR-V asks of its surroundings, read from the code itself: the descriptor bindings that its
// functions use, its group size and its shared memory.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace crossray::vulkan {

enum class DescriptorKind { kSampledImage, kUniformBuffer, kStorageBuffer };
std::string_view nameOf(DescriptorKind kind); // "a sampled image", "a uniform buffer", "a storage buffer"

struct SpirvBinding {
    uint32_t binding = 0;
    DescriptorKind kind = DescriptorKind::kStorageBuffer;
    std::string name;   // of the variable or its block; "" when the code carries no names
    uint64_t bytes = 0; // uniform buffers: the end of the block's last member by the offsets in the code; else 0
};

struct SpirvInterface {
    std::vector<SpirvBinding> bindings; // by rising number; what is declared but not used is left out
    std::array<uint32_t, 3> localSize{1, 1, 1};
    uint64_t sharedBytes = 0; // sum of the shared variables, without the driver's padding
};

// Throws ShaderError when the words are no whole SPIR-V module with a compute entry point "main", and on what these
// devices do not offer: descriptor sets other than 0, two used variables at one binding, arrays of descriptors, push
// constants, images other than sampler2D.
SpirvInterface readSpirvInterface(std::span<const uint32_t> words);

} // namespace crossray::vulkan
