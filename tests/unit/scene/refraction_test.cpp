#include "harness/scene/refraction.h"

#include "harness/scene/random_scene.h"
#include "tests/unit/scene/near.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace crossray;

namespace {

constexpr double kRadian = std::numbers::pi / 180.0;

// Comes down on the xy plane from +z at an angle to the normal.
glm::dvec3 incoming(double angle)
{
    return {std::sin(angle), 0.0, -std::cos(angle)};
}

Primitive makeSolid(PrimitiveShape shape, double ior)
{
    Primitive solid;
    solid.shape = shape;
    solid.material = "glass";
    solid.ior = ior;
    solid.halfExtents = {kNoLimit, kNoLimit, 0.25}; // a slab half a metre thick
    return solid;
}

} // namespace

TEST(Reflection, AnglesAreEqual)
{
    expectNear(reflectDirection(incoming(0.4), {0, 0, 1}), {std::sin(0.4), 0, std::cos(0.4)}, 1e-15);
    expectNear(reflectDirection(incoming(0.4), {0, 0, -1}), {std::sin(0.4), 0, std::cos(0.4)}, 1e-15);
    expectNear(reflectDirection({1, 0, 0}, {0, 0, 1}), {1, 0, 0}, 1e-15);
}

TEST(Refraction, FollowsSnell)
{
    for (const double ior : {1.0, 1.33, 1.5, 2.4, 0.7})
        for (double angle = 0.0; angle < 89.9 * kRadian; angle += 0.01) {
            const auto dir = refractDirection(incoming(angle), {0, 0, 1}, 1.0 / ior);
            const double sine = std::sin(angle) / ior;
            ASSERT_EQ(dir.has_value(), sine <= 1.0);
            if (dir) expectNear(*dir, incoming(std::asin(sine)), 1e-13);
        }
    expectNear(*refractDirection({0, 0, -1}, {0, 0, 1}, 1.0 / 1.5), {0, 0, -1}, 1e-16);
}

TEST(Refraction, CriticalAngleFromBothSides)
{
    const double critical = std::asin(1.0 / 1.5);
    EXPECT_TRUE(refractDirection(incoming(critical - 1e-9), {0, 0, 1}, 1.5).has_value());
    EXPECT_FALSE(refractDirection(incoming(critical + 1e-9), {0, 0, 1}, 1.5).has_value());
}

// A sphere deviates by 2 (angle outside - angle inside), leaves at the angle at which it was entered, after a chord of
// 2 r cos(inside).
TEST(Refraction, ThroughASphereIsSymmetric)
{
    const Primitive sphere = makeSolid(PrimitiveShape::kSphere, 1.5); // radius 1 around the origin
    for (const double ior : {1.1, 1.5, 2.0})
        for (double angle = 0.001; angle < 89.9 * kRadian; angle += 0.01) {
            Primitive solid = sphere;
            solid.ior = ior;
            const double inside = std::asin(std::sin(angle) / ior);
            const auto path = refractThrough(solid, {0, 0, 1}, {0, 0, 1}, incoming(angle));
            ASSERT_TRUE(path);
            EXPECT_NEAR(path->length, 2.0 * std::cos(inside), 1e-12);
            EXPECT_NEAR(glm::length(path->exitWS), 1.0, 1e-14);
            EXPECT_NEAR(glm::dot(path->exitDirWS, path->exitWS), std::cos(angle), 1e-12);
            const double deviation = std::atan2(glm::length(glm::cross(incoming(angle), path->exitDirWS)),
                                                glm::dot(incoming(angle), path->exitDirWS));
            EXPECT_NEAR(deviation, 2.0 * (angle - inside), 1e-11);
        }
}

// A slab shifts a ray sideways by t sin(outside - inside) / cos(inside) and leaves its direction alone.
TEST(Refraction, ThroughASlabShiftsSideways)
{
    for (const double ior : {1.1, 1.5, 2.0})
        for (double angle = 0.0; angle < 89.0 * kRadian; angle += 0.01) {
            const Primitive slab = makeSolid(PrimitiveShape::kBox, ior);
            const double inside = std::asin(std::sin(angle) / ior);
            const glm::dvec3 entry(0.3, -0.2, 0.25);
            const auto path = refractThrough(slab, entry, {0, 0, 1}, incoming(angle));
            ASSERT_TRUE(path);
            expectNear(path->exitDirWS, incoming(angle), 1e-12);
            EXPECT_NEAR(path->length, 0.5 / std::cos(inside), 1e-12);
            const glm::dvec3 straight = path->exitWS - entry;
            const double shift = glm::length(straight - glm::dot(straight, incoming(angle)) * incoming(angle));
            EXPECT_NEAR(shift, 0.5 * std::sin(angle - inside) / std::cos(inside), 1e-12);
        }
}

// Entering a glass cube's side near grazing, the ray meets the next face beyond the critical angle.
TEST(Refraction, TotalInternalReflectionInACube)
{
    Primitive cube = makeSolid(PrimitiveShape::kBox, 1.5);
    cube.halfExtents = glm::dvec3(1.0);
    EXPECT_FALSE(refractThrough(cube, {0.9, 0, 1}, {0, 0, 1}, incoming(30.0 * kRadian)).has_value());
    EXPECT_TRUE(refractThrough(cube, {-0.9, 0, 1}, {0, 0, 1}, incoming(30.0 * kRadian)).has_value());
    cube.ior = 0.7; // into the thinner medium: nothing enters beyond 44.4 degrees
    EXPECT_FALSE(refractThrough(cube, {0, 0, 1}, {0, 0, 1}, incoming(45.0 * kRadian)).has_value());
}

TEST(Refraction, IndexOneChangesNothing)
{
    RandomStream random(6);
    const Primitive sphere = makeSolid(PrimitiveShape::kSphere, 1.0);
    for (int i = 0; i < 2000; ++i) {
        const double angle = 0.5 * std::numbers::pi - std::pow(10.0, random.next(-12.0, 0.0)); // up to grazing
        const auto path = refractThrough(sphere, {0, 0, 1}, {0, 0, 1}, incoming(angle));
        ASSERT_TRUE(path);
        expectNear(path->exitDirWS, incoming(angle), 1e-12);
    }
}
