#include "harness/scene/camera.h"

#include "harness/base/error.h"
#include "harness/scene/random_scene.h"
#include "tests/unit/scene/near.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

using namespace crossray;

namespace {

std::vector<Camera> allConventions()
{
    std::vector<Camera> cameras;
    for (const ProjectionKind projection : {ProjectionKind::kPerspective, ProjectionKind::kOrthographic})
        for (const DepthConvention depth :
             {DepthConvention::kReversed, DepthConvention::kStandard, DepthConvention::kInfiniteReversed})
            for (const NdcDepthRange range : {NdcDepthRange::kZeroToOne, NdcDepthRange::kMinusOneToOne}) {
                if (projection == ProjectionKind::kOrthographic && depth == DepthConvention::kInfiniteReversed)
                    continue;
                Camera camera;
                camera.projection = projection;
                camera.depthConvention = depth;
                camera.ndcDepthRange = range;
                camera.worldFromView = makeLookAt({4.2, 2.0, -6.0}, {0.3, 0.7, 0.1}, {0.1, 1.0, 0.2});
                camera.fovYDegrees = 47.0;
                camera.orthographicHeight = 7.0;
                camera.width = 321;
                camera.height = 180;
                cameras.push_back(camera);
            }
    return cameras;
}

std::string messageOf(const Camera& camera)
{
    try {
        validateCamera(camera);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

} // namespace

TEST(Camera, LookAtPutsTheTargetInTheMiddle)
{
    const glm::dvec3 target(0.3, 0.7, 0.1);
    for (const Camera& camera : allConventions()) {
        const ScreenPoint point = projectToScreen(camera, target);
        EXPECT_NEAR(point.positionSS.x, 160.5, 1e-10);
        EXPECT_NEAR(point.positionSS.y, 90.0, 1e-10);
        EXPECT_TRUE(point.onScreen);
        EXPECT_NEAR(point.linearDepth, glm::length(target - glm::dvec3(4.2, 2.0, -6.0)), 1e-12);
    }
}

TEST(Camera, RowZeroIsTheTopAndColumnZeroTheLeft)
{
    Camera camera; // at the origin, looking down -z
    camera.width = 100;
    camera.height = 50;
    const double top = 3.0 * std::tan(30.0 * 3.14159265358979323846 / 180.0);
    const ScreenPoint corner = projectToScreen(camera, {-2.0 * top, top, -3.0});
    EXPECT_NEAR(corner.positionSS.x, 0.0, 1e-12);
    EXPECT_NEAR(corner.positionSS.y, 0.0, 1e-12);
    EXPECT_FALSE(projectToScreen(camera, {-2.0 * top - 1e-6, 0.0, -3.0}).onScreen);
    EXPECT_FALSE(projectToScreen(camera, {0.0, 0.0, 1.0}).inFront);
}

TEST(Camera, ProjectionRoundTripInEveryConvention)
{
    RandomStream random(1);
    for (const Camera& camera : allConventions())
        for (int i = 0; i < 500; ++i) {
            const double x = random.next(-20.0, 340.0);
            const double y = random.next(-20.0, 200.0);
            const double depth = random.next(0.05, 120.0);
            const glm::dvec3 point = unprojectFromScreen(camera, {x, y}, depth);
            const ScreenPoint screen = projectToScreen(camera, point);
            EXPECT_NEAR(screen.positionSS.x, x, 1e-9);
            EXPECT_NEAR(screen.positionSS.y, y, 1e-9);
            EXPECT_NEAR(screen.linearDepth, depth, 1e-12 * (1.0 + depth) * 10.0);
            EXPECT_EQ(screen.onScreen, x >= 0.0 && x <= 321.0 && y >= 0.0 && y <= 180.0);
            const Ray ray = computePrimaryRay(camera, {x, y});
            EXPECT_NEAR(glm::length(ray.dirWS), 1.0, 1e-15);
            const double along = glm::dot(point - ray.originWS, ray.dirWS);
            expectNear(ray.originWS + along * ray.dirWS, point, 1e-11);
        }
}

TEST(Camera, ClipMatrixAgreesWithTheScreenPoint)
{
    RandomStream random(2);
    for (const Camera& camera : allConventions()) {
        const glm::dmat4 clipFromWorld = computeClipFromView(camera) * computeViewFromWorld(camera);
        for (int i = 0; i < 200; ++i) {
            const double x = random.next(0.0, 321.0);
            const double y = random.next(0.0, 180.0);
            const glm::dvec3 point = unprojectFromScreen(camera, {x, y}, random.next(0.1, 100.0));
            const glm::dvec4 clip = clipFromWorld * glm::dvec4(point, 1.0);
            const glm::dvec3 ndc = glm::dvec3(clip) / clip.w;
            const double device = camera.ndcDepthRange == NdcDepthRange::kZeroToOne ? ndc.z : 0.5 * ndc.z + 0.5;
            const ScreenPoint screen = projectToScreen(camera, point);
            EXPECT_NEAR((0.5 + 0.5 * ndc.x) * 321.0, screen.positionSS.x, 1e-9);
            EXPECT_NEAR((0.5 - 0.5 * ndc.y) * 180.0, screen.positionSS.y, 1e-9);
            EXPECT_NEAR(device, screen.deviceDepth, 1e-13);
        }
    }
}

TEST(Camera, DeviceDepthRunsFromNearToFar)
{
    for (Camera camera : allConventions()) {
        const bool standard = camera.depthConvention == DepthConvention::kStandard;
        EXPECT_EQ(computeDeviceDepth(camera, camera.nearDistance), standard ? 0.0 : 1.0);
        if (camera.depthConvention != DepthConvention::kInfiniteReversed)
            EXPECT_EQ(computeDeviceDepth(camera, camera.farDistance), standard ? 1.0 : 0.0);
        else
            EXPECT_GT(computeDeviceDepth(camera, 1e6), 0.0);
        EXPECT_EQ(clearedDeviceDepth(camera), standard ? 1.0 : 0.0);
        double before = computeDeviceDepth(camera, 0.1);
        for (double depth = 0.11; depth < 100.0; depth *= 1.1) {
            const double now = computeDeviceDepth(camera, depth);
            EXPECT_TRUE(standard ? now > before : now < before);
            before = now;
        }
    }
}

// Reversed depth keeps its precision over any ratio. Standard depth has 1 - d = near / z there: an ULP of d near 1 is
// worth z / near ULP of z, and no formula can bring that back.
TEST(Camera, DeviceDepthRoundTripAtANearToFarRatioOfAHundredThousand)
{
    for (Camera camera : allConventions()) {
        camera.nearDistance = 0.01;
        camera.farDistance = 2000.0;
        for (double depth = 0.01; depth < 2000.0; depth *= 1.3) {
            const double back = computeLinearDepth(camera, computeDeviceDepth(camera, depth));
            double bound = 4e-16;
            if (camera.projection == ProjectionKind::kOrthographic)
                bound = 1e-15 * 2000.0 / depth;
            else if (camera.depthConvention == DepthConvention::kStandard)
                bound = 2.3e-16 * (depth / camera.nearDistance + 4.0);
            EXPECT_LE(std::abs(back - depth), bound * depth * 2.0) << depth;
        }
    }
}

TEST(Camera, KnownDepthValues)
{
    Camera camera; // near 0.1, far 100
    camera.depthConvention = DepthConvention::kStandard;
    EXPECT_NEAR(computeDeviceDepth(camera, 0.2), 100.0 / 99.9 * 0.5, 1e-15);
    camera.depthConvention = DepthConvention::kReversed;
    EXPECT_NEAR(computeDeviceDepth(camera, 0.2), 99.8 / 99.9 * 0.5, 1e-15);
    camera.depthConvention = DepthConvention::kInfiniteReversed;
    EXPECT_EQ(computeDeviceDepth(camera, 0.2), 0.5);
    camera.projection = ProjectionKind::kOrthographic;
    camera.depthConvention = DepthConvention::kReversed;
    EXPECT_NEAR(computeDeviceDepth(camera, 25.075), 0.75, 1e-15);
}

TEST(Camera, RejectsWhatCannotBeACamera)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(messageOf(Camera{}), "");
    std::vector<Camera> broken(13);
    broken[0].width = 0;
    broken[1].height = 40000;
    broken[2].fovYDegrees = nan;
    broken[3].fovYDegrees = 180.0;
    broken[4].nearDistance = 0.0;
    broken[5].farDistance = 0.1;
    broken[6].farDistance = std::numeric_limits<double>::infinity();
    broken[7].worldFromView[3][0] = nan;
    broken[8].worldFromView[0] *= 2.0;
    broken[9].worldFromView[0] *= -1.0; // a mirror image
    broken[10].projection = ProjectionKind::kOrthographic;
    broken[10].orthographicHeight = -1.0;
    broken[11].projection = ProjectionKind::kOrthographic;
    broken[11].depthConvention = DepthConvention::kInfiniteReversed;
    broken[12].worldFromView[0][3] = 0.1;
    for (size_t i = 0; i < broken.size(); ++i)
        EXPECT_NE(messageOf(broken[i]).find("allowed:"), std::string::npos) << "camera " << i;
    Camera infinite;
    infinite.depthConvention = DepthConvention::kInfiniteReversed;
    infinite.farDistance = nan; // ignored
    EXPECT_EQ(messageOf(infinite), "");
}

TEST(Camera, LookAtRejectsADegenerateView)
{
    EXPECT_THROW(makeLookAt({1, 2, 3}, {1, 2, 3}, {0, 1, 0}), InputError);
    EXPECT_THROW(makeLookAt({0, 5, 0}, {0, 0, 0}, {0, 1, 0}), InputError);
    EXPECT_THROW(makeLookAt({0, std::numeric_limits<double>::quiet_NaN(), 0}, {0, 0, 0}, {0, 1, 0}), InputError);
}

// Between the near plane and the far one a stored depth is never further off than half a step.
TEST(Camera, DepthFormatsRoundByHalfAStep)
{
    Camera camera;
    for (const ProjectionKind kind : {ProjectionKind::kPerspective, ProjectionKind::kOrthographic}) {
        for (const DepthConvention convention : {DepthConvention::kReversed, DepthConvention::kStandard}) {
            for (const auto& [format, steps] :
                 {std::pair{DepthFormat::kUnorm24, 16777215.0}, std::pair{DepthFormat::kUnorm16, 65535.0}}) {
                camera.projection = kind;
                camera.depthConvention = convention;
                camera.depthFormat = format;
                double worst = 0;
                for (double depth = 0.1; depth < 100; depth *= 1.0037) {
                    const double exact = computeDeviceDepth(camera, depth);
                    const double stored = roundDeviceDepth(camera, exact);
                    EXPECT_LE(std::abs(stored - exact), 0.5000001 / steps);
                    EXPECT_NEAR(stored * steps, std::round(stored * steps), 1e-6);
                    const double back = computeLinearDepth(camera, stored);
                    const bool isOrthographic = kind == ProjectionKind::kOrthographic;
                    worst = std::max(worst, isOrthographic ? std::abs(back - depth) : std::abs(1 / back - 1 / depth));
                }
                const double bound = computeAffineDepthError(camera);
                EXPECT_LE(worst, bound * 1.0001);
                EXPECT_GT(worst, bound * 0.9) << "and not much less";
            }
        }
    }
    camera = {};
    EXPECT_EQ(roundDeviceDepth(camera, 0.123456789), 0.123456789);
    EXPECT_EQ(computeAffineDepthError(camera), 0.0) << "a reversed float";
}
