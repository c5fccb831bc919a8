// A cubemap as an image: what a reflection probe or a sky shows by direction. Faces in the order +x, -x, +y, -y, +z, -z;
// row 0 of each face is at v = 0 and texel (x, y) has its centre at u = (x + 0.5) / size, v = (y + 0.5) / size, as the
// cube map tables of OpenGL and Vulkan have it (shaders/crossray/probe/cubemap.glsl).
#pragma once

#include <glm/glm.hpp>

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <vector>

namespace crossray {

inline constexpr int kCubeFaces = 6;

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

} // namespace crossray
