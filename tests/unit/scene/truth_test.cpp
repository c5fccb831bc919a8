#include "harness/scene/truth.h"

#include "harness/base/error.h"
#include "harness/scene/random_scene.h"
#include "tests/unit/scene/near.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

using namespace crossray;

namespace {

Primitive makePlane(const glm::dvec3& center, const glm::dvec3& x, const glm::dvec3& y, const char* material)
{
    Primitive plane;
    plane.center = center;
    plane.worldFromLocal = glm::dmat3(x, y, glm::cross(x, y));
    plane.material = material;
    return plane;
}

Primitive makeFloor(const char* material)
{
    return makePlane({0, 0, 0}, {1, 0, 0}, {0, 0, -1}, material);
} // normal +y
Primitive makeWall(double z)
{
    return makePlane({0, 0, z}, {1, 0, 0}, {0, 1, 0}, "diffuse");
} // normal +z

Camera makeCamera(const glm::dvec3& eye, const glm::dvec3& target)
{
    Camera camera;
    camera.worldFromView = makeLookAt(eye, target, {0, 1, 0});
    return camera;
}

int countOf(const Truth& truth, ScreenKnowledge knowledge)
{
    int count = 0;
    for (const TruthPixel& pixel : truth.pixels)
        count += pixel.screen == knowledge ? 1 : 0;
    return count;
}

} // namespace

// In a mirror floor the wall z = -6 is seen where the ray from the mirrored eye meets it.
TEST(Truth, MirrorFloorShowsTheWall)
{
    Scene scene;
    scene.primitives = {makeFloor("mirror"), makeWall(-6.0)};
    const glm::dvec3 eye(0.3, 2.0, 4.0);
    const Camera camera = makeCamera(eye, {0, 0.5, -2});
    const Truth truth = computeTruth(scene, camera, TraceEffect::kReflection);
    int rays = 0;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            const TruthPixel& pixel = truth.at(x, y);
            if (pixel.screen == ScreenKnowledge::kNoRay) continue;
            ++rays;
            const glm::dvec3 view = computePrimaryRay(camera, {x + 0.5, y + 0.5}).dirWS;
            const glm::dvec3 mirroredEye(eye.x, -eye.y, eye.z);
            const glm::dvec3 dir(view.x, -view.y, view.z);
            expectNear(pixel.rayDirWS, dir, 1e-14);
            const double distance = (-6.0 - mirroredEye.z) / dir.z;
            ASSERT_GT(distance, 0.0);
            expectNear(pixel.hitPositionWS, mirroredEye + distance * dir, 1e-12);
            const ScreenPoint point = projectToScreen(camera, pixel.hitPositionWS);
            EXPECT_EQ(pixel.hitLinearDepth, point.linearDepth);
            EXPECT_EQ(pixel.screen, point.onScreen ? ScreenKnowledge::kVisible : ScreenKnowledge::kOffScreen);
        }
    EXPECT_GT(rays, 1000);
    EXPECT_GT(countOf(truth, ScreenKnowledge::kVisible), 500);
    EXPECT_EQ(countOf(truth, ScreenKnowledge::kHidden), 0);
}

TEST(Truth, SeesSkyAndWhatIsBehindTheCamera)
{
    Scene scene;
    scene.primitives = {makeFloor("mirror")};
    const Camera camera = makeCamera({0, 2, 4}, {0, 0.5, -2});
    const Truth sky = computeTruth(scene, camera, TraceEffect::kReflection);
    EXPECT_GT(countOf(sky, ScreenKnowledge::kSky), 1000);
    const TruthPixel& pixel = sky.at(32, 60);
    expectNear(pixel.radiance, computeSkyRadiance(scene, pixel.rayDirWS), 1e-15);
    // A mirror that faces the camera shows what is behind it.
    scene.primitives = {makePlane({0, 0, -4}, {1, 0, 0}, {0, 1, 0}, "mirror"), makeWall(5.0)};
    const Truth behind = computeTruth(scene, makeCamera({0, 0, 0}, {0, 0, -1}), TraceEffect::kReflection);
    EXPECT_EQ(countOf(behind, ScreenKnowledge::kOffScreen), 64 * 64);
}

// Over the floor floats a plate that is seen from above; the floor's mirror shows its underside.
TEST(Truth, TheBackOfAThinPlateIsHidden)
{
    Scene scene;
    Primitive plate = makeFloor("diffuse");
    plate.center = {0, 0.5, 0};
    plate.halfExtents = {1.0, 1.0, kNoLimit};
    scene.primitives = {makeFloor("mirror"), plate};
    const Camera camera = makeCamera({0, 3, 4}, {0, 0, 0});
    const Truth truth = computeTruth(scene, camera, TraceEffect::kReflection);
    EXPECT_EQ(countOf(truth, ScreenKnowledge::kVisible), 0);
    EXPECT_GT(countOf(truth, ScreenKnowledge::kHidden), 50);
}

TEST(Truth, WhatStandsBehindAnObjectIsHidden)
{
    Scene scene;
    Primitive block;
    block.shape = PrimitiveShape::kBox;
    block.center = {0, 1.2, -2};
    block.halfExtents = {20, 0.5, 0.5};
    scene.primitives = {makeFloor("mirror"), makeWall(-6.0), block};
    const Camera camera = makeCamera({0, 1.2, 4}, {0, 1.2, -2});
    const Truth truth = computeTruth(scene, camera, TraceEffect::kReflection);
    int checked = 0;
    for (const TruthPixel& pixel : truth.pixels) {
        if (pixel.screen == ScreenKnowledge::kNoRay || pixel.screen == ScreenKnowledge::kSky) continue;
        if (std::abs(pixel.hitPositionWS.z + 6.0) > 1e-9) continue; // the block itself
        // The block's front face at z = -1.5 covers heights from 0.7 to 1.7 as seen from the eye, its back edges
        // nothing more.
        const double height = 1.2 + (pixel.hitPositionWS.y - 1.2) * 5.5 / 10.0;
        if (pixel.screen == ScreenKnowledge::kOffScreen) continue;
        EXPECT_EQ(pixel.screen == ScreenKnowledge::kHidden, height > 0.7 && height < 1.7);
        ++checked;
    }
    EXPECT_GT(checked, 50);
    EXPECT_GT(countOf(truth, ScreenKnowledge::kHidden), 10);
}

TEST(Truth, AConvexMirrorDoesNotReflectItselfAndARoomDoes)
{
    Scene scene;
    Primitive ball;
    ball.shape = PrimitiveShape::kSphere;
    ball.center = {0, 0, -4};
    ball.material = "mirror";
    scene.primitives = {ball};
    const Truth outside = computeTruth(scene, makeCamera({0, 0, 0}, {0, 0, -1}), TraceEffect::kReflection);
    EXPECT_GT(countOf(outside, ScreenKnowledge::kSky), 200);
    EXPECT_EQ(countOf(outside, ScreenKnowledge::kSky) + countOf(outside, ScreenKnowledge::kNoRay), 64 * 64);
    ball.center = {0, 0, 0};
    ball.radius = 3.0;
    scene.primitives = {ball};
    const Truth inside = computeTruth(scene, makeCamera({0.5, 0.2, 0}, {0, 0, -1}), TraceEffect::kReflection);
    for (const TruthPixel& pixel : inside.pixels) {
        ASSERT_NE(pixel.screen, ScreenKnowledge::kNoRay);
        ASSERT_NE(pixel.screen, ScreenKnowledge::kSky);
        ASSERT_GT(glm::length(pixel.hitPositionWS - pixel.rayOriginWS), 0.1);
        ASSERT_NEAR(glm::length(pixel.hitPositionWS), 3.0, 1e-12);
    }
}

TEST(Truth, GlassSphereBendsTowardsItsAxis)
{
    Scene scene;
    Primitive ball;
    ball.shape = PrimitiveShape::kSphere;
    ball.center = {0, 0, -4};
    ball.material = "glass";
    scene.primitives = {ball, makeWall(-20.0)};
    const Camera camera = makeCamera({0, 0, 0}, {0, 0, -1});
    const Truth truth = computeTruth(scene, camera, TraceEffect::kRefraction);
    int rays = 0;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            const TruthPixel& pixel = truth.at(x, y);
            if (pixel.screen == ScreenKnowledge::kNoRay) continue;
            ++rays;
            EXPECT_NEAR(glm::length(pixel.rayOriginWS - ball.center), 1.0, 1e-13);
            EXPECT_LE(pixel.pathLength, 2.0);
            EXPECT_GE(pixel.pathLength, 2.0 * std::sqrt(1.0 - 1.0 / 2.25) - 1e-9); // grazing
            const glm::dvec3 view = computePrimaryRay(camera, {x + 0.5, y + 0.5}).dirWS;
            EXPECT_LT(pixel.rayDirWS.x * view.x, 0.0); // turned over
            const TruthPixel& mirrored = truth.at(63 - x, y);
            expectNear(pixel.rayDirWS, {-mirrored.rayDirWS.x, mirrored.rayDirWS.y, mirrored.rayDirWS.z}, 1e-11);
        }
    EXPECT_GT(rays, 150);
}

TEST(Truth, GlassInTheWayHidesWhatIsSeenThroughIt)
{
    Scene scene;
    Primitive slab;
    slab.shape = PrimitiveShape::kBox;
    slab.center = {0, 0, -3};
    slab.halfExtents = {10, 10, 0.1};
    slab.material = "glass";
    scene.primitives = {slab, makeWall(-6.0)};
    const Truth truth = computeTruth(scene, makeCamera({0, 0, 0}, {0, 0, -1}), TraceEffect::kRefraction);
    EXPECT_EQ(countOf(truth, ScreenKnowledge::kHidden), 64 * 64);
    scene.primitives = {slab};
    const Truth empty = computeTruth(scene, makeCamera({0, 0, -3}, {0, 0, -4}), TraceEffect::kRefraction);
    EXPECT_EQ(countOf(empty, ScreenKnowledge::kNoRay), 64 * 64); // the camera is inside
}

// At the edges of a glass cube rays meet the next face beyond the critical angle.
TEST(Truth, TotalInternalReflectionHasNoRay)
{
    Scene scene;
    Primitive cube;
    cube.shape = PrimitiveShape::kBox;
    cube.center = {0.6, 0, -4};
    cube.halfExtents = {1, 1, 3};
    cube.material = "glass";
    scene.primitives = {cube};
    const Truth truth = computeTruth(scene, makeCamera({-2, 0, 0}, {0.6, 0, -4}), TraceEffect::kRefraction);
    int total = 0;
    for (const TruthPixel& pixel : truth.pixels)
        if (pixel.totalInternalReflection) {
            ++total;
            EXPECT_EQ(pixel.screen, ScreenKnowledge::kNoRay);
        }
    EXPECT_GT(total, 50);
    EXPECT_GT(countOf(truth, ScreenKnowledge::kSky), 50);
}

TEST(Truth, OrthographicMirror)
{
    Scene scene;
    scene.primitives = {makeFloor("mirror"), makeWall(-6.0)};
    Camera camera = makeCamera({0, 2, 4}, {0, 0.5, -2});
    camera.projection = ProjectionKind::kOrthographic;
    camera.orthographicHeight = 6.0;
    const Truth truth = computeTruth(scene, camera, TraceEffect::kReflection);
    const glm::dvec3 view = -glm::dvec3(camera.worldFromView[2]);
    for (const TruthPixel& pixel : truth.pixels)
        if (pixel.screen != ScreenKnowledge::kNoRay) expectNear(pixel.rayDirWS, {view.x, -view.y, view.z}, 1e-14);
    EXPECT_GT(countOf(truth, ScreenKnowledge::kVisible), 100);
}

// Invariants over the whole family: what is called visible is the first surface of its own camera ray.
TEST(Truth, RandomRoomsKeepTheirWord)
{
    for (uint64_t seed = 0; seed < 12; ++seed) {
        const Scene scene = makeRandomRoom(seed);
        const Camera camera = makeRandomRoomCamera(seed, 48, 27);
        const Truth truth = computeTruth(scene, camera, TraceEffect::kReflection);
        EXPECT_GT(countOf(truth, ScreenKnowledge::kVisible), 48 * 27 / 20);
        for (const TruthPixel& pixel : truth.pixels) {
            if (pixel.screen != ScreenKnowledge::kVisible && pixel.screen != ScreenKnowledge::kHidden) continue;
            const auto hit = castRay(scene, {pixel.rayOriginWS, pixel.rayDirWS}, 1e-9);
            ASSERT_TRUE(hit);
            ASSERT_LE(glm::length(hit->positionWS - pixel.hitPositionWS), 1e-9);
            const auto seen = castRay(scene, computePrimaryRay(camera, pixel.hitPositionSS));
            ASSERT_TRUE(seen);
            if (pixel.screen == ScreenKnowledge::kHidden) continue;
            ASSERT_LE(glm::length(seen->positionWS - pixel.hitPositionWS), 1e-5);
        }
    }
}

// Nothing in the tracer is a length of its own: a world a hundred times larger or smaller has the same answers.
TEST(Truth, DoesNotDependOnTheUnitOfLength)
{
    for (const double scale : {100.0, 0.01})
        for (uint64_t seed = 20; seed < 24; ++seed) {
            Scene scene = makeRandomRoom(seed);
            Camera camera = makeRandomRoomCamera(seed, 48, 27);
            const Truth truth = computeTruth(scene, camera, TraceEffect::kReflection);
            for (Primitive& primitive : scene.primitives) {
                primitive.center *= scale;
                primitive.halfExtents *= scale;
                primitive.radius *= scale;
            }
            for (int row = 0; row < 3; ++row)
                camera.worldFromView[3][row] *= scale;
            camera.nearDistance *= scale;
            camera.farDistance *= scale;
            const Truth scaled = computeTruth(scene, camera, TraceEffect::kReflection);
            for (size_t i = 0; i < truth.pixels.size(); ++i) {
                ASSERT_EQ(truth.pixels[i].screen, scaled.pixels[i].screen);
                expectNear(scaled.pixels[i].rayDirWS, truth.pixels[i].rayDirWS, 1e-10);
                expectNear(scaled.pixels[i].hitPositionWS / scale, truth.pixels[i].hitPositionWS, 1e-8);
            }
        }
}

TEST(Truth, RejectsBrokenInput)
{
    Scene scene;
    scene.primitives = {makeFloor("glass")};
    EXPECT_THROW(computeTruth(scene, Camera{}, TraceEffect::kRefraction), InputError);
    EXPECT_THROW(computeTruth(Scene{}, Camera{.width = 0}, TraceEffect::kReflection), InputError);
}
