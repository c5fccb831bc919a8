#include "tests/property/random_image.h"

#include <algorithm>
#include <limits>

namespace crossray {

namespace {

class Random {
  public:
    explicit Random(uint64_t seed) : engine_(seed) {}
    // In [low, high), by the engine's bits: the same on every machine.
    double real(double low, double high)
    {
        return low + (high - low) * static_cast<double>(engine_() >> 11) / static_cast<double>(uint64_t{1} << 53);
    }
    int whole(int low, int high) { return low + static_cast<int>(engine_() % static_cast<uint64_t>(high - low)); }
    bool chance(double share) { return real(0, 1) < share; }
    template <class T>
    T pick(std::initializer_list<T> values)
    {
        return values.begin()[engine_() % values.size()];
    }
    glm::dvec3 direction()
    {
        glm::dvec3 v(0.0);
        do {
            v = {real(-1, 1), real(-1, 1), real(-1, 1)};
        } while (glm::dot(v, v) > 1 || glm::dot(v, v) < 1e-6);
        return glm::normalize(v);
    }

  private:
    std::mt19937_64 engine_;
};

struct Block {
    int left, top, right, bottom;
    double depth;
};

Camera makeRandomCamera(Random& random, ImageShape shape)
{
    Camera camera;
    camera.width = random.whole(1, 97);
    camera.height = random.whole(1, 97);
    if (shape == ImageShape::kThin) (random.chance(0.5) ? camera.width : camera.height) = random.whole(1, 4);
    if (shape == ImageShape::kWide) {
        camera.width = random.whole(8190, 8193);
        camera.height = random.whole(1, 8);
        if (random.chance(0.3)) std::swap(camera.width, camera.height);
    }
    if (random.chance(0.3)) {
        camera.projection = ProjectionKind::kOrthographic;
        camera.orthographicHeight = 6;
    }
    camera.depthConvention =
        random.pick({DepthConvention::kStandard, DepthConvention::kReversed,
                     camera.projection == ProjectionKind::kOrthographic ? DepthConvention::kReversed
                                                                        : DepthConvention::kInfiniteReversed});
    // Half of them along the axes of the world, where rays run exactly along rows, columns and diagonals.
    if (random.chance(0.5)) {
        const glm::dvec3 eye{random.real(-9, 9), random.real(-9, 9), random.real(-9, 9)};
        camera.worldFromView = makeLookAt(eye, eye + random.direction(), {0.12, 0.98, -0.05});
    }
    return camera;
}

double depthOfPlane(const Camera& camera, int x, int y, const glm::dvec3& pointVS, const glm::dvec3& normalVS)
{
    Camera level = camera;
    level.worldFromView = glm::dmat4(1.0);
    const Ray ray = computePrimaryRay(level, {x + 0.5, y + 0.5});
    const double rate = glm::dot(ray.dirWS, normalVS);
    const double distance = rate == 0 ? -1 : glm::dot(pointVS - ray.originWS, normalVS) / rate;
    const double depth = distance > 0 ? -(ray.originWS + ray.dirWS * distance).z : -1;
    return depth > camera.nearDistance && depth < camera.farDistance ? depth : -1;
}

// Metres a pixel, negative for sky.
std::vector<double> drawDepths(Random& random, const Camera& camera)
{
    std::vector<Block> blocks;
    const int count = random.whole(0, 8);
    for (int i = 0; i < count; ++i) {
        const int left = random.whole(0, camera.width), top = random.whole(0, camera.height);
        blocks.push_back({left, top, left + random.whole(1, camera.width / 3 + 2),
                          top + random.whole(1, camera.height + 1), random.real(1, 12)});
    }
    const double noise = random.pick({0.0, 0.0, 0.0, 0.001, 0.3});
    const double holes = random.pick({0.0, 0.0, 0.05});
    const bool onlyNoise = random.chance(0.15);
    const double tilt = random.real(-1.5, 1.5);
    std::vector<double> depths;
    for (int y = 0; y < camera.height; ++y) {
        for (int x = 0; x < camera.width; ++x) {
            double depth = depthOfPlane(camera, x, y, {0, 0, -10}, {tilt, 0, 1});
            const double floor = depthOfPlane(camera, x, y, {0, -1, 0}, {0, 1, 0});
            if (floor > 0 && (depth < 0 || floor < depth)) depth = floor;
            for (const Block& block : blocks) {
                const bool isInside = x >= block.left && x < block.right && y >= block.top && y < block.bottom;
                if (isInside && (depth < 0 || block.depth < depth)) depth = block.depth;
            }
            if (depth > 0) depth = std::max(camera.nearDistance * 1.01, depth * (1 + noise * random.real(-0.5, 0.5)));
            if (onlyNoise) depth = random.real(0.5, 20);
            depths.push_back(random.chance(holes) ? -1 : depth);
        }
    }
    return depths;
}

RandomRay drawRay(Random& random, const RandomImage& image, const std::vector<double>& depths)
{
    const Camera& camera = image.camera;
    const int x = random.whole(0, camera.width), y = random.whole(0, camera.height);
    const double seen = depths[static_cast<size_t>(y) * static_cast<size_t>(camera.width) + static_cast<size_t>(x)];
    const bool isFree = seen < 0 || random.chance(0.25);
    // From the surface at a pixel's centre, or from any depth at a pixel's corner, border or inside.
    const glm::dvec2 offset =
        isFree ? glm::dvec2(random.pick({0.0, 0.5, random.real(0, 1)}), random.pick({0.0, 0.5, random.real(0, 1)}))
               : glm::dvec2(0.5);
    const double depth = isFree ? random.real(0.2, 20) : seen;
    glm::dvec3 dirVS = random.direction();
    switch (random.whole(0, 8)) {
    case 0:
        dirVS.x = 0;
        break;
    case 1:
        dirVS.y = 0;
        break;
    case 2:
        dirVS.z = 0;
        break;
    case 3:
        dirVS.y = dirVS.x;
        break;
    case 4: // far over the screen
        dirVS.z *= 0.05;
        break;
    default:
        break;
    }
    return {unprojectFromScreen(camera, glm::dvec2(x, y) + offset, depth),
            glm::dmat3(camera.worldFromView) * dirVS * random.pick({1.0, 1.0, 7.5}), random.whole(0, 15),
            random.pick({0.0, 0.4, 2.0})};
}

} // namespace

RandomImage makeRandomImage(uint64_t seed, ImageShape shape, int rayCount)
{
    Random random(seed * 3 + static_cast<uint64_t>(shape));
    RandomImage image;
    image.seed = seed;
    image.camera = makeRandomCamera(random, shape);
    const std::vector<double> depths = drawDepths(random, image.camera);
    const int normals = random.whole(0, 3); // none, random, towards the eye
    const bool isHostile = random.chance(0.1);
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    for (const double depth : depths) {
        double device = depth < 0 ? clearedDeviceDepth(image.camera) : computeDeviceDepth(image.camera, depth);
        if (isHostile && random.chance(0.1)) device = random.pick({kNaN, -1.0, 2.0, 1e30, -0.0});
        image.deviceDepths.push_back(device);
        glm::dvec3 normal = normals == 0 ? glm::dvec3(0.0) : random.direction();
        if (normals == 2) normal = glm::dvec3(image.camera.worldFromView[2]);
        if (isHostile && random.chance(0.1)) normal.x = kNaN;
        image.normalsWS.insert(image.normalsWS.end(), {normal.x, normal.y, normal.z, 1.0});
    }
    image.depthError = random.pick({0.0, 0.0, 1e-6, 1e-3});
    for (int ray = 0; ray < rayCount; ++ray)
        image.rays.push_back(drawRay(random, image, depths));
    return image;
}

} // namespace crossray
