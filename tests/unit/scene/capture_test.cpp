#include "harness/scene/capture.h"

#include "harness/base/error.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>

using namespace crossray;

namespace {

Primitive makeBox(const glm::dvec3& center, const glm::dvec3& halfExtents, const glm::dvec3& color)
{
    Primitive box;
    box.shape = PrimitiveShape::kBox;
    box.center = center;
    box.halfExtents = halfExtents;
    box.radiance.colorA = color;
    return box;
}

// A mirror that faces the middle of the room: its normal, +z or -z, points away from its own plane z.
Primitive makeMirror(double z, double halfWidth, const glm::dvec3& color)
{
    Primitive mirror;
    mirror.center = {0, 0, z};
    if (z > 0) mirror.worldFromLocal = glm::dmat3({-1, 0, 0}, {0, 1, 0}, {0, 0, -1});
    mirror.halfExtents = {halfWidth, halfWidth, 1.0};
    mirror.material = "mirror";
    mirror.radiance.colorA = color;
    return mirror;
}

constexpr double kMirrorAt = 1.0; // metres from the capture position, along +z and -z
constexpr double kWallAt = 4.0;   // along x and y
const glm::dvec3 kWall(0.25, 0.5, 1.0);

// Two mirrors that face each other, in a box of one colour whose ends they cover.
Scene makeMirrorHall(const glm::dvec3& tint)
{
    Scene scene;
    scene.primitives = {makeBox({0, 0, 0}, {kWallAt, kWallAt, kMirrorAt}, kWall),
                        makeMirror(kMirrorAt - 1e-6, 1e3, tint), makeMirror(1e-6 - kMirrorAt, 1e3, tint)};
    return scene;
}

CaptureSettings makeHallSettings(int bounces)
{
    CaptureSettings settings;
    settings.size = 128;
    settings.bounces = bounces;
    settings.proxy = makeBox({0, 0, 0}, {kWallAt, kWallAt, kMirrorAt}, {});
    return settings;
}

// How many mirrors the capture can see one in another along `dir`. A ray of slope t (across over along z) meets the
// first at t * kMirrorAt from the middle and the opposite one at three times that; there the last capture is read, from
// the middle, so it is as if at slope 3t. Each reflection triples the slope until the ray meets the wall.
struct Reflections {
    double exact; // the number is its ceiling
    bool isClear; // farther from another number than the captures' texels can err
};

Reflections countReflections(const glm::dvec3& dir)
{
    const double slope = std::max(std::abs(dir.x), std::abs(dir.y)) / std::abs(dir.z);
    const double exact = std::max(std::log(kWallAt / (kMirrorAt * slope)) / std::log(3.0), 0.0);
    return {exact, slope > 0.02 && (exact == 0.0 || std::abs(exact - std::round(exact)) > 0.2)};
}

void forEachTexel(const Cubemap& cubemap,
                  const std::function<void(int face, int x, int y, const glm::dvec3& dir)>& visit)
{
    for (int face = 0; face < kCubeFaces; ++face)
        for (int y = 0; y < cubemap.size; ++y)
            for (int x = 0; x < cubemap.size; ++x)
                visit(face, x, y, computeCubeDirection(face, glm::dvec2(x + 0.5, y + 0.5) / double(cubemap.size)));
}

} // namespace

// Six walls of six colours, seen from a corner of the room: each texel shows the wall that its ray meets first.
TEST(Capture, EachFaceShowsItsWall)
{
    const std::array<glm::dvec3, 6> colors = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1}}};
    Scene room;
    for (int face = 0; face < 6; ++face) {
        const glm::dvec3 out = computeCubeDirection(face, {0.5, 0.5});
        room.primitives.push_back(makeBox(out * 3.5, glm::mix(glm::dvec3(3.0), glm::dvec3(0.5), glm::abs(out)),
                                          colors[static_cast<size_t>(face)]));
    }
    CaptureSettings settings;
    settings.size = 32;
    const Cubemap middle = captureCubemap(room, settings);
    ASSERT_EQ(middle.levelCount(), 6);
    forEachTexel(middle, [&](int face, int x, int y, const glm::dvec3&) {
        EXPECT_EQ(middle.at(0, face, x, y), colors[static_cast<size_t>(face)]);
    });
    for (int level = 0; level < 6; ++level) // a solid face is solid at each level
        EXPECT_EQ(middle.at(level, 3, 0, 0), colors[3]);

    settings.positionWS = {2.5, -2.0, 1.0};
    const Cubemap corner = captureCubemap(room, settings);
    forEachTexel(corner, [&](int face, int x, int y, const glm::dvec3& dir) {
        // Where the ray leaves the room of half side 3: the smallest of three distances.
        int nearest = -1;
        double least = 1e9;
        for (int axis = 0; axis < 3; ++axis) {
            const double distance = (std::copysign(3.0, dir[axis]) - settings.positionWS[axis]) / dir[axis];
            if (distance < least) least = distance, nearest = 2 * axis + (dir[axis] < 0.0 ? 1 : 0);
        }
        EXPECT_EQ(corner.at(0, face, x, y), colors[static_cast<size_t>(nearest)]) << face << " " << x << " " << y;
    });
}

TEST(Capture, TheSkyIsSeenByDirection)
{
    Scene scene;
    CaptureSettings settings;
    settings.size = 8;
    settings.positionWS = {100, -40, 7};
    const Cubemap sky = captureCubemap(scene, settings);
    forEachTexel(sky, [&](int face, int x, int y, const glm::dvec3& dir) {
        EXPECT_EQ(sky.at(0, face, x, y), computeSkyRadiance(scene, dir));
    });
}

TEST(Capture, OneFaceAloneLeavesTheOthersBlack)
{
    Scene scene;
    scene.primitives = {makeBox({0, 0, 0}, {2, 2, 2}, {1, 2, 3})};
    CaptureSettings settings;
    settings.size = 4;
    settings.face = 2;
    const Cubemap cubemap = captureCubemap(scene, settings);
    forEachTexel(cubemap, [&](int face, int x, int y, const glm::dvec3&) {
        EXPECT_EQ(cubemap.at(0, face, x, y), face == 2 ? glm::dvec3(1, 2, 3) : glm::dvec3(0.0));
    });
}

// The more often it is captured, the deeper the mirrors: what lies behind m reflections is seen from the m-th bounce
// on, dimmed m times, and is black before.
TEST(Capture, MirrorsShowAsManyReflectionsAsBounces)
{
    const glm::dvec3 tint(0.5, 1.0, 0.25);
    const Scene hall = makeMirrorHall(tint);
    for (int bounces = 0; bounces <= 4; ++bounces) {
        const Cubemap cubemap = captureCubemap(hall, makeHallSettings(bounces));
        int most = 0, checked = 0;
        forEachTexel(cubemap, [&](int face, int x, int y, const glm::dvec3& dir) {
            const Reflections seen = countReflections(dir);
            if (!seen.isClear) return;
            const int count = static_cast<int>(std::ceil(seen.exact));
            const glm::dvec3 dimmed = kWall * glm::dvec3(std::pow(tint.x, count), 1.0, std::pow(tint.z, count));
            const glm::dvec3 expected = count <= bounces ? dimmed : glm::dvec3(0.0);
            const glm::dvec3 actual = cubemap.at(0, face, x, y);
            ASSERT_LT(glm::length(actual - expected), 1e-15)
                << bounces << " bounces, face " << face << " (" << x << ", " << y << "), " << seen.exact;
            if (actual != glm::dvec3(0.0)) most = std::max(most, count);
            ++checked;
        });
        EXPECT_EQ(most, bounces);
        EXPECT_GT(checked, 60000);
    }
}

TEST(Capture, MirrorsShowTheirOwnRadianceWithoutBounces)
{
    const glm::dvec3 tint(0.5, 1.0, 0.25);
    CaptureSettings settings = makeHallSettings(0);
    settings.bounces.reset();
    const Cubemap cubemap = captureCubemap(makeMirrorHall(tint), settings);
    EXPECT_EQ(cubemap.at(0, 4, 64, 64), tint);
}

// Without a proxy a mirror is read by direction alone: what it shows does not depend on where it stands.
TEST(Capture, WithoutAProxyOnlyTheDirectionCounts)
{
    Scene scene; // a mirror floor under the sky
    Primitive floor;
    floor.worldFromLocal = glm::dmat3({1, 0, 0}, {0, 0, -1}, {0, 1, 0});
    floor.material = "mirror";
    floor.radiance.colorA = glm::dvec3(1.0);
    scene.primitives = {floor};
    CaptureSettings settings;
    settings.positionWS = {0, 3, 0};
    settings.size = 16;
    settings.bounces = 1;
    const Cubemap cubemap = captureCubemap(scene, settings);
    forEachTexel(cubemap, [&](int face, int x, int y, const glm::dvec3& dir) {
        const glm::dvec3 up(dir.x, std::abs(dir.y), dir.z); // its mirror image is a texel's centre, too
        EXPECT_LT(glm::length(cubemap.at(0, face, x, y) - computeSkyRadiance(scene, up)), 1e-12);
    });
}

TEST(Capture, GlassIsLeftOut)
{
    Scene scene;
    Primitive sphere;
    sphere.shape = PrimitiveShape::kSphere;
    sphere.radius = 2;
    sphere.material = "glass";
    scene.primitives = {sphere};
    CaptureSettings settings;
    settings.size = 4;
    forEachTexel(captureCubemap(scene, settings), [&](int face, int x, int y, const glm::dvec3& dir) {
        EXPECT_EQ(captureCubemap(scene, settings).at(0, face, x, y), computeSkyRadiance(scene, dir));
    });
}

TEST(Capture, WhatIsNotAllowedIsRefused)
{
    const auto refuse = [](const std::function<void(CaptureSettings&)>& change) {
        CaptureSettings settings;
        change(settings);
        EXPECT_THROW(captureCubemap(Scene{}, settings), InputError);
    };
    refuse([](CaptureSettings& s) { s.size = 48; });
    refuse([](CaptureSettings& s) { s.face = 6; });
    refuse([](CaptureSettings& s) { s.bounces = kMaxBounces + 1; });
    refuse([](CaptureSettings& s) { s.proxy = Primitive{}; });
}
