#include "harness/scene/random_scene.h"

#include "harness/scene/random_parts.h"

namespace crossray {

namespace {

constexpr double kReach = 10.0; // metres: |x| and |z| of floor and walls
constexpr double kHeight = 6.0;
constexpr double kWallZ = -6.0;
constexpr double kWallX = -7.0;
constexpr uint64_t kRoomCameraStream = 0x63616d6572610000ULL; // keeps the camera's numbers apart from the room's

Primitive drawBox(RandomStream& random)
{
    Primitive box;
    box.shape = PrimitiveShape::kBox;
    box.halfExtents.x = random.next(0.15, 1.2);
    box.halfExtents.y = random.next(0.1, 1.2);
    box.halfExtents.z = random.next(0.15, 1.2);
    const bool raised = random.chance(0.4);
    const double lift = random.next(0.3, 1.5);
    box.center.x = random.next(-4.5, 4.5);
    box.center.y = box.halfExtents.y + (raised ? lift : 0.0);
    box.center.z = random.next(-4.5, 2.5);
    return box;
}

Primitive drawPole(RandomStream& random)
{
    Primitive pole;
    pole.shape = PrimitiveShape::kBox;
    const double halfWidth = random.next(0.02, 0.06);
    const double halfHeight = random.next(0.4, 1.3);
    pole.halfExtents = {halfWidth, halfHeight, halfWidth};
    pole.center.x = random.next(-4.5, 4.5);
    pole.center.y = halfHeight;
    pole.center.z = random.next(-4.5, 3.0);
    return pole;
}

Primitive drawSphere(RandomStream& random)
{
    Primitive sphere;
    sphere.shape = PrimitiveShape::kSphere;
    sphere.radius = random.next(0.25, 1.0);
    const bool raised = random.chance(0.3);
    const double lift = random.next(0.0, 1.0);
    sphere.center.x = random.next(-4.0, 4.0);
    sphere.center.y = sphere.radius + (raised ? lift : 0.0);
    sphere.center.z = random.next(-4.0, 3.0);
    return sphere;
}

} // namespace

uint64_t RandomStream::nextBits()
{
    state_ += 0x9e3779b97f4a7c15ULL;
    uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
}

double RandomStream::next(double low, double high)
{
    return low + (high - low) * (static_cast<double>(nextBits() >> 11) * 0x1p-53);
}

Scene makeRandomRoom(uint64_t seed)
{
    RandomStream random(seed);
    const glm::dvec3 x(1, 0, 0);
    const glm::dvec3 y(0, 1, 0);
    const glm::dvec3 z(0, 0, 1);
    Scene scene;
    scene.primitives.push_back(makeWall({0, 0, 0}, x, -z, kReach, kReach));                         // normal +y
    scene.primitives.push_back(makeWall({0, 0.5 * kHeight, kWallZ}, x, y, kReach, 0.5 * kHeight));  // normal +z
    scene.primitives.push_back(makeWall({kWallX, 0.5 * kHeight, 0}, -z, y, kReach, 0.5 * kHeight)); // normal +x
    for (int i = 0; i < 4; ++i)
        scene.primitives.push_back(drawBox(random));
    for (int i = 0; i < 6; ++i)
        scene.primitives.push_back(drawPole(random));
    for (int i = 0; i < 4; ++i)
        scene.primitives.push_back(drawSphere(random));
    for (Primitive& primitive : scene.primitives)
        dress(primitive, random);
    return scene;
}

Camera makeRandomRoomCamera(uint64_t seed, int width, int height)
{
    const Scene scene = makeRandomRoom(seed);
    RandomStream random(seed ^ kRoomCameraStream);
    const CameraRegion region{{-3.5, 0.4, 3.5}, {5.0, 4.5, 7.0}, {-1.5, 0.2, -2.5}, {1.5, 1.2, 0.5}};
    return drawCamera(random, scene, region, width, height);
}

} // namespace crossray
