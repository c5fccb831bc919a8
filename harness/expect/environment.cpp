#include "harness/expect/environment.h"

#include "harness/expect/captures.h"

#include <algorithm>
#include <bit>

namespace crossray {

namespace {

// Of an empty chain of the environment's size.
class EnvironmentFiller {
  public:
    EnvironmentFiller(int size, const Scene& scene)
        : scene_(scene), cubemap_(size, std::bit_width(static_cast<unsigned>(size)))
    {
    }

    Cubemap operator()(const SolidColor& solid)
    {
        for (std::vector<glm::dvec3>& level : cubemap_.levels)
            std::fill(level.begin(), level.end(), solid.color);
        return std::move(cubemap_);
    }

    Cubemap operator()(const FaceColors& faces)
    {
        std::vector<glm::dvec3>& finest = cubemap_.levels[0];
        for (size_t i = 0; i < finest.size(); ++i)
            finest[i] = faces.colors[i * faces.colors.size() / finest.size()];
        buildMipLevels(cubemap_);
        return std::move(cubemap_);
    }

    Cubemap operator()(const LevelColors& levels)
    {
        for (size_t level = 0; level < cubemap_.levels.size(); ++level) {
            std::vector<glm::dvec3>& texels = cubemap_.levels[level];
            std::fill(texels.begin(), texels.end(), levels.colors[std::min(level, levels.colors.size() - 1)]);
        }
        return std::move(cubemap_);
    }

    Cubemap operator()(const GradientColors& gradient)
    {
        Scene scene;
        scene.sky = gradient.sky;
        scene.upWS = scene_.upWS;
        for (int face = 0; face < kCubeFaces; ++face) {
            for (int y = 0; y < cubemap_.size; ++y) {
                for (int x = 0; x < cubemap_.size; ++x) {
                    const glm::dvec2 uv = (glm::dvec2(x, y) + 0.5) / static_cast<double>(cubemap_.size);
                    cubemap_.at(0, face, x, y) = computeSkyRadiance(scene, computeCubeDirection(face, uv));
                }
            }
        }
        buildMipLevels(cubemap_);
        return std::move(cubemap_);
    }

    // loadCubemap has these.
    Cubemap operator()(const CubemapFile&) { return std::move(cubemap_); }
    Cubemap operator()(const SceneCapture&) { return std::move(cubemap_); }

  private:
    const Scene& scene_;
    Cubemap cubemap_;
};

} // namespace

Cubemap makeEnvironment(const Case& testCase, const Environment& environment, const Probe* probe)
{
    if (std::optional<Cubemap> loaded = loadCubemap(testCase, environment, probe)) return std::move(*loaded);
    return std::visit(EnvironmentFiller(environment.size, testCase.scene), environment.content);
}

} // namespace crossray
