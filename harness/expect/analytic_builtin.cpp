// What the Built-in pipeline makes of its probes: one choice and one pair of weights an object, the mip level of a
// roughness, box projection and RGBM texels; and the colour of all shares, which URP has alike. Source: domain, section
// 6 (Unity manual and shader listing).
#include "harness/expect/analytic_profiles.h"

#include <algorithm>
#include <cmath>

namespace crossray {

namespace {

constexpr double kSingleProbe = 0.99999; // from here on the second is not sampled
constexpr double kMipSteps = 6.0;
constexpr double kSmallestFourthPower = 1.192092896e-7; // of a roughness

// Of a chain with one colour a level, read between two of them; a level beyond the last is the last.
glm::dvec3 colorAt(const Environment& environment, double mip)
{
    if (const auto* solid = std::get_if<SolidColor>(&environment.content)) return solid->color;
    const std::vector<glm::dvec3>& levels = std::get<LevelColors>(environment.content).colors;
    const auto level = [&](double at) { return levels[std::min(static_cast<size_t>(at), levels.size() - 1)]; };
    const double finer = std::floor(mip);
    return level(finer) + (mip - finer) * (level(finer + 1.0) - level(finer));
}

double lastLevelOf(const Environment& environment)
{
    return std::log2(static_cast<double>(environment.size));
}

bool isOneColorALevel(const Environment& environment)
{
    return std::holds_alternative<SolidColor>(environment.content) ||
           std::holds_alternative<LevelColors>(environment.content);
}

double mipOf(const Case& testCase, const Environment& environment)
{
    return std::min(builtInMip(testCase.material.roughness, testCase.profile.exactMip), lastLevelOf(environment));
}

glm::dvec3 skyColor(const Case& testCase, const glm::dvec3& dirWS)
{
    const SkySettings& sky = testCase.sky;
    if (sky.model == SkyModel::kNone) return glm::dvec3(0.0);
    if (sky.model == SkyModel::kCubemap) return colorAt(*sky.environment, mipOf(testCase, *sky.environment));
    Scene scene;
    scene.sky = sky.gradient;
    scene.upWS = testCase.scene.upWS;
    return computeSkyRadiance(scene, dirWS);
}

} // namespace

// Everything at the middle of the object: the same for all its pixels. Two probes share it all in the ratio of what
// URP's manual gives them; beside a single one stands the sky.
ProfileShares weighByBuiltIn(const Case& testCase)
{
    const WorldBox object = boundsOfObject(testCase);
    const glm::dvec3 center = object.low + 0.5 * (object.high - object.low);
    std::vector<int> reaching;
    for (size_t probe = 0; probe < testCase.probes.size(); ++probe) {
        if (weightInBox(testCase.probes[probe], center) > 0.0) reaching.push_back(static_cast<int>(probe));
    }
    const std::vector<int> order = orderByUrp(testCase, reaching, {});
    ProfileShares shares{std::vector<double>(testCase.probes.size(), 0.0), 1.0};
    if (order.empty()) return shares;
    const auto first = static_cast<size_t>(order[0]);
    double weight = weightInBox(testCase.probes[first], center);
    const bool isPair = order.size() > 1;
    if (isPair) {
        const auto second = static_cast<size_t>(order[1]);
        const std::array<double, 2> both =
            shareByUrp(testCase, {order[0], order[1]}, {weight, weightInBox(testCase.probes[second], center)}, {});
        weight = both[0] / (both[0] + both[1]);
    }
    if (weight >= kSingleProbe || !testCase.profile.blending) weight = 1.0;
    shares.probes[first] = weight;
    if (isPair) shares.probes[static_cast<size_t>(order[1])] = 1.0 - weight;
    shares.sky = isPair ? 0.0 : 1.0 - weight;
    return shares;
}

// The parabola from its ends and its bulge: it meets r at 0 and 1, and lies 0.7 r (1 - r) above it. The exact form with
// its power put in: k + 2 is (1 + 3q) / (2q), q the fourth power of the roughness.
double builtInMip(double roughness, bool exact)
{
    const double r = std::clamp(roughness, 0.0, 1.0);
    if (!exact) return kMipSteps * (r + 0.7 * r * (1.0 - r));
    const double q = std::max(r * r * r * r, kSmallestFourthPower);
    return kMipSteps * std::pow(4.0 * q / (1.0 + 3.0 * q), 0.25);
}

// The exit of the six planes that hold the box, seen from where the environment was captured.
glm::dvec3 boxProjectedDirection(const Case& testCase, const Probe& probe, const Ray& ray)
{
    if (!testCase.profile.boxProjection || !probe.boxProjection) return ray.dirWS;
    ProxyVolume box;
    box.center = probe.influence.center;
    box.halfExtents = probe.influence.halfExtents;
    const std::optional<double> distance = distanceToBoxExit(box, ray);
    if (!distance) return ray.dirWS;
    const glm::dvec3 seen = ray.originWS + *distance * ray.dirWS - probe.capturePosition;
    return seen == glm::dvec3(0.0) ? ray.dirWS : glm::normalize(seen);
}

// Its selection is the wrong way round: the smallest of the three "distances" is that of a face that the ray leaves.
glm::dvec3 publishedBoxDirection(const Probe& probe, const Ray& ray)
{
    double smallest = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        const double side = ray.dirWS[axis] > 0.0 ? -1.0 : 1.0;
        const double face = probe.influence.center[axis] + side * probe.influence.halfExtents[axis];
        smallest = std::min(smallest, (face - ray.originWS[axis]) / ray.dirWS[axis]);
    }
    return glm::normalize(ray.originWS + smallest * ray.dirWS - probe.capturePosition);
}

glm::dvec3 decodedTexel(const Case& testCase, const Probe& probe, const glm::dvec3& texel)
{
    if (!probe.rgbm) return texel;
    const RgbmDecoding& decode = *probe.rgbm;
    const double alpha = std::max(0.0, 1.0 - decode.alphaWeight * (1.0 - decode.alpha));
    const double exponent = testCase.profile.gammaSpace ? 1.0 : decode.exponent;
    // Without an exponent the alpha does not count, at 0 either.
    return decode.range * std::pow(alpha, exponent) * texel;
}

std::string refuseProfile(const Case& testCase)
{
    if (testCase.hierarchy & kTierScreen) return "the screen's tier is not in it; hierarchy without screen is allowed";
    for (const Probe& probe : testCase.probes) {
        if (!isOneColorALevel(probe.environment)) return "each probe shows one colour a level: solid or levels";
    }
    if (testCase.sky.model == SkyModel::kCubemap && !isOneColorALevel(*testCase.sky.environment))
        return "the sky shows one colour a level: solid or levels";
    return {};
}

ProfileAnswer answerByProfile(const Case& testCase, const glm::dvec3& positionWS, const EffectRay& ray)
{
    ProfileAnswer answer;
    answer.shares.probes.assign(testCase.probes.size(), 0.0);
    if (testCase.hierarchy & kTierProbes) {
        answer.shares = testCase.probeProfile == ProbeProfile::kBuiltIn ? weighByBuiltIn(testCase)
                                                                        : weighByUrp(testCase, positionWS);
    }
    if (!(testCase.hierarchy & kTierSky) || testCase.sky.model == SkyModel::kNone) answer.shares.sky = 0.0;
    answer.color = answer.shares.sky * skyColor(testCase, ray.dirWS);
    for (size_t number = testCase.probes.size(); number-- > 0;) {
        const Probe& probe = testCase.probes[number];
        const double share = answer.shares.probes[number];
        if (!(share > 0.0)) continue;
        answer.firstDirWS = boxProjectedDirection(testCase, probe, {ray.originWS, ray.dirWS});
        answer.firstMip = mipOf(testCase, probe.environment);
        answer.color +=
            share * probe.multiplier * decodedTexel(testCase, probe, colorAt(probe.environment, answer.firstMip));
    }
    return answer;
}

} // namespace crossray
