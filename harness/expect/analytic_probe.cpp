#include "harness/expect/analytic_probe.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace crossray {

namespace {

constexpr double kSmallestBlend = 1e-4; // metres

double clamp01(double x)
{
    return x < 0.0 ? 0.0 : x > 1.0 ? 1.0 : x;
}

// The smooth ramp as what is left of 1: 1 - (1 - x)^2 (1 + 2x).
double smoothly(double x)
{
    const double left = 1.0 - x;
    return 1.0 - left * left * (1.0 + 2.0 * x);
}

// How deep the point lies below one face, over that face's blend distance. In world space, face by face.
double faceShare(const ProbeVolume& box, const glm::dvec3& positionWS, int axis, double side, double blend)
{
    const glm::dvec3 outwards = side * box.worldFromVolume[axis];
    const glm::dvec3 onFace = box.center + box.halfExtents[axis] * outwards;
    return glm::dot(onFace - positionWS, outwards) / std::max(blend, kSmallestBlend);
}

double boxShare(const Probe& probe, const glm::dvec3& positionWS)
{
    double share = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
        share = std::min(share, faceShare(probe.influence, positionWS, axis, 1.0, probe.blend.positive[axis]));
        share = std::min(share, faceShare(probe.influence, positionWS, axis, -1.0, probe.blend.negative[axis]));
    }
    return clamp01(share);
}

// Depth below the surface over the blend distance; without a usable one a step just outside the surface.
double sphereShare(const Probe& probe, const glm::dvec3& positionWS)
{
    const double depth = probe.influence.halfExtents.x - glm::distance(positionWS, probe.influence.center);
    const double blend = probe.blend.positive.x;
    if (blend >= kSmallestBlend) return clamp01(depth / blend);
    return clamp01(1.0 + (depth - blend) / kSmallestBlend);
}

bool isInBlendNormalVolume(const Probe& probe, const glm::dvec3& positionWS)
{
    const ProbeVolume& volume = probe.influence;
    if (volume.shape == VolumeShape::kSphere)
        return glm::distance(positionWS, volume.center) <= volume.halfExtents.x - probe.blendNormal.positive.x;
    const glm::dvec3 position = glm::transpose(volume.worldFromVolume) * (positionWS - volume.center);
    for (int axis = 0; axis < 3; ++axis) {
        if (position[axis] > volume.halfExtents[axis] - probe.blendNormal.positive[axis]) return false;
        if (position[axis] < -volume.halfExtents[axis] + probe.blendNormal.negative[axis]) return false;
    }
    return true;
}

// Everything up to a cosine of 0.2 between the normal and the way from the capture position, nothing from 0.6 on.
double normalShare(const Probe& probe, const SurfacePoint& surface)
{
    if (isInBlendNormalVolume(probe, surface.positionWS)) return 1.0;
    const glm::dvec3 away = surface.positionWS - probe.capturePosition;
    const double distance = glm::length(away);
    if (std::max({std::abs(away.x), std::abs(away.y), std::abs(away.z)}) <= kSmallestBlend) return 1.0;
    return clamp01((0.6 - glm::dot(surface.normalWS, away) / distance) / 0.4);
}

// Each face lets its share through, from a component of 1/4 on and wholly from 1/2 on.
double faceFade(const Probe& probe, const glm::dvec3& reflectedWS)
{
    if (probe.influence.shape != VolumeShape::kBox) return 1.0;
    double sum = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        const double along = glm::dot(reflectedWS, probe.influence.worldFromVolume[axis]);
        const double share = along > 0.0 ? probe.facePositive[axis] : probe.faceNegative[axis];
        sum += clamp01(4.0 * (std::abs(along) - 0.25) * share);
    }
    return clamp01(sum);
}

double proxyDistance(const ProbeVolume& proxy, const Ray& ray)
{
    const ProxyVolume volume{proxy.center, proxy.worldFromVolume, proxy.halfExtents, proxy.halfExtents.x};
    std::optional<double> distance;
    if (proxy.shape == VolumeShape::kBox) distance = distanceToBoxExit(volume, ray);
    if (proxy.shape == VolumeShape::kSphere) distance = distanceToSphereExit(volume, ray);
    return distance.value_or(kInfiniteProxyDistance);
}

// The texel at column x, row y of a face; beyond an edge, the one that lies next to it around the cube's edge, found by
// the point that is half a texel further on the cube's surface. At a corner it is the mean of the three that meet
// there.
glm::dvec3 texelAround(const Cubemap& cubemap, int level, int face, int x, int y)
{
    const int size = cubemap.sizeOf(level);
    const bool overSide = x < 0 || x >= size;
    const bool overEnd = y < 0 || y >= size;
    const int column = std::clamp(x, 0, size - 1), row = std::clamp(y, 0, size - 1);
    if (!overSide && !overEnd) return cubemap.at(level, face, column, row);
    if (overSide && overEnd) {
        return (cubemap.at(level, face, column, row) + texelAround(cubemap, level, face, x, row) +
                texelAround(cubemap, level, face, column, y)) /
               3.0;
    }
    glm::dvec2 onEdge((column + 0.5) / size, (row + 0.5) / size);
    if (overSide) {
        onEdge.x = x < 0 ? 0.0 : 1.0;
    } else {
        onEdge.y = y < 0 ? 0.0 : 1.0;
    }
    const glm::dvec3 middle = computeCubeDirection(face, {0.5, 0.5});
    const glm::dvec3 edge = computeCubeDirection(face, onEdge);
    // On the cube of half size 1, whose texels are 2/size wide.
    const glm::dvec3 beyond = edge / glm::dot(edge, middle) - middle / static_cast<double>(size);
    return nearestTexel(cubemap, beyond, level);
}

glm::dvec3 filterLevel(const Cubemap& cubemap, const glm::dvec3& dirWS, int level)
{
    const CubeFacePosition position = findCubePosition(dirWS);
    const glm::dvec2 texel = position.uv * static_cast<double>(cubemap.sizeOf(level)) - 0.5;
    const int x = static_cast<int>(std::floor(texel.x)), y = static_cast<int>(std::floor(texel.y));
    const glm::dvec2 share = texel - glm::dvec2(x, y);
    const auto read = [&](int dx, int dy) { return texelAround(cubemap, level, position.face, x + dx, y + dy); };
    return glm::mix(glm::mix(read(0, 0), read(1, 0), share.x), glm::mix(read(0, 1), read(1, 1), share.x), share.y);
}

// What is left of the pixel goes from tier to tier.
class Purse {
  public:
    double take(double asked)
    {
        const double got = std::min(clamp01(asked), left_);
        left_ -= got;
        return got;
    }

  private:
    double left_ = 1.0;
};

} // namespace

double probeWeightAt(const Probe& probe, const SurfacePoint& surface, const glm::dvec3& reflectedWS)
{
    const double volume = probe.influence.shape == VolumeShape::kBox ? boxShare(probe, surface.positionWS)
                                                                     : sphereShare(probe, surface.positionWS);
    return smoothly(volume * normalShare(probe, surface) * faceFade(probe, reflectedWS)) * clamp01(probe.weight);
}

std::vector<size_t> hdrpOrder(const std::vector<Probe>& probes)
{
    // 1000 steps for each 5 % of 1 + volume (of the box around the influence), in 20 bits.
    const auto keyOf = [&](size_t probe) {
        const glm::dvec3 side = 2.0 * probes[probe].influence.halfExtents;
        const double steps = 1000.0 * std::log1p(side.x * side.y * side.z) / std::log(1.05);
        return std::min(std::floor(steps), 1048575.0);
    };
    std::vector<size_t> order(probes.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::sort(order.begin(), order.end(), [&](size_t a, size_t b) {
        const double keyA = keyOf(a), keyB = keyOf(b);
        return keyA < keyB || (keyA == keyB && a < b);
    });
    return order;
}

ChosenProxy chooseProxy(const Case& testCase, const SurfacePoint& surface, const glm::dvec3& dirWS)
{
    if (testCase.projection.model != ProjectionModel::kProxyProbe)
        return {testCase.projection.model, testCase.projection.proxy};
    for (const size_t index : hdrpOrder(testCase.probes)) {
        const Probe& probe = testCase.probes[index];
        if (probeWeightAt(probe, surface, dirWS) <= 0.0) continue;
        const ProbeVolume& proxy = probe.proxy;
        const ProjectionModel model = proxy.shape == VolumeShape::kBox      ? ProjectionModel::kProxyBox
                                      : proxy.shape == VolumeShape::kSphere ? ProjectionModel::kProxySphere
                                                                            : ProjectionModel::kProxyInfinite;
        return {model, {proxy.center, proxy.worldFromVolume, proxy.halfExtents, proxy.halfExtents.x}};
    }
    return {};
}

ProbeSight lookThroughProbe(const Probe& probe, const Ray& ray)
{
    const double distance =
        std::clamp(proxyDistance(probe.proxy, ray), probe.minProjectionDistance, kInfiniteProxyDistance);
    const glm::dvec3 fromCapture = ray.originWS - probe.capturePosition + distance * ray.dirWS;
    const double length = glm::length(fromCapture);
    return {length > 0.0 ? fromCapture / length : ray.dirWS, distance, length};
}

double distanceBasedRoughness(double roughness, const ProbeSight& sight)
{
    if (sight.distanceFromCapture == 0.0) return roughness;
    const double sharper = std::min(sight.distance / sight.distanceFromCapture, 1.0) * roughness;
    return sharper + (roughness - sharper) * roughness;
}

double probeMipLevel(double roughness, int levels)
{
    return (1.7 * roughness - 0.7 * roughness * roughness) * (levels - 1);
}

glm::dvec3 dominantDirection(const SurfacePoint& surface, const glm::dvec3& reflectedWS, double roughness,
                             DominantDirection form)
{
    if (form == DominantDirection::kOff) return reflectedWS;
    const double cosine = clamp01(glm::dot(surface.normalWS, surface.toEyeWS));
    const double angle = form == DominantDirection::kSquared ? cosine * cosine : cosine;
    const double r2 = roughness * roughness, rest = 1.0 - r2;
    const double factor = (std::sqrt(rest) + r2) * clamp01(rest * (rest + angle));
    return glm::normalize(surface.normalWS + factor * (reflectedWS - surface.normalWS));
}

glm::dvec3 filterCubemap(const Cubemap& cubemap, const glm::dvec3& dirWS, double level)
{
    const double used = std::clamp(level, 0.0, static_cast<double>(cubemap.levelCount() - 1));
    const int finer = static_cast<int>(std::floor(used));
    const glm::dvec3 fine = filterLevel(cubemap, dirWS, finer);
    if (finer + 1 >= cubemap.levelCount()) return fine;
    return glm::mix(fine, filterLevel(cubemap, dirWS, finer + 1), used - finer);
}

HierarchyShare shareHierarchy(const CaseData& data, const SurfacePoint& surface, const EffectRay& ray,
                              double screenWeight, const glm::dvec3& screenColor)
{
    const Case& testCase = data.testCase();
    HierarchyShare share;
    if (ray.status != HitReason::kNone) return share;
    Purse purse;
    const double roughness = clamp01(testCase.material.roughness);
    if (testCase.hierarchy & kTierScreen) {
        share.tiers.x = purse.take(screenWeight);
        share.color += share.tiers.x * screenColor;
    }
    if (testCase.hierarchy & kTierProbes) {
        const glm::dvec3 lookUp = testCase.effect == TraceEffect::kReflection
                                      ? dominantDirection(surface, ray.dirWS, roughness, testCase.dominantDirection)
                                      : ray.dirWS;
        for (const size_t index : hdrpOrder(testCase.probes)) {
            const Probe& probe = testCase.probes[index];
            const double got = purse.take(probeWeightAt(probe, surface, ray.dirWS));
            if (got <= 0.0) continue;
            const ProbeSight sight = lookThroughProbe(probe, {ray.originWS, lookUp});
            const Cubemap& cubemap = data.environments()[index];
            const double used = probe.distanceBasedRoughness ? distanceBasedRoughness(roughness, sight) : roughness;
            const double level = probeMipLevel(used, cubemap.levelCount());
            if (share.tiers.y == 0.0) {
                share.probeDirWS = sight.dirWS;
                share.probeMipLevel = level;
            }
            share.tiers.y += got;
            if (index < 4) share.probes[static_cast<int>(index)] = got;
            share.color += got * probe.multiplier * filterCubemap(cubemap, sight.dirWS, level);
        }
    }
    if ((testCase.hierarchy & kTierSky) && testCase.sky.model != SkyModel::kNone) {
        share.tiers.w = purse.take(1.0);
        Scene sky;
        sky.sky = testCase.sky.gradient;
        sky.upWS = testCase.scene.upWS;
        share.color +=
            share.tiers.w * (testCase.sky.model == SkyModel::kGradient
                                 ? computeSkyRadiance(sky, ray.dirWS)
                                 : filterCubemap(data.environments().back(), ray.dirWS,
                                                 probeMipLevel(roughness, data.environments().back().levelCount())));
    }
    return share;
}

} // namespace crossray
