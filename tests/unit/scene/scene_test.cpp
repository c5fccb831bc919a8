#include "harness/scene/scene.h"

#include "harness/base/error.h"
#include "harness/scene/random_scene.h"
#include "tests/unit/scene/near.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

using namespace crossray;

namespace {

Primitive makeSphere(const glm::dvec3& center, double radius)
{
    Primitive sphere;
    sphere.shape = PrimitiveShape::kSphere;
    sphere.center = center;
    sphere.radius = radius;
    return sphere;
}

Primitive makeBox(const glm::dvec3& center, const glm::dvec3& half)
{
    Primitive box;
    box.shape = PrimitiveShape::kBox;
    box.center = center;
    box.halfExtents = half;
    return box;
}

glm::dmat3 rotationAbout(const glm::dvec3& axis, double radians)
{
    const glm::dvec3 a = glm::normalize(axis);
    const double c = std::cos(radians);
    const double s = std::sin(radians);
    const glm::dmat3 cross(0, a.z, -a.y, -a.z, 0, a.x, a.y, -a.x, 0);
    return c * glm::dmat3(1.0) + s * cross + (1.0 - c) * glm::outerProduct(a, a);
}

glm::dvec3 drawPoint(RandomStream& random, double extent)
{
    const double x = random.next(-extent, extent);
    const double y = random.next(-extent, extent);
    const double z = random.next(-extent, extent);
    return {x, y, z};
}

} // namespace

TEST(Intersection, SphereAlongItsAxis)
{
    const auto hits = intersectPrimitive(makeSphere({0, 0, -4}, 1.0), {{0, 0, 0}, {0, 0, -1}});
    ASSERT_EQ(hits.size(), 2U);
    EXPECT_DOUBLE_EQ(hits[0].distance, 3.0);
    EXPECT_DOUBLE_EQ(hits[1].distance, 5.0);
    expectNear(hits[0].normalWS, {0, 0, 1}, 1e-15);
    expectNear(hits[1].normalWS, {0, 0, -1}, 1e-15);
    EXPECT_FALSE(hits[0].backFace);
    EXPECT_TRUE(hits[1].backFace);
    EXPECT_EQ(intersectPrimitive(makeSphere({0, 0, 4}, 1.0), {{0, 0, 0}, {0, 0, -1}}).size(), 2U); // behind: negative
    EXPECT_TRUE(intersectPrimitive(makeSphere({0, 1.5, -4}, 1.0), {{0, 0, 0}, {0, 0, -1}}).empty());
}

TEST(Intersection, ChordOfASphereHasItsClosedForm)
{
    RandomStream random(3);
    for (int i = 0; i < 1000; ++i) {
        const Primitive sphere = makeSphere(drawPoint(random, 5.0), random.next(0.1, 3.0));
        const double offset = random.next(0.0, 1.2) * sphere.radius;
        const glm::dvec3 dir = glm::normalize(drawPoint(random, 1.0));
        const glm::dvec3 side = glm::normalize(glm::cross(dir, drawPoint(random, 1.0)));
        const Ray ray{sphere.center + offset * side - random.next(0.0, 50.0) * dir, dir};
        const auto hits = intersectPrimitive(sphere, ray);
        ASSERT_EQ(hits.empty(), offset > sphere.radius);
        if (hits.empty()) continue;
        const double chord = 2.0 * std::sqrt(sphere.radius * sphere.radius - offset * offset);
        EXPECT_NEAR(hits[1].distance - hits[0].distance, chord, 1e-7 * sphere.radius);
        EXPECT_NEAR(glm::length(hits[0].positionWS - sphere.center), sphere.radius, 1e-13 * 50.0);
    }
}

TEST(Intersection, FarSphereLosesNothing)
{
    const Primitive sphere = makeSphere({0, 0, -1e6}, 1.0);
    const auto hits = intersectPrimitive(sphere, {{0.6, 0, 0}, {0, 0, -1}});
    ASSERT_EQ(hits.size(), 2U);
    EXPECT_NEAR(hits[0].distance, 1e6 - 0.8, 2e-10);
}

TEST(Intersection, PlaneFromBothSidesAndItsBorders)
{
    Primitive plane;
    plane.worldFromLocal = rotationAbout({1, 0, 0}, -1.5707963267948966); // local z = world y
    plane.halfExtents = {2.0, 3.0, kNoLimit};
    const auto above = intersectPrimitive(plane, {{1.9, 5, 2.9}, {0, -1, 0}});
    ASSERT_EQ(above.size(), 1U);
    EXPECT_DOUBLE_EQ(above[0].distance, 5.0);
    EXPECT_FALSE(above[0].backFace);
    expectNear(above[0].normalWS, {0, 1, 0}, 1e-15);
    const auto below = intersectPrimitive(plane, {{1.9, -5, 2.9}, {0, 1, 0}});
    ASSERT_EQ(below.size(), 1U);
    EXPECT_TRUE(below[0].backFace);
    EXPECT_TRUE(intersectPrimitive(plane, {{2.1, 5, 0}, {0, -1, 0}}).empty());
    EXPECT_TRUE(intersectPrimitive(plane, {{0, 5, 3.1}, {0, -1, 0}}).empty());
    EXPECT_TRUE(intersectPrimitive(Primitive{}, {{0, 0, 5}, {1, 0, 0}}).empty()); // parallel
}

TEST(Intersection, RotatedBoxAgreesWithItsSixPlanes)
{
    RandomStream random(4);
    int met = 0;
    for (int i = 0; i < 2000; ++i) {
        Primitive box = makeBox(drawPoint(random, 2.0), {random.next(0.1, 2.0), 0.7, 1.3});
        box.worldFromLocal = rotationAbout(drawPoint(random, 1.0), random.next(0.0, 6.0));
        const glm::dvec3 origin = drawPoint(random, 6.0);
        const Ray ray{origin, glm::normalize(drawPoint(random, 2.0) - origin)};
        const auto hits = intersectPrimitive(box, ray);
        int faces = 0;
        for (int axis = 0; axis < 3; ++axis)
            for (const double side : {-1.0, 1.0}) {
                Primitive face;
                face.center = box.center + side * box.halfExtents[axis] * box.worldFromLocal[axis];
                face.worldFromLocal = glm::dmat3(box.worldFromLocal[(axis + 1) % 3], box.worldFromLocal[(axis + 2) % 3],
                                                 box.worldFromLocal[axis]);
                face.halfExtents = {box.halfExtents[(axis + 1) % 3], box.halfExtents[(axis + 2) % 3], kNoLimit};
                for (const SurfaceHit& onFace : intersectPrimitive(face, ray)) {
                    ASSERT_EQ(hits.size(), 2U);
                    const SurfaceHit& same = hits[glm::dot(ray.dirWS, side * box.worldFromLocal[axis]) < 0.0 ? 0 : 1];
                    EXPECT_NEAR(same.distance, onFace.distance, 1e-10);
                    expectNear(same.normalWS, side * box.worldFromLocal[axis], 1e-14);
                    ++faces;
                }
            }
        EXPECT_EQ(faces, hits.empty() ? 0 : 2);
        met += hits.empty() ? 0 : 1;
    }
    EXPECT_GT(met, 300);
}

TEST(Intersection, BoxWithRaysAlongItsAxes)
{
    const Primitive box = makeBox({0, 0, 0}, {1, 2, 3});
    for (int axis = 0; axis < 3; ++axis)
        for (const double zero : {0.0, -0.0}) {
            Ray ray{{0.5, 0.5, 0.5}, glm::dvec3(zero)};
            ray.originWS[axis] = -10.0;
            ray.dirWS[axis] = 1.0;
            const auto hits = intersectPrimitive(box, ray);
            ASSERT_EQ(hits.size(), 2U);
            EXPECT_EQ(hits[0].distance, 10.0 - box.halfExtents[axis]);
            EXPECT_EQ(hits[1].distance, 10.0 + box.halfExtents[axis]);
            ray.originWS[(axis + 1) % 3] = 4.0;
            EXPECT_TRUE(intersectPrimitive(box, ray).empty());
        }
}

TEST(CastRay, TakesTheNearestAndHonoursItsLimits)
{
    Scene scene;
    scene.primitives = {makeSphere({0, 0, -10}, 1.0), makeBox({0, 0, -5}, {1, 1, 1}), makeSphere({0, 0, -5}, 0.5)};
    const Ray ray{{0, 0, 0}, {0, 0, -1}};
    EXPECT_EQ(castRay(scene, ray)->primitive, 1);
    EXPECT_DOUBLE_EQ(castRay(scene, ray)->distance, 4.0);
    EXPECT_EQ(castRay(scene, ray, 4.0)->primitive, 2); // limits are open
    EXPECT_EQ(castRay(scene, ray, 1e-9, kNoLimit, 1)->primitive, 2);
    EXPECT_TRUE(castRay(scene, ray, 5.0)->backFace);
    EXPECT_FALSE(castRay(scene, ray, 1e-9, 4.0).has_value());
    EXPECT_FALSE(castRay(scene, {{0, 0, 0}, {0, 0, 1}}).has_value());
}

TEST(Radiance, CheckerOfAPlane)
{
    Scene scene;
    Primitive floor;
    floor.radiance = {RadiancePattern::kChecker, glm::dvec3(1.0), glm::dvec3(0.0), 0.5, 1};
    scene.primitives = {floor};
    const auto at = [&](double x, double y) {
        return computeRadiance(scene, *castRay(scene, {{x, y, 3.0}, {0, 0, -1}})).x;
    };
    EXPECT_EQ(at(0.1, 0.1), 1.0);
    EXPECT_EQ(at(0.6, 0.1), 0.0);
    EXPECT_EQ(at(0.6, 0.6), 1.0);
    EXPECT_EQ(at(-0.1, 0.1), 0.0);
    EXPECT_EQ(at(-0.1, -0.1), 1.0);
    EXPECT_EQ(at(-0.6, -0.1), 0.0);
    EXPECT_EQ(at(1000.1, 0.1), 1.0);
}

// A box's face lies on an edge of the cells, where rounding would speckle the pattern if the third axis counted.
TEST(Radiance, CheckerOfARotatedBoxHasNoSpeckles)
{
    Scene scene;
    Primitive box = makeBox({0.3, -0.2, 0.1}, {1, 1, 1});
    box.worldFromLocal = rotationAbout({1, 2, 3}, 0.7);
    box.radiance = {RadiancePattern::kChecker, glm::dvec3(1.0), glm::dvec3(0.0), 0.5, 1};
    scene.primitives = {box};
    RandomStream random(5);
    for (int i = 0; i < 1000; ++i) {
        const double u = random.next(0.51, 0.99);
        const double v = random.next(-0.49, -0.01);
        const glm::dvec3 above = box.center + box.worldFromLocal * glm::dvec3(u, v, 4.0);
        const auto hit = castRay(scene, {above, -box.worldFromLocal[2]});
        ASSERT_TRUE(hit);
        EXPECT_EQ(computeRadiance(scene, *hit).x, 1.0); // cells 1 and -1
    }
}

TEST(Radiance, GradientAndSky)
{
    Scene scene;
    Primitive sphere = makeSphere({0, 2, 0}, 2.0);
    sphere.radiance = {RadiancePattern::kGradient, glm::dvec3(0.0), glm::dvec3(1.0), 0.5, 1};
    scene.primitives = {sphere};
    EXPECT_NEAR(computeRadiance(scene, *castRay(scene, {{0, 3, 9}, {0, 0, -1}})).x, 0.75, 1e-15);
    EXPECT_NEAR(computeRadiance(scene, *castRay(scene, {{0, 9, 0}, {0, -1, 0}})).x, 1.0, 1e-15);
    expectNear(computeSkyRadiance(scene, {0, 1, 0}), scene.sky.zenith, 1e-15);
    expectNear(computeSkyRadiance(scene, {1, 0, 0}), scene.sky.horizon, 1e-15);
    expectNear(computeSkyRadiance(scene, {0, -1, 0}), scene.sky.nadir, 1e-15);
    expectNear(computeSkyRadiance(scene, {std::sqrt(0.75), 0.5, 0}), 0.5 * (scene.sky.zenith + scene.sky.horizon),
               1e-15);
}

TEST(ValidateScene, SaysWhichPrimitiveAndWhatIsAllowed)
{
    const auto messageOf = [](const Primitive& primitive) -> std::string {
        Scene scene;
        scene.primitives = {Primitive{}, primitive};
        try {
            validateScene(scene);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(messageOf(makeSphere({0, 0, 0}, 1.0)), "");
    EXPECT_EQ(messageOf(makeSphere({0, 0, 0}, -1.0)), "scene: primitive 2: radius -1; allowed: metres above 0");
    std::vector<Primitive> broken(9);
    broken[0].center.x = kNoLimit;
    broken[1].worldFromLocal *= 2.0;
    broken[2].halfExtents.y = 0.0;
    broken[3].material = "gold";
    broken[4].material = "glass";
    broken[5] = makeSphere({0, 0, 0}, 1.0);
    broken[5].material = "glass";
    broken[5].ior = 0.0;
    broken[6].radiance.pattern = RadiancePattern::kGradient; // over an endless plane
    broken[7].radiance.pattern = RadiancePattern::kChecker;
    broken[7].radiance.cellSize = 0.0;
    broken[8].objectIndex = -1;
    for (size_t i = 0; i < broken.size(); ++i)
        EXPECT_NE(messageOf(broken[i]).find("allowed:"), std::string::npos) << "primitive " << i;
}
