// The closed forms of the Built-in and the URP profile, against numbers by hand.
#include "tests/unit/expect/cases.h"

#include "harness/expect/analytic_profiles.h"

#include <rapidcheck/gtest.h>

#include <random>

using namespace crossray;
using namespace crossray::test;

namespace {

Probe probeOf(const glm::dvec3& center, const glm::dvec3& side, double blend = 1.0, int importance = 1)
{
    Probe probe;
    probe.influence = {VolumeShape::kBox, center, glm::dmat3(1.0), 0.5 * side};
    probe.blend = {glm::dvec3(blend), glm::dvec3(blend)};
    probe.importance = importance;
    probe.capturePosition = center;
    probe.environment = {SolidColor{glm::dvec3(1.0)}, 64};
    return probe;
}

// A mirror ball of radius 1 about the origin among those probes.
Case ballWith(ProbeProfile profile, std::vector<Probe> probes)
{
    Case testCase = makeCase({sphere({0, 0, 0}, 1.0, "mirror")}, TraceEffect::kReflection);
    testCase.probeProfile = profile;
    testCase.probes = std::move(probes);
    testCase.hierarchy = kTierProbes | kTierSky;
    return testCase;
}

const UrpRules kManual{true, false};
const UrpRules kCode{false, false};
const UrpRules kHalf{false, true};

} // namespace

TEST(ProfileWeight, byTheDepthBelowTheFaces)
{
    const Probe probe = probeOf({0, 0, 0}, {4, 6, 8}, 0.5);
    EXPECT_EQ(weightInBox(probe, {2, 0, 0}), 0.0);
    EXPECT_EQ(weightInBox(probe, {0, 0, 4.5}), 0.0);
    EXPECT_EQ(weightInBox(probe, {1.75, 0, 0}), 0.5);
    EXPECT_EQ(weightInBox(probe, {1.75, -2.875, 0}), 0.25);
    EXPECT_EQ(weightInBox(probe, {1.5, -2.5, 3.5}), 1.0);
    EXPECT_EQ(weightInBox(probeOf({0, 0, 0}, {4, 6, 8}, 4.0), {0, 0, 0}), 0.5); // never all
    EXPECT_EQ(weightInBox(probeOf({0, 0, 0}, {2, 2, 2}, 0.0), {1, 0, 0}), 0.0); // 0/0 in the code
    EXPECT_EQ(weightInBox(probeOf({0, 0, 0}, {2, 2, 2}, 0.0), {0.999, 0, 0}), 1.0);
}

TEST(ProfileOrder, aLongBoxAgainstACube)
{
    const Case both = ballWith(ProbeProfile::kUrpDoc, {probeOf({0, 0, 0}, {5, 5, 5}), probeOf({0, 0, 0}, {10, 1, 1})});
    EXPECT_EQ(orderByUrp(both, {0, 1}, kManual), (std::vector{1, 0})); // 10 and 125 cubic metres
    EXPECT_EQ(orderByUrp(both, {0, 1}, kCode), (std::vector{0, 1}));   // 102 and 75 square metres
}

TEST(ProfileOrder, importanceBeforeSizeBeforeArea)
{
    const Probe large = probeOf({0, 0, 0}, {9, 9, 9}, 1.0, 2), small = probeOf({0, 0, 0}, {1, 1, 1});
    const Probe aside = probeOf({1.5, 0, 0}, {2, 2, 2}), over = probeOf({0.5, 0, 0}, {2, 2, 2});
    const Case all = ballWith(ProbeProfile::kUrpDoc, {aside, over, small, large});
    EXPECT_EQ(orderByUrp(all, {0, 1, 2, 3}, kManual), (std::vector{3, 2, 1, 0}));
    EXPECT_EQ(orderByUrp(all, {0, 1, 2, 3}, kCode), (std::vector{3, 2, 0, 1})); // no area: by number
}

TEST(ProfileOrder, halfPrecisionEndsAt65504)
{
    const Probe beyond = probeOf({0, 0, 0}, {256, 0, 0}), within = probeOf({0, 0, 0}, {255.9, 0, 0});
    const Probe farBeyond = probeOf({0, 0, 0}, {300, 0, 0});
    const Case all = ballWith(ProbeProfile::kUrpUnity, {farBeyond, beyond, within});
    EXPECT_EQ(orderByUrp(all, {0, 1, 2}, kCode), (std::vector{2, 1, 0}));
    EXPECT_EQ(orderByUrp(all, {0, 1, 2}, kHalf), (std::vector{2, 0, 1}));
    EXPECT_EQ(shareByUrp(all, {1, 0}, {1, 1}, kCode), (std::array{1.0, 0.0}));
    EXPECT_EQ(shareByUrp(all, {1, 0}, {1, 1}, kHalf), (std::array{0.5, 0.5}));
}

TEST(ProfileShares, ofTwo)
{
    const Case equal = ballWith(ProbeProfile::kUrpDoc, {probeOf({0, 0, 0}, {4, 4, 4}), probeOf({0, 0, 0}, {8, 8, 8})});
    EXPECT_EQ(shareByUrp(equal, {0, 1}, {1, 1}, kManual), (std::array{0.5, 0.5}));
    EXPECT_EQ(shareByUrp(equal, {0, 1}, {1, 0.25}, kManual), (std::array{0.8, 1.0 - 0.8}));
    EXPECT_EQ(shareByUrp(equal, {0, 1}, {0.5, 0.25}, kManual), (std::array{0.5, 0.25}));
    EXPECT_EQ(shareByUrp(equal, {0, 1}, {0.75, 1}, kCode), (std::array{0.75, 0.25})); // the smaller is the stronger
    Case ranked = equal;
    ranked.probes[1].importance = 2;
    EXPECT_EQ(shareByUrp(ranked, {1, 0}, {0.75, 1}, kManual), (std::array{0.75, 0.25}));
}

TEST(ProfileShares, theSkyTakesWhatIsLeft)
{
    // 0.995 m deep over a metre.
    Case testCase = ballWith(ProbeProfile::kUrpDoc, {probeOf({0, 0, 0}, {4, 4, 4})});
    EXPECT_NEAR(weighByUrp(testCase, {1.005, 0, 0}).sky, 0.005, 1e-15);
    testCase.probeProfile = ProbeProfile::kUrpUnity;
    EXPECT_EQ(weighByUrp(testCase, {1.005, 0, 0}).sky, 0.0);
    EXPECT_NEAR(weighByUrp(testCase, {1.25, 0, 0}).sky, 0.25, 1e-15);
}

TEST(ProfileShares, forwardPlusHasNoLimitOfTwo)
{
    // A quarter each: boxes of 6 m whose middle is 0.25 m below a face over a metre; in the order of their numbers.
    std::vector<Probe> probes;
    for (int i = 0; i < 5; ++i)
        probes.push_back(probeOf({2.75, 0, 0}, {6, 6, 6}));
    Case testCase = ballWith(ProbeProfile::kUrpUnity, probes);
    EXPECT_EQ(weighByUrp(testCase, {0, 0, 0}).probes, (std::vector{0.25, 0.25, 0.0, 0.0, 0.0}));
    testCase.profile.forwardPlus = true;
    const ProfileShares shares = weighByUrp(testCase, {0, 0, 0});
    EXPECT_EQ(shares.probes, (std::vector{0.25, 0.25, 0.25, 0.25, 0.0}));
    EXPECT_EQ(shares.sky, 0.0);
}

TEST(ProfileShares, builtInIsTheObjects)
{
    // The middle of the ball is 0.4 m below the face, over a metre.
    Case testCase = ballWith(ProbeProfile::kBuiltIn, {probeOf({1.6, 0, 0}, {4, 4, 4})});
    EXPECT_NEAR(weighByBuiltIn(testCase).probes[0], 0.4, 1e-15);
    EXPECT_NEAR(weighByBuiltIn(testCase).sky, 0.6, 1e-15);
    testCase.probes.push_back(probeOf({0, 0, 0}, {4, 4, 4}));
    EXPECT_NEAR(weighByBuiltIn(testCase).probes[0], 0.4 / 1.4, 1e-15);
    EXPECT_NEAR(weighByBuiltIn(testCase).probes[1], 1.0 / 1.4, 1e-15);
    testCase.probes[1].importance = 2;
    EXPECT_EQ(weighByBuiltIn(testCase).probes, (std::vector{0.0, 1.0}));
    testCase.profile.blending = false;
    testCase.probes.pop_back();
    EXPECT_EQ(weighByBuiltIn(testCase).probes[0], 1.0);
}

TEST(ProfileShares, theObjectsBoundsHoldEveryTracedPrimitive)
{
    Case testCase = ballWith(ProbeProfile::kBuiltIn, {});
    Primitive turned = box({4, 0, 0}, {1, 1, 1}, "mirror");
    const double s = std::sqrt(0.5);
    turned.worldFromLocal = glm::dmat3(s, s, 0, -s, s, 0, 0, 0, 1);
    testCase.scene.primitives.push_back(turned);
    testCase.scene.primitives.push_back(box({0, 50, 0}, {1, 1, 1}, "diffuse"));
    const WorldBox bounds = boundsOfObject(testCase);
    EXPECT_NEAR(bounds.high.x, 4.0 + std::sqrt(2.0), 1e-15);
    EXPECT_NEAR(bounds.high.y, std::sqrt(2.0), 1e-15);
    EXPECT_EQ(bounds.low, glm::dvec3(-1, -std::sqrt(2.0), -1));
}

TEST(ProfileMip, bothForms)
{
    EXPECT_EQ(builtInMip(0.0, false), 0.0);
    EXPECT_DOUBLE_EQ(builtInMip(0.5, false), 4.05); // (0.85 - 0.175) * 6
    EXPECT_EQ(builtInMip(1.0, false), 6.0);
    EXPECT_EQ(builtInMip(2.0, false), 6.0);
    EXPECT_DOUBLE_EQ(builtInMip(1.0, true), 6.0);
    // r = 1/2: m = 1/4, m^2 = 1/16, k = (32 - 2)/4 = 7.5, (2/9.5)^(1/4).
    EXPECT_DOUBLE_EQ(builtInMip(0.5, true), 6.0 * std::pow(2.0 / 9.5, 0.25));
    EXPECT_NEAR(builtInMip(0.0, true), 0.158, 0.001);
}

TEST(ProfileTexel, decodedByItsProbe)
{
    Case testCase = ballWith(ProbeProfile::kBuiltIn, {});
    Probe probe = probeOf({0, 0, 0}, {1, 1, 1});
    const glm::dvec3 texel(1.0, 0.5, 0.25);
    EXPECT_EQ(decodedTexel(testCase, probe, texel), texel);
    probe.rgbm = RgbmDecoding{0.5, 8.0, 2.0, 1.0};
    EXPECT_EQ(decodedTexel(testCase, probe, texel), 2.0 * texel); // 8 * 0.25
    testCase.profile.gammaSpace = true;
    EXPECT_EQ(decodedTexel(testCase, probe, texel), 4.0 * texel); // 8 * 0.5
    probe.rgbm = RgbmDecoding{0.0, 8.0, 2.0, 0.0};
    EXPECT_EQ(decodedTexel(testCase, probe, texel), 8.0 * texel); // alpha does not count
    probe.rgbm = RgbmDecoding{0.25, 8.0, 2.0, 2.0};
    EXPECT_EQ(decodedTexel(testCase, probe, texel), 0.0 * texel); // below 0
}

TEST(ProfileDirection, onTheBoxAndAsPublished)
{
    Case testCase = ballWith(ProbeProfile::kBuiltIn, {});
    Probe probe = probeOf({0, 0, 0}, {4, 4, 4});
    probe.capturePosition = {0, 1, 0};
    const Ray ray{{0.5, 0, 0}, {0, -1, 0}};
    EXPECT_EQ(boxProjectedDirection(testCase, probe, ray), ray.dirWS); // not enabled
    probe.boxProjection = true;
    const glm::dvec3 seen = boxProjectedDirection(testCase, probe, ray); // meets (0.5, -2, 0)
    EXPECT_NEAR(glm::length(seen - glm::normalize(glm::dvec3(0.5, -3, 0))), 0.0, 1e-15);
    testCase.profile.boxProjection = false;
    EXPECT_EQ(boxProjectedDirection(testCase, probe, ray), ray.dirWS);

    // The form that circulates looks backwards: here it is wrong by 135 degrees in the mean.
    testCase.profile.boxProjection = true;
    probe.capturePosition = {0, 0, 0};
    std::mt19937 random(7);
    std::uniform_real_distribution<double> share(-1.0, 1.0);
    const auto vector = [&] { return glm::dvec3(share(random), share(random), share(random)); };
    double sum = 0.0;
    constexpr int kRays = 20000;
    for (int i = 0; i < kRays; ++i) {
        const Ray any{1.8 * vector(), glm::normalize(vector())};
        const double cosine = glm::dot(publishedBoxDirection(probe, any), boxProjectedDirection(testCase, probe, any));
        sum += glm::degrees(std::acos(glm::clamp(cosine, -1.0, 1.0)));
    }
    EXPECT_NEAR(sum / kRays, 135.0, 1.0);
}
