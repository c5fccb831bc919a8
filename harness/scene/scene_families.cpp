#include "harness/scene/scene_families.h"

#include "harness/scene/random_parts.h"

#include <array>
#include <cmath>

namespace crossray {

namespace {

constexpr uint64_t kFamilyCameraStream = 0x66616d696c790000ULL; // keeps the camera's numbers apart from the scene's
constexpr int kVault = 0;                                       // of a curved hall: its first primitive

const glm::dvec3 kX(1, 0, 0), kY(0, 1, 0), kZ(0, 0, 1);

struct Family {
    SceneFamily family;
    std::string_view name;
};
constexpr std::array<Family, 6> kFamilies{{{SceneFamily::kRandomRoom, "random_room"},
                                           {SceneFamily::kForest, "forest"},
                                           {SceneFamily::kStaircase, "staircase"},
                                           {SceneFamily::kTerrain, "terrain"},
                                           {SceneFamily::kCurvedHall, "curved_hall"},
                                           {SceneFamily::kPanels, "panels"}}};

Primitive makeBox(const glm::dvec3& center, const glm::dvec3& halfExtents)
{
    Primitive box;
    box.shape = PrimitiveShape::kBox;
    box.center = center;
    box.halfExtents = halfExtents;
    return box;
}

Primitive makeSphere(const glm::dvec3& center, double radius)
{
    Primitive sphere;
    sphere.shape = PrimitiveShape::kSphere;
    sphere.center = center;
    sphere.radius = radius;
    return sphere;
}

Primitive makeFloor(double reach)
{
    return makeWall({0, 0, 0}, kX, -kZ, reach, reach);
}

glm::dmat3 turnAbout(const glm::dvec3& axis, double cosine, double sine)
{
    const auto turned = [&](const glm::dvec3& v) {
        return v * cosine + glm::cross(axis, v) * sine + axis * (glm::dot(axis, v) * (1 - cosine));
    };
    return {turned(kX), turned(kY), turned(kZ)};
}

// A rotation by square roots alone: a unit quaternion from a point of the cube that lies in the ball (rejection).
glm::dmat3 drawRotation(RandomStream& random)
{
    double x = 0, y = 0, z = 0, w = 0, square = 0;
    do {
        x = random.next(-1, 1);
        y = random.next(-1, 1);
        z = random.next(-1, 1);
        w = random.next(-1, 1);
        square = x * x + y * y + z * z + w * w;
    } while (square > 1 || square < 0.01);
    const double length = std::sqrt(x * x + y * y + z * z);
    if (length < 1e-6) return glm::dmat3(1.0);
    const double half = w / std::sqrt(square), halfSine = length / std::sqrt(square);
    return turnAbout(glm::dvec3(x, y, z) / length, 2 * half * half - 1, 2 * half * halfSine);
}

Scene makeForest(RandomStream& random)
{
    Scene scene;
    scene.primitives.push_back(makeFloor(14));
    scene.primitives.push_back(makeWall({0, 3, -8}, kX, kY, 14, 3));
    for (int i = 0; i < 60; ++i) {
        const double halfWidth = random.next(0.02, 0.12);
        const double halfHeight = random.next(0.6, 2.2);
        const double x = random.next(-6, 6);
        const double z = random.next(-7, 3);
        scene.primitives.push_back(makeBox({x, halfHeight, z}, {halfWidth, halfHeight, halfWidth}));
    }
    return scene;
}

Scene makeStaircase(RandomStream& random)
{
    Scene scene;
    scene.primitives.push_back(makeFloor(12));
    const double rise = random.next(0.12, 0.3);
    const double run = random.next(0.25, 0.6);
    const double halfWidth = random.next(1.0, 2.5);
    const int steps = 10;
    double z = 1.5;
    for (int i = 0; i < steps; ++i) {
        const double height = rise * (i + 1);
        scene.primitives.push_back(makeBox({0, 0.5 * height, z - 0.5 * run}, {halfWidth, 0.5 * height, 0.5 * run}));
        z -= run;
    }
    scene.primitives.push_back(makeWall({0, 4, z}, kX, kY, 8, 4));
    const double parapet = random.next(0.05, 0.2);
    const double side = random.chance(0.5) ? 1.0 : -1.0;
    const double top = rise * steps * random.next(0.6, 1.0);
    scene.primitives.push_back(makeBox({side * (halfWidth + parapet), 0.5 * top, 1.5 - 0.5 * run * steps},
                                       {parapet, 0.5 * top, 0.5 * run * steps}));
    for (int i = 0; i < 3; ++i) {
        const double radius = random.next(0.08, 0.25);
        const double x = random.next(-0.8, 0.8) * halfWidth;
        const double step = std::floor(random.next(0, steps));
        scene.primitives.push_back(makeSphere({x, rise * (step + 1) + radius, 1.5 - (step + 0.5) * run}, radius));
    }
    return scene;
}

Scene makeTerrain(RandomStream& random)
{
    Scene scene;
    scene.primitives.push_back(makeFloor(14));
    const double relief = random.next(0.3, 1.6);
    for (int row = 0; row < 9; ++row) {
        for (int column = 0; column < 9; ++column) {
            const double share = random.next(0, 1);
            const double height = 0.1 + relief * share * random.next(0.2, 1);
            const double half = random.next(0.35, 0.5);
            scene.primitives.push_back(makeBox({column - 4.0, 0.5 * height, row - 6.0}, {half, 0.5 * height, half}));
        }
    }
    return scene;
}

Scene makeCurvedHall(RandomStream& random)
{
    Scene scene;
    const double radius = random.next(8, 12);
    const double depth = random.next(0.0, 0.5);
    scene.primitives.push_back(makeSphere({0, -depth * radius, 0}, radius));
    scene.primitives.push_back(makeFloor(radius));
    for (int i = 0; i < 8; ++i) { // balls on the floor, and domes that it cuts
        const double size = random.next(0.2, 1.2);
        const double sunk = random.chance(0.4) ? random.next(0.1, 0.8) : 0.0;
        const double x = random.next(-4, 4);
        const double z = random.next(-5, 2);
        scene.primitives.push_back(makeSphere({x, size * (1 - sunk), z}, size));
    }
    return scene;
}

Scene makePanels(RandomStream& random)
{
    Scene scene;
    scene.primitives.push_back(makeFloor(10));
    scene.primitives.push_back(makeWall({0, 3, -6}, kX, kY, 10, 3));
    scene.primitives.push_back(makeWall({-7, 3, 0}, -kZ, kY, 10, 3));
    for (int i = 0; i < 14; ++i) {
        Primitive panel = makeBox({0, 0, 0}, {0, 0, 0});
        panel.halfExtents.x = random.next(0.2, 1.2);
        panel.halfExtents.y = random.next(0.2, 1.2);
        panel.halfExtents.z = random.next(0.005, 0.02);
        panel.center.x = random.next(-4.5, 4.5);
        panel.center.y = random.next(0.3, 2.2);
        panel.center.z = random.next(-4.5, 2.5);
        panel.worldFromLocal = drawRotation(random);
        scene.primitives.push_back(panel);
    }
    return scene;
}

Scene makeUndressed(SceneFamily family, RandomStream& random)
{
    switch (family) {
    case SceneFamily::kForest:
        return makeForest(random);
    case SceneFamily::kStaircase:
        return makeStaircase(random);
    case SceneFamily::kTerrain:
        return makeTerrain(random);
    case SceneFamily::kCurvedHall:
        return makeCurvedHall(random);
    case SceneFamily::kPanels:
        return makePanels(random);
    case SceneFamily::kRandomRoom:
        break;
    }
    return {};
}

} // namespace

std::span<const SceneFamily> allSceneFamilies()
{
    static constexpr std::array kAll{SceneFamily::kRandomRoom, SceneFamily::kForest,     SceneFamily::kStaircase,
                                     SceneFamily::kTerrain,    SceneFamily::kCurvedHall, SceneFamily::kPanels};
    return kAll;
}

std::string_view nameOf(SceneFamily family)
{
    for (const Family& known : kFamilies) {
        if (known.family == family) return known.name;
    }
    return "";
}

std::optional<SceneFamily> findSceneFamily(std::string_view name)
{
    for (const Family& known : kFamilies) {
        if (known.name == name) return known.family;
    }
    return std::nullopt;
}

Scene makeRandomScene(SceneFamily family, uint64_t seed)
{
    if (family == SceneFamily::kRandomRoom) return makeRandomRoom(seed);
    RandomStream random(seed);
    Scene scene = makeUndressed(family, random);
    for (Primitive& primitive : scene.primitives)
        dress(primitive, random);
    return scene;
}

Camera makeRandomSceneCamera(SceneFamily family, uint64_t seed, int width, int height)
{
    if (family == SceneFamily::kRandomRoom) return makeRandomRoomCamera(seed, width, height);
    const Scene scene = makeRandomScene(family, seed);
    const int vault = family == SceneFamily::kCurvedHall ? kVault : -1;
    RandomStream random(seed ^ kFamilyCameraStream);
    const CameraRegion region{{-3.5, 0.6, 3.0}, {3.5, 3.5, 6.5}, {-1.5, 0.2, -3.0}, {1.5, 1.2, 0.5}};
    return drawCamera(random, scene, region, width, height, vault);
}

} // namespace crossray
