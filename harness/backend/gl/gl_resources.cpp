#include "harness/backend/gl/gl_resources.h"

#include "harness/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace crossray {
namespace {

constexpr size_t kIdleBytes = size_t{32} << 20;
constexpr size_t kIdleNames = 256;          // of each kind
constexpr size_t kScratchFloats = 1u << 20; // what a large image leaves behind is released
constexpr size_t kSmallestBuffer = 256;

size_t levelSide(int side, int level)
{
    return static_cast<size_t>(std::max(1, side >> level));
}

size_t countTexels(const ImageDesc& desc)
{
    size_t texels = 0;
    for (int level = 0; level < desc.levels; ++level)
        texels += levelSide(desc.width, level) * levelSide(desc.height, level);
    return texels;
}

void checkImage(const ImageDesc& desc, const GlLimits& limits)
{
    if (desc.width < 1 || desc.height < 1 || desc.width > limits.textureSide || desc.height > limits.textureSide)
        throw InputError(fmt::format("an image of {}x{} texels: this OpenGL driver allows 1x1 to {}x{}", desc.width,
                                     desc.height, limits.textureSide, limits.textureSide));
    if (desc.channels != 1 && desc.channels != 3 && desc.channels != 4)
        throw InputError(fmt::format("an image of {} channels: 1, 3 or 4 are allowed", desc.channels));
    const auto most = std::bit_width(static_cast<unsigned>(std::max(desc.width, desc.height)));
    if (desc.levels < 1 || desc.levels > static_cast<int>(most))
        throw InputError(fmt::format("an image of {}x{} with {} levels: 1 to {} are allowed", desc.width, desc.height,
                                     desc.levels, most));
    const size_t expected = countTexels(desc) * static_cast<size_t>(desc.channels);
    if (desc.texels.size() != expected)
        throw InputError(fmt::format("an image of {}x{} with {} channels and {} levels holds {} numbers, not {}",
                                     desc.width, desc.height, desc.channels, desc.levels, expected,
                                     desc.texels.size()));
}

void checkMemory(const std::string& what)
{
    if (glGetError() == GL_OUT_OF_MEMORY) throw EnvironmentError("OpenGL is out of memory for " + what);
}

} // namespace

bool GlImage::fits(const ImageDesc& desc) const
{
    return width == desc.width && height == desc.height && levels == desc.levels &&
           (channels == 1) == (desc.channels == 1);
}

GlImage GlResourcePool::findIdleImage(const ImageDesc& desc)
{
    const auto found =
        std::find_if(idleImages_.begin(), idleImages_.end(), [&](const GlImage& image) { return image.fits(desc); });
    if (found == idleImages_.end()) return {};
    GlImage image = std::move(*found);
    idleImages_.erase(found);
    idleBytes_ -= image.bytes;
    return image;
}

GlBuffer GlResourcePool::findIdleBuffer(size_t capacity)
{
    const auto found = std::find_if(idleBuffers_.begin(), idleBuffers_.end(),
                                    [&](const GlBuffer& buffer) { return buffer.capacity == capacity; });
    if (found == idleBuffers_.end()) return {};
    GlBuffer buffer = std::move(*found);
    idleBuffers_.erase(found);
    idleBytes_ -= buffer.capacity;
    return buffer;
}

GlImage GlResourcePool::takeImage(const ImageDesc& desc)
{
    checkImage(desc, limits_);
    GlImage image = findIdleImage(desc);
    if (!image.name.id()) {
        GLuint id = 0;
        glCreateTextures(GL_TEXTURE_2D, 1, &id);
        image.name = GlTextureName(id);
        image.width = desc.width;
        image.height = desc.height;
        image.channels = desc.channels == 1 ? 1 : 4;
        image.levels = desc.levels;
        image.bytes = countTexels(desc) * static_cast<size_t>(image.channels) * sizeof(float);
        glTextureStorage2D(id, desc.levels, image.channels == 1 ? GL_R32F : GL_RGBA32F, desc.width, desc.height);
        checkMemory(fmt::format("an image of {}x{} with {} channels", desc.width, desc.height, image.channels));
    }
    upload(image, desc);
    return image;
}

void GlResourcePool::upload(const GlImage& image, const ImageDesc& desc)
{
    scratch_.resize(countTexels(desc) * static_cast<size_t>(image.channels));
    if (desc.channels == image.channels) {
        std::transform(desc.texels.begin(), desc.texels.end(), scratch_.begin(),
                       [](double value) { return static_cast<float>(value); });
    } else {
        for (size_t texel = 0; texel * 3 < desc.texels.size(); ++texel) {
            for (size_t channel = 0; channel < 3; ++channel)
                scratch_[texel * 4 + channel] = static_cast<float>(desc.texels[texel * 3 + channel]);
            scratch_[texel * 4 + 3] = 1.0f;
        }
    }
    const float* texels = scratch_.data();
    for (int level = 0; level < desc.levels; ++level) {
        const size_t width = levelSide(desc.width, level);
        const size_t height = levelSide(desc.height, level);
        glTextureSubImage2D(image.name.id(), level, 0, 0, static_cast<GLsizei>(width), static_cast<GLsizei>(height),
                            image.channels == 1 ? GL_RED : GL_RGBA, GL_FLOAT, texels);
        texels += width * height * static_cast<size_t>(image.channels);
    }
}

GlBuffer GlResourcePool::takeBuffer(const BufferDesc& desc)
{
    const bool uniform = desc.kind == BufferKind::kUniform;
    const int64_t most = uniform ? limits_.uniformBytes : limits_.storageBytes;
    const size_t asked = uniform ? desc.bytes.size() : desc.scalarCount;
    if (asked > static_cast<size_t>(most) / (uniform ? 1 : sizeof(float)))
        throw InputError(fmt::format("a {} buffer of {} {}: this OpenGL driver allows {} bytes",
                                     uniform ? "uniform" : "storage", asked, uniform ? "bytes" : "floats", most));

    size_t bytes = uniform ? desc.bytes.size() : desc.scalarCount * sizeof(float);
    bytes = std::max(bytes, sizeof(float)); // an empty range cannot be bound
    if (uniform) bytes = roundUpToVec4(bytes);
    const size_t capacity = std::max(kSmallestBuffer, std::bit_ceil(bytes));
    GlBuffer buffer = findIdleBuffer(capacity);
    if (!buffer.name.id()) {
        GLuint id = 0;
        glCreateBuffers(1, &id);
        buffer.name = GlBufferName(id);
        buffer.capacity = capacity;
        glNamedBufferStorage(id, static_cast<GLsizeiptr>(capacity), nullptr, GL_DYNAMIC_STORAGE_BIT);
        checkMemory(fmt::format("a buffer of {} bytes", capacity));
    }
    buffer.kind = desc.kind;
    buffer.scalarCount = uniform ? 0 : desc.scalarCount;
    buffer.bytes = bytes;
    const GLuint id = buffer.name.id();
    glClearNamedBufferSubData(id, GL_R32UI, 0, static_cast<GLsizeiptr>(bytes), GL_RED_INTEGER, GL_UNSIGNED_INT,
                              nullptr);
    if (uniform && !desc.bytes.empty())
        glNamedBufferSubData(id, 0, static_cast<GLsizeiptr>(desc.bytes.size()), desc.bytes.data());
    return buffer;
}

std::vector<double> GlResourcePool::read(const GlBuffer& buffer)
{
    scratch_.resize(buffer.scalarCount);
    if (!scratch_.empty())
        glGetNamedBufferSubData(buffer.name.id(), 0, static_cast<GLsizeiptr>(buffer.scalarCount * sizeof(float)),
                                scratch_.data());
    return {scratch_.begin(), scratch_.end()};
}

void GlResourcePool::giveBack(GlImage image)
{
    idleBytes_ += image.bytes;
    idleImages_.push_back(std::move(image));
    trim();
}

void GlResourcePool::giveBack(GlBuffer buffer)
{
    idleBytes_ += buffer.capacity;
    idleBuffers_.push_back(std::move(buffer));
    trim();
}

// Images go first: they are the large ones, and a buffer's capacity fits more jobs than an image's exact shape.
void GlResourcePool::trim()
{
    while (!idleImages_.empty() && (idleBytes_ > kIdleBytes || idleImages_.size() > kIdleNames)) {
        idleBytes_ -= idleImages_.front().bytes;
        idleImages_.pop_front();
    }
    while (!idleBuffers_.empty() && (idleBytes_ > kIdleBytes || idleBuffers_.size() > kIdleNames)) {
        idleBytes_ -= idleBuffers_.front().capacity;
        idleBuffers_.pop_front();
    }
    if (scratch_.capacity() > kScratchFloats) scratch_ = {};
}

} // namespace crossray
