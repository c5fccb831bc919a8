#include "harness/expect/captures.h"
#include "harness/scene/random_scene.h"
#include "tests/unit/expect/cases.h"

#include <cmath>
#include <numbers>

namespace crossray::test {

namespace {

EffectRay rayFrom(const glm::dvec3& origin, const glm::dvec3& dir)
{
    return {HitReason::kNone, origin, glm::normalize(dir), 0.0};
}

PlanarStatus statusOf(const Case& testCase, const EffectRay& ray)
{
    return findPlanarPlace(testCase.camera, testCase.probes[0], ray).status;
}

} // namespace

// The mirrored camera itself, as a matrix of the other hand: the second derivation.
TEST(AnalyticPlanar, theMirroredCameraSeesTheSame)
{
    RandomStream random(11);
    int found = 0;
    for (int i = 0; i < 2000; ++i) {
        Case testCase = planarMirror();
        Probe& probe = testCase.probes[0];
        probe.mirror.normal = glm::normalize(glm::dvec3(random.next(-1, 1), random.next(-1, 1), 1));
        probe.mirror.position.z = random.next(-6, -2);
        if (i % 2 == 1) probe.mirror.fovYDegrees = 100.0; // of a square image
        const EffectRay ray =
            rayFrom({random.next(-2, 2), random.next(-2, 2), -4}, {random.next(-1, 1), random.next(-1, 1), 1});
        const PlanarPlace place = findPlanarPlace(testCase.camera, probe, ray);
        if (place.status != PlanarStatus::kOk) continue;
        const glm::dvec3 n = probe.mirror.normal;
        const glm::dmat3 reflection = glm::dmat3(1.0) - 2.0 * glm::outerProduct(n, n);
        const glm::dvec3 eye = 2.0 * glm::dot(probe.mirror.position, n) * n; // the origin's image
        const glm::dvec3 end = ray.originWS + 65504.0 * ray.dirWS;
        const glm::dvec3 view = glm::transpose(reflection) * (end - eye); // the camera's axes are the world's
        const bool isOwn = i % 2 == 1;
        const double slope = std::tan((isOwn ? 50.0 : 30.0) * std::numbers::pi / 180.0);
        const double aspect = isOwn ? 1.0 : 1.5;
        EXPECT_NEAR(place.uv.x, 0.5 + 0.5 * view.x / (-view.z * slope * aspect), 1e-9);
        EXPECT_NEAR(place.uv.y, 0.5 - 0.5 * view.y / (-view.z * slope), 1e-9);
        ++found;
    }
    EXPECT_GT(found, 200);
}

TEST(AnalyticPlanar, eachStatusHasItsReason)
{
    Case testCase = planarMirror();
    Probe& probe = testCase.probes[0];
    const EffectRay straight = rayFrom({0, 0, -4}, {0, 0, 1});
    EXPECT_EQ(statusOf(testCase, straight), PlanarStatus::kOk);
    EXPECT_EQ(statusOf(testCase, rayFrom({0, 0, -4}, {2, 0, 1})), PlanarStatus::kOutsideImage);
    EXPECT_EQ(statusOf(testCase, rayFrom({0, 0, -4}, {0, 0.1, -1})), PlanarStatus::kOpposed);
    probe.mirror.normal = glm::normalize(glm::dvec3(0, 1, 0.5)); // the capture looks along (0, 0.8, -0.6)
    EXPECT_EQ(statusOf(testCase, rayFrom({0, 0, -4}, {0, -1, 2.1})), PlanarStatus::kOpposed);
    probe.mirror.normal = {0, 0, 1};
    probe.proxy = {VolumeShape::kBox, {0, 0, -4.5}, glm::dmat3(1.0), {1, 1, 0.25}}; // behind the mirror
    EXPECT_EQ(statusOf(testCase, rayFrom({0, 0, -4.5}, {0.1, 0, 1})), PlanarStatus::kBehindNearPlane);
    probe.proxy = {};
    probe.mirror.fovYDegrees = 0.0;
    EXPECT_EQ(statusOf(testCase, straight), PlanarStatus::kNoFieldOfView);
    probe.mirror.fovYDegrees.reset();
    probe.mirror.position = {0, 0, 1};
    EXPECT_EQ(statusOf(testCase, straight), PlanarStatus::kCameraNotInFront);
    probe.mirror.position = {0, 0, -200}; // beyond the far plane
    EXPECT_EQ(statusOf(testCase, straight), PlanarStatus::kPlaneOutOfView);
    testCase.camera.depthConvention = DepthConvention::kInfiniteReversed;
    EXPECT_EQ(statusOf(testCase, straight), PlanarStatus::kOk);
}

TEST(AnalyticPlanar, probesShareByTheirVolumes)
{
    Case testCase = planarMirror();
    testCase.probes.push_back(testCase.probes[0]);
    testCase.probes[0].weight = 0.75;
    testCase.probes[0].multiplier = 2.0;
    testCase.probes[1].weight = 0.5;
    testCase.probes[1].influence.halfExtents *= 0.5; // smaller: it is asked first
    const SurfacePoint surface{{0, 0, -4}, {0, 0, 1}, {0, 0, 1}, 0};
    const PlanarShare share = sharePlanarProbes(testCase, surface, reflectAtSurface(surface));
    EXPECT_EQ(share.weight, 1.0);
    EXPECT_EQ(share.multiplied, 0.5 + 0.5 * 2.0);
    EXPECT_EQ(share.first.status, PlanarStatus::kOk);
    const SurfacePoint away{{0, 0, 4}, {0, 0, 1}, {0, 0, 1}, 0};
    EXPECT_EQ(sharePlanarProbes(testCase, away, reflectAtSurface(surface)).first.status, PlanarStatus::kNotAsked);
}

} // namespace crossray::test
