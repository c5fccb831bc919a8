// Which probes count, and how much, as URP's manual and URP's code have it. Source: domain, section 6 and claims 16 to
// 18 (Unity URP manual, reflection probes; the public behaviour of its shaders).
#include "harness/expect/analytic_profiles.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace crossray {

namespace {

constexpr double kFull = 0.99;           // the code's sum of weights that leaves the sky nothing
constexpr double kLargestHalf = 65504.0; // square metres of a diagonal in half precision
constexpr double kSameDiagonal = 1e-4;   // square metres
constexpr double kOverflow = std::numeric_limits<double>::infinity();

WorldBox boxOf(const Probe& probe)
{
    return {probe.influence.center - probe.influence.halfExtents, probe.influence.center + probe.influence.halfExtents};
}

bool overlap(const WorldBox& a, const WorldBox& b)
{
    return glm::all(glm::lessThanEqual(a.low, b.high)) && glm::all(glm::lessThanEqual(b.low, a.high));
}

// The manual's volume; the code's diagonal, which is the sum of the squares of the sides.
double sizeOf(const Probe& probe, const UrpRules& rules)
{
    const glm::dvec3 half = probe.influence.halfExtents;
    if (rules.manual) return 8.0 * half.x * half.y * half.z;
    const double diagonal = 4.0 * (half.x * half.x + half.y * half.y + half.z * half.z);
    return rules.halfPrecision && diagonal > kLargestHalf ? kOverflow : diagonal;
}

// Of the faces of the object's bounds, the part that lies in the probe's box.
double coveredArea(const WorldBox& object, const WorldBox& probe)
{
    glm::dvec3 shared;
    for (int axis = 0; axis < 3; ++axis)
        shared[axis] =
            std::max(0.0, std::min(object.high[axis], probe.high[axis]) - std::max(object.low[axis], probe.low[axis]));
    double area = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        const double face = shared[(axis + 1) % 3] * shared[(axis + 2) % 3];
        for (const double at : {object.low[axis], object.high[axis]})
            area += at >= probe.low[axis] && at <= probe.high[axis] ? face : 0.0;
    }
    return area;
}

// The corners of a primitive's own box, or of the box around its sphere.
void growBy(const Primitive& primitive, WorldBox& bounds)
{
    const glm::dvec3 half = localHalfExtents(primitive);
    const bool turns = primitive.shape != PrimitiveShape::kSphere;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 sign(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
        const glm::dvec3 local = sign * half;
        const glm::dvec3 point = primitive.center + (turns ? primitive.worldFromLocal * local : local);
        bounds = {glm::min(bounds.low, point), glm::max(bounds.high, point)};
    }
}

// The code asks one probe after another, each for what is left, until 0.99 is reached; it asks no object.
ProfileShares weighByForwardPlus(const Case& testCase, const glm::dvec3& positionWS, const UrpRules& rules)
{
    std::vector<int> all(testCase.probes.size());
    std::iota(all.begin(), all.end(), 0);
    ProfileShares shares{std::vector<double>(testCase.probes.size(), 0.0), 1.0};
    double left = 1.0;
    for (const int probe : orderByUrp(testCase, all, rules)) {
        if (1.0 - left >= kFull) break;
        const double got = std::min(weightInBox(testCase.probes[static_cast<size_t>(probe)], positionWS), left);
        shares.probes[static_cast<size_t>(probe)] = got;
        left -= got;
    }
    shares.sky = 1.0 - left >= kFull ? 0.0 : left;
    return shares;
}

} // namespace

WorldBox boundsOfObject(const Case& testCase)
{
    WorldBox bounds{glm::dvec3(std::numeric_limits<double>::infinity()),
                    glm::dvec3(-std::numeric_limits<double>::infinity())};
    for (const Primitive& primitive : testCase.scene.primitives) {
        if (primitive.material == (testCase.effect == TraceEffect::kReflection ? "mirror" : "glass"))
            growBy(primitive, bounds);
    }
    return bounds;
}

// The box shrinks by the blend distance from every face; a point's weight is the largest share of that shrinking which
// leaves it inside. On a face, and without a blend distance inside, it needs no division.
double weightInBox(const Probe& probe, const glm::dvec3& positionWS)
{
    const WorldBox box = boxOf(probe);
    double weight = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
        for (const double depth : {positionWS[axis] - box.low[axis], box.high[axis] - positionWS[axis]}) {
            if (!(depth > 0.0)) return 0.0;
            if (depth < probe.blend.positive.x) weight = std::min(weight, depth / probe.blend.positive.x);
        }
    }
    return weight;
}

std::vector<int> orderByUrp(const Case& testCase, std::vector<int> probes, const UrpRules& rules)
{
    const WorldBox object = boundsOfObject(testCase);
    const auto key = [&](int number) {
        const Probe& probe = testCase.probes[static_cast<size_t>(number)];
        const double area = rules.manual ? coveredArea(object, boxOf(probe)) : 0.0;
        return std::make_tuple(-probe.importance, sizeOf(probe, rules), -area, number);
    };
    std::sort(probes.begin(), probes.end(), [&](int a, int b) { return key(a) < key(b); });
    return probes;
}

// One that outranks the other keeps its weight and leaves the other what fits into 1. Equals keep theirs where both
// fit, else in proportion.
std::array<double, 2> shareByUrp(const Case& testCase, std::array<int, 2> probes, std::array<double, 2> weights,
                                 const UrpRules& rules)
{
    if (!(weights[0] + weights[1] > 1.0)) return weights;
    const Probe& a = testCase.probes[static_cast<size_t>(probes[0])];
    const Probe& b = testCase.probes[static_cast<size_t>(probes[1])];
    const double sizeA = sizeOf(a, rules), sizeB = sizeOf(b, rules);
    const bool sameSize = rules.manual || sizeA == sizeB || std::abs(sizeA - sizeB) <= kSameDiagonal;
    if (a.importance != b.importance ? a.importance > b.importance : !sameSize && sizeA < sizeB)
        return {weights[0], 1.0 - weights[0]};
    if (a.importance != b.importance || !sameSize) return {1.0 - weights[1], weights[1]};
    const double ofFirst = weights[0] / (weights[0] + weights[1]);
    return {ofFirst, 1.0 - ofFirst};
}

// The pair is the object's: of the probes whose boxes touch its bounds. Its weights are the pixel's.
ProfileShares weighByUrp(const Case& testCase, const glm::dvec3& positionWS)
{
    const ProfileSettings& profile = testCase.profile;
    const UrpRules rules{testCase.probeProfile == ProbeProfile::kUrpDoc, profile.halfPrecision};
    if (profile.forwardPlus && profile.blending) return weighByForwardPlus(testCase, positionWS, rules);
    const WorldBox object = boundsOfObject(testCase);
    std::vector<int> touching;
    for (size_t probe = 0; probe < testCase.probes.size(); ++probe) {
        if (overlap(boxOf(testCase.probes[probe]), object)) touching.push_back(static_cast<int>(probe));
    }
    const std::vector<int> order = orderByUrp(testCase, touching, rules);
    ProfileShares shares{std::vector<double>(testCase.probes.size(), 0.0), 1.0};
    if (order.empty()) return shares;
    const auto first = static_cast<size_t>(order[0]);
    if (!profile.blending) {
        shares.probes[first] = 1.0;
        shares.sky = 0.0;
        return shares;
    }
    shares.probes[first] = weightInBox(testCase.probes[first], positionWS);
    double sum = shares.probes[first];
    if (order.size() > 1) {
        const auto second = static_cast<size_t>(order[1]);
        const std::array<double, 2> both =
            shareByUrp(testCase, {order[0], order[1]}, {sum, weightInBox(testCase.probes[second], positionWS)}, rules);
        shares.probes[first] = both[0];
        shares.probes[second] = both[1];
        sum = both[0] + both[1];
    }
    shares.sky = !rules.manual && sum >= kFull ? 0.0 : std::max(0.0, 1.0 - sum);
    return shares;
}

} // namespace crossray
