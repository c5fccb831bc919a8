// What the driver can bind and run at once, read when the context is made.
#pragma once

#include <array>
#include <cstdint>

namespace crossray {

struct GlLimits {
    int64_t storageBlocks = 0;   // in one compute shader
    int64_t storageBindings = 0; // binding numbers are below this
    int64_t storageBytes = 0;    // of one block
    int64_t uniformBindings = 0;
    int64_t uniformBytes = 0;
    int64_t textureUnits = 0;
    int64_t textureSide = 0;
    int64_t groupInvocations = 0;
    std::array<int64_t, 3> groupSize{};
    std::array<int64_t, 3> groupCount{};
};

// Of the current context.
GlLimits readGlLimits();

} // namespace crossray
