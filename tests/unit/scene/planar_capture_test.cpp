#include "harness/scene/planar_capture.h"

#include "harness/base/error.h"
#include "harness/scene/truth.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace crossray;

namespace {

Primitive makeSphere(const glm::dvec3& center, double radius, const glm::dvec3& color)
{
    Primitive sphere;
    sphere.shape = PrimitiveShape::kSphere;
    sphere.center = center;
    sphere.radius = radius;
    sphere.radiance.colorA = color;
    return sphere;
}

// A mirror floor that is turned about z, with spheres over it and one below it.
Scene makeMirrorScene(double degrees)
{
    const double c = std::cos(degrees * 0.017453292519943295), s = std::sin(degrees * 0.017453292519943295);
    Primitive mirror;
    mirror.worldFromLocal = glm::dmat3({0, 0, 1}, {c, s, 0}, {-s, c, 0}); // local +z is the normal
    mirror.material = "mirror";
    Primitive wall;
    wall.center = {0, 0, -6};
    wall.radiance = {RadiancePattern::kChecker, {0.9, 0.1, 0.1}, {0.1, 0.1, 0.9}, 0.7, 1};
    Scene scene;
    scene.primitives = {mirror, wall, makeSphere({0.3, 0.9, -2}, 0.5, {0, 1, 0}),
                        makeSphere({-0.5, -2.0, -1}, 0.6, {1, 0, 1})};
    return scene;
}

MirrorPlane mirrorOf(const Scene& scene)
{
    return {scene.primitives[0].center, scene.primitives[0].worldFromLocal[2]};
}

Camera makeCamera(const glm::dvec3& eye, const glm::dvec3& target)
{
    Camera camera;
    camera.width = 48;
    camera.height = 32;
    camera.worldFromView = makeLookAt(eye, target, {0, 1, 0.01});
    return camera;
}

glm::dvec3 colorOf(const Plane& image, int x, int y)
{
    return {image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2)};
}

} // namespace

// At each pixel of the mirror the capture of that pixel is what the truth's reflected ray meets.
TEST(PlanarCapture, ShowsWhatTheMirrorReflects)
{
    for (const double degrees : {0.0, 12.0, -20.0})
        for (const ProjectionKind kind : {ProjectionKind::kPerspective, ProjectionKind::kOrthographic}) {
            const Scene scene = makeMirrorScene(degrees);
            Camera camera = makeCamera({0.2, 2.5, 3.0}, {0, 0, -1});
            camera.projection = kind;
            camera.orthographicHeight = 3;
            const Truth truth = computeTruth(scene, camera, TraceEffect::kReflection);
            PlanarCaptureSettings settings{mirrorOf(scene), camera.width, camera.height, {}};
            const Plane image = capturePlanar(scene, camera, settings);
            int compared = 0;
            for (int y = 0; y < camera.height; ++y)
                for (int x = 0; x < camera.width; ++x) {
                    const TruthPixel& pixel = truth.at(x, y);
                    if (pixel.screen == ScreenKnowledge::kNoRay) continue;
                    ++compared;
                    ASSERT_LT(glm::length(colorOf(image, x, y) - pixel.radiance), 1e-12)
                        << degrees << " " << x << " " << y;
                }
            EXPECT_GT(compared, 400);
        }
}

// The image is the camera's view through the mirror whatever its size: a pixel of an image of half the size stands
// where four pixels meet.
TEST(PlanarCapture, SizeChangesTheSamplesAlone)
{
    const Scene scene = makeMirrorScene(5.0);
    const Camera camera = makeCamera({0.2, 2.5, 3.0}, {0, 0, -1});
    const Plane small = capturePlanar(scene, camera, {mirrorOf(scene), 16, 32, {}});
    const Plane large = capturePlanar(scene, camera, {mirrorOf(scene), 48, 96, {}});
    for (int y = 0; y < small.height; ++y)
        for (int x = 0; x < small.width; ++x)
            EXPECT_EQ(colorOf(small, x, y), colorOf(large, 3 * x + 1, 3 * y + 1));
}

TEST(PlanarCapture, AFieldOfViewOfItsOwnFollowsTheImage)
{
    const Scene scene = makeMirrorScene(0.0);
    const Camera camera = makeCamera({0.2, 2.5, 3.0}, {0, 0, -1});
    PlanarCaptureSettings settings{mirrorOf(scene), 40, 40, 100.0};
    const Plane image = capturePlanar(scene, camera, settings);
    // The truth of a camera that has this field of view and shape.
    Camera wide = camera;
    wide.width = wide.height = 40;
    wide.fovYDegrees = 100.0;
    const Truth truth = computeTruth(scene, wide, TraceEffect::kReflection);
    for (int y = 0; y < 40; ++y)
        for (int x = 0; x < 40; ++x) {
            const TruthPixel& pixel = truth.at(x, y);
            if (pixel.screen == ScreenKnowledge::kNoRay) continue;
            EXPECT_LT(glm::length(colorOf(image, x, y) - pixel.radiance), 1e-12);
        }
}

// Without the near plane on the mirror the sphere below the floor would be in the picture.
TEST(PlanarCapture, NothingBehindTheMirrorIsSeen)
{
    Scene scene;
    scene.primitives = {makeSphere({0, -1, 0}, 0.9, {1, 0, 1})};
    const Camera camera = makeCamera({0, 2, 0}, {0, 0, 0}); // straight down, along the normal
    const Plane image = capturePlanar(scene, camera, {{}, 16, 16, {}});
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x)
            EXPECT_GT(image.at(x, y, 2), 0.5) << "the sky above is blue";
    EXPECT_EQ(findPlanarState(camera, {{}, 16, 16, {}}), PlanarState::kCaptured);
}

TEST(PlanarCapture, WhereThereIsNoCaptureItIsBlack)
{
    const Scene scene = makeMirrorScene(0.0);
    const auto stateAt = [&](double height, std::optional<double> fov) {
        const Camera camera = makeCamera({0.2, height, 3.0}, {0, height - 0.5, -1});
        const PlanarCaptureSettings settings{{}, 8, 8, fov};
        const Plane image = capturePlanar(scene, camera, settings);
        const bool isBlack = image.values == std::vector<double>(8 * 8 * 3, 0.0);
        EXPECT_EQ(isBlack, findPlanarState(camera, settings) != PlanarState::kCaptured);
        return findPlanarState(camera, settings);
    };
    EXPECT_EQ(stateAt(1.0, {}), PlanarState::kCaptured);
    EXPECT_EQ(stateAt(2e-4, {}), PlanarState::kCaptured);
    EXPECT_EQ(stateAt(1e-4, {}), PlanarState::kCameraNotInFront);
    EXPECT_EQ(stateAt(0.0, {}), PlanarState::kCameraNotInFront);
    EXPECT_EQ(stateAt(-1.0, {}), PlanarState::kCameraNotInFront);
    EXPECT_EQ(stateAt(1.0, 0.0), PlanarState::kNoFieldOfView);
    EXPECT_THROW(capturePlanar(scene, makeCamera({0, 1, 0}, {0, 0, -1}), {{}, 0, 8, {}}), InputError);
}
