#include "harness/bench/jitter.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace crossray;

namespace {

constexpr uint8_t kNone = 0, kHit = 1, kMiss = 2;

Camera makeCamera(ProjectionKind projection)
{
    Camera camera;
    camera.projection = projection;
    camera.width = 64;
    camera.height = 32;
    camera.worldFromView = makeLookAt({1, 2, 3}, {0, 0, -4}, {0, 1, 0});
    return camera;
}

} // namespace

TEST(Jitter, movesTheImageByAHundredthOfAPixelEachWay)
{
    for (const ProjectionKind projection : {ProjectionKind::kPerspective, ProjectionKind::kOrthographic}) {
        const Camera camera = makeCamera(projection);
        const glm::dvec3 ahead = unprojectFromScreen(camera, {32, 16}, 5.0);
        glm::dvec2 sum(0.0);
        const std::vector<Camera> cameras = makeJitteredCameras(camera);
        ASSERT_EQ(cameras.size(), 16u);
        for (const Camera& moved : cameras) {
            const glm::dvec2 shift = projectToScreen(moved, ahead).positionSS - glm::dvec2(32, 16);
            EXPECT_NEAR(glm::length(shift), 0.01, 1e-8);
            sum += shift;
        }
        EXPECT_NEAR(glm::length(sum), 0.0, 1e-7); // all the way round
    }
}

TEST(Jitter, keepsTheEyeAndStaysRigid)
{
    const Camera camera = makeCamera(ProjectionKind::kPerspective);
    for (const Camera& moved : makeJitteredCameras(camera)) {
        EXPECT_EQ(moved.worldFromView[3], camera.worldFromView[3]);
        for (int column = 0; column < 3; ++column)
            EXPECT_NEAR(glm::length(glm::dvec3(moved.worldFromView[column])), 1.0, 1e-14);
        EXPECT_NEAR(glm::determinant(moved.worldFromView), 1.0, 1e-14);
    }
}

TEST(Jitter, countsRaysOfBothViewsAlone)
{
    const ClassImage truthBefore{kHit, kHit, kNone, kMiss}, truthAfter{kHit, kNone, kHit, kMiss};
    FlipCount count;
    countFlips(truthBefore, truthAfter, {kHit, kHit, kHit, kHit}, {kMiss, kMiss, kMiss, kHit}, count);
    EXPECT_EQ(count.rays, 2);
    EXPECT_EQ(count.flips, 1);
    EXPECT_EQ(count.share(), 0.5);
    EXPECT_EQ(FlipCount{}.share(), 0.0);
}

TEST(Jitter, aCoarseImageStandsForItsPixels)
{
    Plane plane("HitSuccess", 2, 1, 1);
    plane.values = {1, 2};
    EXPECT_EQ(classesOf(plane, 2, 5, 2), (ClassImage{1, 1, 2, 2, 2, 1, 1, 2, 2, 2}));
}

// A mirror floor before a wall of half the width: the true class changes where the wall's edge passes a ray, along one
// column, and nowhere on a wall without an edge.
TEST(Jitter, theTruthFlipsAtAnEdgeAlone)
{
    Case testCase;
    testCase.camera = makeCamera(ProjectionKind::kPerspective);
    testCase.camera.worldFromView = makeLookAt({0, 1, 3}, {0, 1, -4}, {0, 1, 0});
    Primitive floor;
    floor.worldFromLocal = glm::dmat3(glm::dvec3(1, 0, 0), glm::dvec3(0, 0, -1), glm::dvec3(0, 1, 0));
    floor.material = "mirror";
    Primitive wall;
    wall.center = {0, 0, -4};
    testCase.scene.primitives = {floor, wall};
    const auto flipsOf = [&] {
        const Truth truth = computeTruth(testCase.scene, testCase.camera, testCase.effect);
        return makeJitterViews(testCase, truth).truth;
    };
    const FlipCount whole = flipsOf();
    // The same wall, its edge on the ray of a column of pixel centres.
    const Ray ray = computePrimaryRay(testCase.camera, {40.5, 16.0});
    testCase.scene.primitives[1].halfExtents = {1, 50, 0};
    testCase.scene.primitives[1].center.x = 7.0 * ray.dirWS.x / -ray.dirWS.z - 1.0;
    const FlipCount edge = flipsOf();
    EXPECT_GT(whole.rays, 1000);
    EXPECT_GT(edge.flips, whole.flips + 16);
    EXPECT_LT(edge.share(), 0.05);
}
