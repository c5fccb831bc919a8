// A cubemap as an image: what a reflection probe or a sky shows by direction. Faces in the order +x, -x, +y, -y, +z,
// -z; row 0 of each face is at v = 0 and texel (x, y) has its centre at u = (x + 0.5) / size, v = (y + 0.5) / size, as
// the cube map tables of OpenGL and Vulkan have it (shaders/crossray/probe/cubemap.glsl).
#pragma once

#include <glm/glm.hpp>

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <filesystem>
#include <vector>

namespace crossray {

inline constexpr int kCubeFaces = 6;
inline constexpr int kMaxCubeSize = 2048; // texels a side

// Linear RGB radiance. Level l has max(1, size >> l) texels a side; level 0 first.
struct Cubemap {
    int size = 0;
    std::vector<std::vector<glm::dvec3>> levels; // each: face after face, row after row

    Cubemap() = default;
    Cubemap(int size_, int levelCount, const glm::dvec3& fill = glm::dvec3(0.0)) : size(size_)
    {
        for (int level = 0; level < levelCount; ++level) {
            const auto side = static_cast<size_t>(sizeOf(level));
            levels.emplace_back(kCubeFaces * side * side, fill);
        }
    }

    int levelCount() const { return static_cast<int>(levels.size()); }
    int sizeOf(int level) const { return std::max(1, size >> level); }
    size_t index(int level, int face, int x, int y) const
    {
        const int side = sizeOf(level);
        assert(face >= 0 && face < kCubeFaces && x >= 0 && x < side && y >= 0 && y < side);
        return (static_cast<size_t>(face) * static_cast<size_t>(side) + static_cast<size_t>(y)) *
                   static_cast<size_t>(side) +
               static_cast<size_t>(x);
    }
    glm::dvec3& at(int level, int face, int x, int y)
    {
        return levels[static_cast<size_t>(level)][index(level, face, x, y)];
    }
    const glm::dvec3& at(int level, int face, int x, int y) const
    {
        return levels[static_cast<size_t>(level)][index(level, face, x, y)];
    }
};

// A power of two, 1 to kMaxCubeSize: the sizes of what is captured, baked and read.
bool isCubeSize(int size);
void requireCubeSize(int size); // throws InputError otherwise

struct CubeFacePosition {
    int face = 0;
    glm::dvec2 uv{0.5}; // [0,1] over the face: u to the right, v down
};

// Unit direction of a point of a face.
glm::dvec3 computeCubeDirection(int face, const glm::dvec2& uv);
// Where a direction of any length above 0 points to. Of equal components z wins over y, and y over x.
CubeFacePosition findCubePosition(const glm::dvec3& dir);
// The texel that a direction of any length above 0 falls into.
const glm::dvec3& nearestTexel(const Cubemap& cubemap, const glm::dvec3& dir, int level = 0);

// Replaces all levels above 0 by means of 2x2 texels, each within its face, down to 1x1. The size is a power of two.
void buildMipLevels(Cubemap& cubemap);

// A cubemap file: OpenEXR with either one image (channels R, G and B, whatever the part's name), the six faces below
// one another in their order, from which the levels are built; or such images as the parts Level0, Level1 and so on,
// the whole chain down to 1x1. Throws InputError (file: what, what is allowed) on any other shape or size.
Cubemap readCubemap(const std::filesystem::path& file);
// All levels, a part each, rounded to float. Written aside and renamed.
void writeCubemap(const std::filesystem::path& file, const Cubemap& cubemap);

} // namespace crossray
