#include "harness/scene/gbuffer.h"

#include "harness/base/error.h"
#include "harness/scene/random_scene.h"
#include "tests/unit/scene/all_channels.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

using namespace crossray;

namespace {

glm::dvec3 vectorAt(const Plane& plane, int x, int y)
{
    return {plane.at(x, y, 0), plane.at(x, y, 1), plane.at(x, y, 2)};
}

} // namespace

TEST(GBuffer, AWallThatFacesTheCameraHasOneDepth)
{
    Scene scene;
    Primitive wall;
    wall.center = {0, 0, -4};
    scene.primitives = {wall};
    for (const DepthConvention convention :
         {DepthConvention::kStandard, DepthConvention::kReversed, DepthConvention::kInfiniteReversed}) {
        Camera camera;
        camera.depthConvention = convention;
        camera.width = 33;
        camera.height = 17;
        const GBuffer gbuffer = renderGBuffer(scene, camera, kAllChannels);
        for (int y = 0; y < 17; ++y)
            for (int x = 0; x < 33; ++x) {
                EXPECT_NEAR(gbuffer.plane(GBufferChannel::kLinearDepth).at(x, y), 4.0, 1e-14);
                EXPECT_NEAR(gbuffer.plane(GBufferChannel::kDeviceDepth).at(x, y), computeDeviceDepth(camera, 4.0),
                            1e-14);
                EXPECT_EQ(vectorAt(gbuffer.plane(GBufferChannel::kNormalWS), x, y), glm::dvec3(0, 0, 1));
                EXPECT_EQ(gbuffer.plane(GBufferChannel::kObjectIndex).at(x, y), 1.0);
                const ScreenPoint point =
                    projectToScreen(camera, vectorAt(gbuffer.plane(GBufferChannel::kPositionWS), x, y));
                EXPECT_NEAR(point.positionSS.x, x + 0.5, 1e-12);
                EXPECT_NEAR(point.positionSS.y, y + 0.5, 1e-12);
            }
    }
}

TEST(GBuffer, NoSurfaceIsClearedAndShowsTheSky)
{
    Scene scene;
    Camera camera;
    camera.depthConvention = DepthConvention::kStandard;
    const GBuffer gbuffer = renderGBuffer(scene, camera, kAllChannels);
    EXPECT_EQ(gbuffer.plane(GBufferChannel::kDeviceDepth).at(5, 5), 1.0);
    EXPECT_EQ(gbuffer.plane(GBufferChannel::kLinearDepth).at(5, 5), 0.0);
    EXPECT_EQ(gbuffer.plane(GBufferChannel::kObjectIndex).at(5, 5), 0.0);
    EXPECT_EQ(vectorAt(gbuffer.plane(GBufferChannel::kNormalWS), 5, 5), glm::dvec3(0.0));
    const glm::dvec3 sky = computeSkyRadiance(scene, computePrimaryRay(camera, {5.5, 5.5}).dirWS);
    EXPECT_LE(glm::length(vectorAt(gbuffer.plane(GBufferChannel::kColor), 5, 5) - sky), 1e-15);
}

TEST(GBuffer, CutsAtTheNearAndFarPlaneAndKeepsWhatLiesOnThem)
{
    Camera camera;
    camera.nearDistance = 0.3;
    camera.farDistance = 7.0;
    for (const double depth : {0.29, 0.3, 5.0, 7.0, 7.1}) {
        Scene scene;
        Primitive wall;
        wall.center = {0, 0, -depth};
        scene.primitives = {wall};
        const GBuffer gbuffer = renderGBuffer(scene, camera, kAllChannels);
        const bool shown = depth >= 0.3 && depth <= 7.0;
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x) {
                ASSERT_EQ(gbuffer.plane(GBufferChannel::kObjectIndex).at(x, y), shown ? 1.0 : 0.0) << depth;
                const double device = gbuffer.plane(GBufferChannel::kDeviceDepth).at(x, y);
                ASSERT_TRUE(device >= 0.0 && device <= 1.0);
            }
    }
}

TEST(GBuffer, NormalsFaceTheViewer)
{
    Scene scene;
    Primitive plane; // seen from behind
    plane.center = {0, 0, 4};
    Primitive room; // seen from inside
    room.shape = PrimitiveShape::kBox;
    room.halfExtents = glm::dvec3(6.0);
    scene.primitives = {plane, room};
    Camera camera;
    for (const double z : {-1.0, 1.0}) {
        camera.worldFromView = makeLookAt({0, 0, 0}, {0, 0, z}, {0, 1, 0});
        const GBuffer gbuffer = renderGBuffer(scene, camera, kAllChannels);
        EXPECT_EQ(vectorAt(gbuffer.plane(GBufferChannel::kNormalWS), 32, 32), glm::dvec3(0, 0, -z));
        EXPECT_EQ(gbuffer.plane(GBufferChannel::kObjectIndex).at(32, 32), z > 0.0 ? 1.0 : 2.0);
    }
}

TEST(GBuffer, OrthographicSphere)
{
    Scene scene;
    Primitive sphere;
    sphere.shape = PrimitiveShape::kSphere;
    sphere.center = {0, 0, -5};
    scene.primitives = {sphere};
    Camera camera;
    camera.projection = ProjectionKind::kOrthographic;
    camera.orthographicHeight = 4.0;
    camera.width = 80;
    camera.height = 40;
    const GBuffer gbuffer = renderGBuffer(scene, camera, kAllChannels);
    for (int y = 0; y < 40; ++y)
        for (int x = 0; x < 80; ++x) {
            const double u = (x + 0.5 - 40.0) * 0.1;
            const double v = (20.0 - y - 0.5) * 0.1;
            const double squared = 1.0 - u * u - v * v;
            EXPECT_NEAR(gbuffer.plane(GBufferChannel::kLinearDepth).at(x, y),
                        squared < 0.0 ? 0.0 : 5.0 - std::sqrt(squared), 1e-13);
        }
}

TEST(GBuffer, HoldsOnlyWhatWasAskedFor)
{
    const std::array<GBufferChannel, 1> one = {GBufferChannel::kNormalWS};
    const GBuffer gbuffer = renderGBuffer(makeRandomRoom(1), makeRandomRoomCamera(1, 16, 8), one);
    EXPECT_EQ(gbuffer.planes.size(), 1U);
    EXPECT_EQ(gbuffer.plane(GBufferChannel::kNormalWS).channels, 3);
    try {
        (void)gbuffer.plane(GBufferChannel::kColor);
        FAIL();
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("Color"), std::string::npos);
    }
    EXPECT_THROW(renderGBuffer(Scene{}, Camera{.width = 0}, one), InputError);
}
