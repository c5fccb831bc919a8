// Images and buffers of a job, taken from a pool: making a texture anew costs more than a small dispatch.
#pragma once

#include "harness/backend/device.h"
#include "harness/backend/gl/gl_handles.h"
#include "harness/backend/gl/gl_limits.h"

#include <cstddef>
#include <deque>
#include <vector>

namespace crossray {

// A texture of immutable storage: R32F for 1 channel, RGBA32F for 3 and 4.
struct GlImage {
    GlTextureName name;
    int width = 0, height = 0, channels = 0, levels = 0;
    size_t bytes = 0;

    bool fits(const ImageDesc& desc) const;
};

// `bytes` are what a shader may see, of a uniform buffer a whole number of vec4; the storage behind it may be larger.
struct GlBuffer {
    GlBufferName name;
    BufferKind kind = BufferKind::kStorage;
    size_t scalarCount = 0;
    size_t bytes = 0;
    size_t capacity = 0;
};

// Blocks are counted in whole vec4.
constexpr size_t roundUpToVec4(size_t bytes)
{
    return (bytes + 15) / 16 * 16;
}

// Uploads on taking, keeps on giving back. Idle storage is bounded; what exceeds it goes, the longest idle first.
class GlResourcePool {
  public:
    explicit GlResourcePool(const GlLimits& limits) : limits_(limits) {}

    // Throw InputError when the description contradicts itself or exceeds a limit, EnvironmentError when memory runs
    // out.
    GlImage takeImage(const ImageDesc& desc);
    GlBuffer takeBuffer(const BufferDesc& desc);
    void giveBack(GlImage image);
    void giveBack(GlBuffer buffer);
    // The scalars of a storage buffer.
    std::vector<double> read(const GlBuffer& buffer);

    size_t idleBytes() const { return idleBytes_; }

  private:
    GlImage findIdleImage(const ImageDesc& desc);
    GlBuffer findIdleBuffer(size_t capacity);
    void upload(const GlImage& image, const ImageDesc& desc);
    void trim();

    GlLimits limits_;
    std::deque<GlImage> idleImages_; // the longest idle first
    std::deque<GlBuffer> idleBuffers_;
    size_t idleBytes_ = 0;
    std::vector<float> scratch_;
};

} // namespace crossray
