#include "harness/scene/cubemap.h"

#include "harness/base/error.h"
#include "harness/scene/exr.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <string>
#include <vector>

namespace crossray {

namespace {

// A face seen from inside the cube: the way to its middle, and where its image's u and v run.
struct FaceAxes {
    glm::dvec3 middle;
    glm::dvec3 right;
    glm::dvec3 down;
};

const FaceAxes& axesOf(int face)
{
    static const std::array<FaceAxes, kCubeFaces> kAxes = {{
        {{1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
        {{-1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
        {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
        {{0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
        {{0, 0, 1}, {1, 0, 0}, {0, -1, 0}},
        {{0, 0, -1}, {-1, 0, 0}, {0, -1, 0}},
    }};
    return kAxes.at(static_cast<size_t>(face));
}

std::string partName(int level)
{
    return fmt::format("Level{}", level);
}

class CubemapReader {
  public:
    explicit CubemapReader(const std::filesystem::path& file) : file_(file), channels_(readExrChannels(file)) {}

    Cubemap read() const { return channels_.contains("Level1.R") ? readChain() : readSingle(); }

  private:
    Cubemap readSingle() const
    {
        // One image is one part: its channels bear its name, or none.
        std::string prefix = channels_.begin()->first;
        prefix.erase(prefix.rfind('.') == std::string::npos ? 0 : prefix.rfind('.') + 1);
        for (const auto& [name, plane] : channels_)
            if (!name.starts_with(prefix) || name.find('.', prefix.size()) != std::string::npos)
                fail(fmt::format("it has several parts, such as that of the channel {}", name));
        Cubemap cubemap;
        cubemap.size = requireStrip(prefix);
        cubemap.levels.push_back(readStrip(prefix));
        buildMipLevels(cubemap);
        return cubemap;
    }

    Cubemap readChain() const
    {
        Cubemap cubemap;
        cubemap.size = requireStrip("Level0.");
        for (int level = 0; level == 0 || cubemap.sizeOf(level - 1) > 1; ++level) {
            const std::string prefix = partName(level) + ".";
            if (requireStrip(prefix) != cubemap.sizeOf(level))
                fail(fmt::format("{} is {} texels wide after {}", partName(level), requireStrip(prefix),
                                 cubemap.sizeOf(level - 1)));
            cubemap.levels.push_back(readStrip(prefix));
        }
        return cubemap;
    }

    int requireStrip(const std::string& prefix) const
    {
        const Plane& red = channel(prefix + "R");
        if (!isCubeSize(red.width) || red.height != kCubeFaces * red.width)
            fail(fmt::format("an image of {}x{}", red.width, red.height));
        return red.width;
    }

    std::vector<glm::dvec3> readStrip(const std::string& prefix) const
    {
        const Plane& red = channel(prefix + "R");
        const Plane& green = channel(prefix + "G");
        const Plane& blue = channel(prefix + "B");
        std::vector<glm::dvec3> texels(red.pixelCount());
        for (size_t i = 0; i < texels.size(); ++i)
            texels[i] = {red.values[i], green.values[i], blue.values[i]};
        return texels;
    }

    const Plane& channel(const std::string& name) const
    {
        const auto found = channels_.find(name);
        if (found == channels_.end()) fail(fmt::format("no channel {}", name));
        return found->second;
    }

    [[noreturn]] void fail(const std::string& what) const
    {
        throw InputError(
            {file_.string(), 0, 0},
            fmt::format("no cubemap: {}; allowed: one RGB image of six square faces below one another (+x, "
                        "-x, +y, -y, +z, -z), a power of two from 1 to {} wide, or such images as the parts "
                        "Level0, Level1, ..., each half as wide, down to 1",
                        what, kMaxCubeSize));
    }

    std::filesystem::path file_;
    std::map<std::string, Plane> channels_;
};

} // namespace

glm::dvec3 computeCubeDirection(int face, const glm::dvec2& uv)
{
    const FaceAxes& axes = axesOf(face);
    return glm::normalize(axes.middle + (2.0 * uv.x - 1.0) * axes.right + (2.0 * uv.y - 1.0) * axes.down);
}

CubeFacePosition findCubePosition(const glm::dvec3& dir)
{
    const glm::dvec3 size = glm::abs(dir);
    int axis = size.y >= size.x ? 1 : 0;
    if (size.z >= size[axis]) axis = 2;
    CubeFacePosition position;
    position.face = 2 * axis + (dir[axis] > 0.0 ? 0 : 1);
    const FaceAxes& axes = axesOf(position.face);
    const glm::dvec2 st = glm::dvec2(glm::dot(dir, axes.right), glm::dot(dir, axes.down)) / size[axis];
    position.uv = glm::clamp(0.5 * st + 0.5, 0.0, 1.0);
    return position;
}

const glm::dvec3& nearestTexel(const Cubemap& cubemap, const glm::dvec3& dir, int level)
{
    const CubeFacePosition position = findCubePosition(dir);
    const int side = cubemap.sizeOf(level);
    const auto cell = [&](double t) { return std::min(static_cast<int>(t * side), side - 1); };
    return cubemap.at(level, position.face, cell(position.uv.x), cell(position.uv.y));
}

bool isCubeSize(int size)
{
    return size >= 1 && size <= kMaxCubeSize && std::has_single_bit(static_cast<unsigned>(size));
}

void requireCubeSize(int size)
{
    if (!isCubeSize(size))
        throw InputError(
            fmt::format("a cubemap of {} texels a side; allowed: a power of two from 1 to {}", size, kMaxCubeSize));
}

void buildMipLevels(Cubemap& cubemap)
{
    requireCubeSize(cubemap.size);
    cubemap.levels.resize(1);
    for (int level = 1; cubemap.sizeOf(level - 1) > 1; ++level) {
        const int side = cubemap.sizeOf(level);
        cubemap.levels.emplace_back(static_cast<size_t>(kCubeFaces * side * side));
        for (int face = 0; face < kCubeFaces; ++face)
            for (int y = 0; y < side; ++y)
                for (int x = 0; x < side; ++x) {
                    glm::dvec3 sum(0.0);
                    for (int part = 0; part < 4; ++part)
                        sum += cubemap.at(level - 1, face, 2 * x + part % 2, 2 * y + part / 2);
                    cubemap.at(level, face, x, y) = 0.25 * sum;
                }
    }
}

Cubemap readCubemap(const std::filesystem::path& file)
{
    return CubemapReader(file).read();
}

void writeCubemap(const std::filesystem::path& file, const Cubemap& cubemap)
{
    std::vector<Plane> planes;
    for (int level = 0; level < cubemap.levelCount(); ++level) {
        const int side = cubemap.sizeOf(level);
        planes.emplace_back(partName(level), side, kCubeFaces * side, 3);
        size_t at = 0;
        for (const glm::dvec3& texel : cubemap.levels[static_cast<size_t>(level)])
            for (int c = 0; c < 3; ++c)
                planes.back().values[at++] = texel[c];
    }
    writeExr(file, planes);
}

} // namespace crossray
