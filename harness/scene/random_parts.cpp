#include "harness/scene/random_parts.h"

#include <cmath>

namespace crossray {

namespace {

constexpr double kEyeClearance = 0.4; // metres

glm::dvec3 drawColor(RandomStream& random)
{
    const double r = random.next(0.1, 1.0);
    const double g = random.next(0.1, 1.0);
    const double b = random.next(0.1, 1.0);
    return {r, g, b};
}

glm::dvec3 drawPoint(RandomStream& random, const glm::dvec3& low, const glm::dvec3& high)
{
    const double x = random.next(low.x, high.x);
    const double y = random.next(low.y, high.y);
    const double z = random.next(low.z, high.z);
    return {x, y, z};
}

double distanceToSolid(const Primitive& solid, const glm::dvec3& positionWS)
{
    const glm::dvec3 local = glm::transpose(solid.worldFromLocal) * (positionWS - solid.center);
    if (solid.shape == PrimitiveShape::kSphere) return glm::length(local) - solid.radius;
    return glm::length(glm::max(glm::abs(local) - solid.halfExtents, 0.0));
}

} // namespace

void dress(Primitive& primitive, RandomStream& random)
{
    primitive.material = "mirror";
    primitive.radiance.pattern = RadiancePattern::kChecker;
    primitive.radiance.colorA = drawColor(random);
    primitive.radiance.colorB = 0.4 * primitive.radiance.colorA;
    primitive.radiance.cellSize = 0.5;
}

Primitive makeWall(const glm::dvec3& center, const glm::dvec3& xAxis, const glm::dvec3& yAxis, double halfX,
                   double halfY)
{
    Primitive wall;
    wall.shape = PrimitiveShape::kPlane;
    wall.center = center;
    wall.worldFromLocal = glm::dmat3(xAxis, yAxis, glm::cross(xAxis, yAxis));
    wall.halfExtents = {halfX, halfY, kNoLimit};
    return wall;
}

bool isClear(const Scene& scene, const glm::dvec3& eyeWS, int vault)
{
    for (size_t i = 0; i < scene.primitives.size(); ++i) {
        const Primitive& primitive = scene.primitives[i];
        if (primitive.shape == PrimitiveShape::kPlane) continue;
        const double distance = distanceToSolid(primitive, eyeWS);
        if ((static_cast<int>(i) == vault ? -distance : distance) < kEyeClearance) return false;
    }
    return true;
}

Camera drawCamera(RandomStream& random, const Scene& scene, const CameraRegion& region, int width, int height,
                  int vault)
{
    glm::dvec3 eyeWS;
    do {
        eyeWS = drawPoint(random, region.eyeLow, region.eyeHigh);
    } while (!isClear(scene, eyeWS, vault));
    const glm::dvec3 targetWS = drawPoint(random, region.targetLow, region.targetHigh);
    Camera camera;
    camera.worldFromView = makeLookAt(eyeWS, targetWS, {0, 1, 0});
    camera.width = width;
    camera.height = height;
    return camera;
}

} // namespace crossray
