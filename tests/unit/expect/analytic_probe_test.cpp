// The closed forms of probes, by numbers that a hand can check.
#include "harness/expect/analytic_probe.h"
#include "tests/unit/expect/cases.h"

using namespace crossray;

namespace {

Probe makeBox(const glm::dvec3& halfExtents, double blend)
{
    Probe probe;
    probe.influence.shape = VolumeShape::kBox;
    probe.influence.halfExtents = halfExtents;
    probe.blend = {glm::dvec3(blend), glm::dvec3(blend)};
    probe.capturePosition = {0, 0, -100}; // all normals of these tests face it
    return probe;
}

SurfacePoint at(const glm::dvec3& positionWS)
{
    SurfacePoint surface;
    surface.positionWS = positionWS;
    surface.normalWS = {0, 0, -1};
    surface.toEyeWS = {0, 0, -1};
    return surface;
}

const glm::dvec3 kUp(0, 1, 0);

} // namespace

TEST(AnalyticProbe, aBoxBlendsOverItsFaces)
{
    const Probe probe = makeBox({2, 3, 4}, 1.0);
    EXPECT_EQ(probeWeightAt(probe, at({0, 0, 0}), kUp), 1.0);
    EXPECT_EQ(probeWeightAt(probe, at({2, 0, 0}), kUp), 0.0);
    EXPECT_EQ(probeWeightAt(probe, at({2.5, 0, 0}), kUp), 0.0);
    EXPECT_EQ(probeWeightAt(probe, at({1.5, 0, 0}), kUp), 0.5);                 // S(1/2)
    EXPECT_NEAR(probeWeightAt(probe, at({1.5, 2.75, 0}), kUp), 0.15625, 1e-15); // S(1/4) = 3/16 - 2/64
    Probe light = probe;
    light.weight = 0.5;
    EXPECT_EQ(probeWeightAt(light, at({0, 0, 0}), kUp), 0.5);
    light.weight = 5.0;
    EXPECT_EQ(probeWeightAt(light, at({0, 0, 0}), kUp), 1.0);
}

TEST(AnalyticProbe, aSphereBlendsInwards)
{
    Probe probe = makeBox(glm::dvec3(2), 1.0);
    probe.influence.shape = VolumeShape::kSphere;
    EXPECT_EQ(probeWeightAt(probe, at({0, 1, 0}), kUp), 1.0);
    EXPECT_EQ(probeWeightAt(probe, at({0, 1.5, 0}), kUp), 0.5);
    EXPECT_EQ(probeWeightAt(probe, at({0, 2, 0}), kUp), 0.0);
    probe.blend.positive = glm::dvec3(0);
    EXPECT_EQ(probeWeightAt(probe, at({0, 2, 0}), kUp), 1.0);
    EXPECT_EQ(probeWeightAt(probe, at({0, 2.001, 0}), kUp), 0.0);
}

TEST(AnalyticProbe, normalsThatFaceAwayLoseIt)
{
    Probe probe = makeBox({2, 2, 2}, 0.0);
    probe.capturePosition = {0, 0, 0};
    probe.blendNormal = {glm::dvec3(1), glm::dvec3(1)};
    SurfacePoint surface = at({0, 0, 1.5});
    surface.normalWS = {0, 0, 1};
    EXPECT_EQ(probeWeightAt(probe, surface, kUp), 0.0);
    surface.normalWS = {0, 1, 0};
    EXPECT_EQ(probeWeightAt(probe, surface, kUp), 1.0);
    surface.normalWS = {0, std::sqrt(1 - 0.16), 0.4}; // between 0.2 and 0.6
    EXPECT_NEAR(probeWeightAt(probe, surface, kUp), 0.5, 1e-14);
    surface.positionWS = {0, 0, 0.9}; // inside
    surface.normalWS = {0, 0, 1};
    EXPECT_EQ(probeWeightAt(probe, surface, kUp), 1.0);
}

TEST(AnalyticProbe, facesLetThroughWhatGoesTheirWay)
{
    Probe probe = makeBox({2, 2, 2}, 0.0);
    probe.facePositive = {0, 0.5, 0};
    probe.faceNegative = {0, 0, 0};
    EXPECT_EQ(probeWeightAt(probe, at({0, 0, 0}), {1, 0, 0}), 0.0);
    EXPECT_EQ(probeWeightAt(probe, at({0, 0, 0}), {0, -1, 0}), 0.0);
    EXPECT_EQ(probeWeightAt(probe, at({0, 0, 0}), {0, 1, 0}), 1.0);                       // 3 times a half, clamped
    EXPECT_EQ(probeWeightAt(probe, at({0, 0, 0}), {0.6, 0.5, std::sqrt(1 - 0.61)}), 0.5); // (4 * 0.5 - 1) * 0.5
}

TEST(AnalyticProbe, aSmallVolumeIsAskedFirst)
{
    std::vector<Probe> probes{makeBox({3, 3, 3}, 0), makeBox({1, 1, 1}, 0), makeBox({2, 2, 2}, 0),
                              makeBox({2, 4, 1}, 0)};
    EXPECT_EQ(hdrpOrder(probes), (std::vector<size_t>{1, 2, 3, 0}));
    probes[0].importance = 99;
    EXPECT_EQ(hdrpOrder(probes), (std::vector<size_t>{1, 2, 3, 0}));
}

TEST(AnalyticProbe, looksThroughItsProxy)
{
    Probe probe = makeBox({9, 9, 9}, 0);
    probe.capturePosition = {0, 1, 0};
    const Ray ray{{0, 0, 0}, {1, 0, 0}};
    EXPECT_NEAR(lookThroughProbe(probe, ray).distance, 65504.0, 0.0);
    probe.proxy.shape = VolumeShape::kBox;
    probe.proxy.halfExtents = {1, 4, 4};
    const ProbeSight sight = lookThroughProbe(probe, ray);
    EXPECT_EQ(sight.distance, 1.0);
    EXPECT_NEAR(sight.distanceFromCapture, std::sqrt(2.0), 1e-15);
    EXPECT_NEAR(glm::distance(sight.dirWS, glm::normalize(glm::dvec3(1, -1, 0))), 0.0, 1e-15);
    probe.minProjectionDistance = 2.0;
    EXPECT_EQ(lookThroughProbe(probe, ray).distance, 2.0);
    EXPECT_NEAR(distanceBasedRoughness(0.5, {{}, 1.0, 2.0}), 0.375, 1e-15);
    EXPECT_EQ(distanceBasedRoughness(0.5, {{}, 3.0, 2.0}), 0.5);
    EXPECT_NEAR(probeMipLevel(0.5, 5), 2.7, 1e-15);
}

TEST(AnalyticProbe, filtersACubemapAcrossItsEdges)
{
    Cubemap cubemap(2, 2);
    for (int face = 0; face < kCubeFaces; ++face) {
        for (int texel = 0; texel < 4; ++texel)
            cubemap.at(0, face, texel % 2, texel / 2) = glm::dvec3(face);
        cubemap.at(1, face, 0, 0) = glm::dvec3(10.0 * face);
    }
    EXPECT_EQ(filterCubemap(cubemap, {1, 0, 0}, 0.0).x, 0.0);
    EXPECT_EQ(filterCubemap(cubemap, {0, 0, -3}, 0.0).x, 5.0);
    EXPECT_EQ(filterCubemap(cubemap, {0, 0, -3}, 1.0).x, 50.0);
    EXPECT_EQ(filterCubemap(cubemap, {0, 0, -3}, 0.5).x, 27.5);
    EXPECT_NEAR(filterCubemap(cubemap, {1, 0, 1}, 0.0).x, 2.0, 1e-12);  // +x and +z
    EXPECT_NEAR(filterCubemap(cubemap, {0, 1, -1}, 0.0).x, 3.5, 1e-12); // +y and -z
}
