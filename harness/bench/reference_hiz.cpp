// The march over a pyramid of nearest depths: Uludag 2014, "Hi-Z Screen-Space Cone-Traced Reflections", with the hit
// test that the description of AMD's FidelityFX SSSR gives: on screen, not at the start, facing the ray, and the ray at
// most the thickness behind.
#include "harness/bench/reference_path.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>

namespace crossray {

namespace {

constexpr double kIntoNextCell = 1.0 / 256; // pixels past the border, so that the next cell is the next one

struct NearestLevel {
    int width = 0, height = 0;
    std::vector<double> depths;
    double at(int x, int y) const
    {
        return depths[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)];
    }
};

struct NearestPyramid {
    DepthImage image;
    std::vector<NearestLevel> levels;
    explicit NearestPyramid(const YardstickScene& scene) : image(scene)
    {
        NearestLevel base{image.width(), image.height(), {}};
        for (int y = 0; y < base.height; ++y) {
            for (int x = 0; x < base.width; ++x)
                base.depths.push_back(image.depth(x, y));
        }
        levels.push_back(std::move(base));
        while (levels.back().width > 1 || levels.back().height > 1)
            levels.push_back(reduce(levels.back()));
    }

  private:
    static NearestLevel reduce(const NearestLevel& finer)
    {
        NearestLevel made{std::max(finer.width / 2, 1), std::max(finer.height / 2, 1), {}};
        for (int y = 0; y < made.height; ++y) {
            for (int x = 0; x < made.width; ++x) {
                double nearest = kNoLimit;
                const int endX = x == made.width - 1 ? finer.width : 2 * x + 2;
                const int endY = y == made.height - 1 ? finer.height : 2 * y + 2;
                for (int j = 2 * y; j < endY; ++j) {
                    for (int i = 2 * x; i < endX; ++i)
                        nearest = std::min(nearest, finer.at(i, j));
                }
                made.depths.push_back(nearest);
            }
        }
        return made;
    }
};

// t at which the ray is over the border of its cell, a little into the next.
double timeOverBorder(const ScreenPath& path, int level, const NearestLevel& cells, int cellX, int cellY,
                      const DepthImage& image)
{
    const auto border = [&](int cell, int count, int pixels, double delta) {
        if (delta < 0) return static_cast<double>(cell << level) - kIntoNextCell;
        return static_cast<double>(cell == count - 1 ? pixels : (cell + 1) << level) + kIntoNextCell;
    };
    double over = kNoLimit;
    if (path.deltaSS.x != 0) {
        const double x = border(cellX, cells.width, image.width(), path.deltaSS.x);
        over = std::min(over, (x - path.startSS.x) / path.deltaSS.x);
    }
    if (path.deltaSS.y != 0) {
        const double y = border(cellY, cells.height, image.height(), path.deltaSS.y);
        over = std::min(over, (y - path.startSS.y) / path.deltaSS.y);
    }
    return over;
}

TracerAnswer judgeEnd(const DepthImage& image, const YardstickRay& ray, const ScreenPath& path, double t,
                      double thickness, int fetches, int iterations)
{
    const glm::dvec2 end = path.positionSS(t);
    if (std::abs(end.x - path.startSS.x) < 2 && std::abs(end.y - path.startSS.y) < 2)
        return makeNoHit(fetches, iterations);
    const int x = std::clamp(static_cast<int>(end.x), 0, image.width() - 1);
    const int y = std::clamp(static_cast<int>(end.y), 0, image.height() - 1);
    const double surface = image.depth(x, y);
    const bool isSeen = std::isfinite(surface) && glm::dot(image.normalWS(x, y), ray.dirWS) <= 0;
    const bool isThin = std::abs(path.depth(t) - surface) <= thickness;
    if (!isSeen || !isThin) return makeNoHit(fetches + 1, iterations);
    return makeHit(path, t, fetches + 1, iterations);
}

TracerAnswer marchNearest(const NearestPyramid& pyramid, const YardstickRay& ray, double thickness, int maxIterations)
{
    const DepthImage& image = pyramid.image;
    const ScreenPath path = makeScreenPath(image, ray);
    if (!path.exists) return makeNoHit(0, 0);
    const int last = static_cast<int>(pyramid.levels.size()) - 1;
    double t = timeOverBorder(path, 0, pyramid.levels[0], ray.x, ray.y, image); // out of its own pixel
    int level = 0, fetches = 0, iterations = 0;
    while (level >= 0) {
        if (t >= path.end) return makeNoHit(fetches, iterations);
        if (iterations == maxIterations) return makeNoHit(fetches, iterations, true);
        ++iterations;
        const NearestLevel& cells = pyramid.levels[static_cast<size_t>(level)];
        const glm::dvec2 here = path.positionSS(t);
        const int x = std::clamp(static_cast<int>(here.x) >> level, 0, cells.width - 1);
        const int y = std::clamp(static_cast<int>(here.y) >> level, 0, cells.height - 1);
        ++fetches;
        const double surface = cells.at(x, y);
        const double over = timeOverBorder(path, level, cells, x, y, image);
        const bool sinks = path.deltaAffine < 0;
        const double crossing = sinks && std::isfinite(surface) ? path.timeOfDepth(surface) : kNoLimit;
        const bool isAbove = path.depth(t) < surface;
        const bool isSkipped = isAbove && over <= crossing;
        if (isAbove) t = std::max(t, std::min(over, crossing));
        level = isSkipped ? std::min(level + 1, last) : level - 1;
    }
    return judgeEnd(image, ray, path, t, thickness, fetches, iterations);
}

} // namespace

TracerMethod closestDepthTracer(double thickness, int maxIterations)
{
    return {fmt::format("closest-depth pyramid, {} steps", maxIterations), [=](const YardstickScene& scene) -> Tracer {
                const auto pyramid = std::make_shared<NearestPyramid>(scene); // std::function copies its tracer
                return [=](const YardstickRay& ray) { return marchNearest(*pyramid, ray, thickness, maxIterations); };
            }};
}

} // namespace crossray
