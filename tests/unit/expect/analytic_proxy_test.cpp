#include "tests/unit/expect/cases.h"

#include <rapidcheck/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

using namespace crossray;
using namespace crossray::test;

namespace {

ProxyVolume makeProxy(const glm::dvec3& center, const glm::dvec3& halfExtents, double radius = 1.0)
{
    ProxyVolume proxy;
    proxy.center = center;
    proxy.halfExtents = halfExtents;
    proxy.radius = radius;
    return proxy;
}

glm::dvec3 anyVector(int limit)
{
    const auto number = [limit] { return *rc::gen::inRange(-limit, limit + 1) / 100.0; };
    return {number(), number(), number()};
}

// By angles: a loop that waits for a good draw would never end while a failure is shrunk.
glm::dvec3 anyDirection()
{
    const double azimuth = *rc::gen::inRange(0, 6284) / 1000.0;
    const double height = *rc::gen::inRange(-1000, 1001) / 1000.0;
    const double across = std::sqrt(1.0 - height * height);
    return glm::normalize(glm::dvec3(across * std::cos(azimuth), across * std::sin(azimuth), height));
}

// The interval of Kay and Kajiya (1986), the usual way to do it: the second opinion.
std::optional<double> slabExit(const ProxyVolume& proxy, const Ray& ray)
{
    const glm::dvec3 origin = glm::transpose(proxy.worldFromProxy) * (ray.originWS - proxy.center);
    const glm::dvec3 dir = glm::transpose(proxy.worldFromProxy) * ray.dirWS;
    double enter = -kInf, leave = kInf;
    for (int axis = 0; axis < 3; ++axis) {
        if (dir[axis] == 0.0) {
            if (std::abs(origin[axis]) > proxy.halfExtents[axis]) return std::nullopt;
            continue;
        }
        const double a = (-proxy.halfExtents[axis] - origin[axis]) / dir[axis];
        const double b = (proxy.halfExtents[axis] - origin[axis]) / dir[axis];
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    if (enter > leave || leave < 0.0) return std::nullopt;
    return leave;
}

} // namespace

TEST(DistanceToBoxExit, byHand)
{
    const ProxyVolume box = makeProxy({0, 0, 0}, {1, 2, 3});
    EXPECT_EQ(distanceToBoxExit(box, {{0, 0, 0}, {1, 0, 0}}), 1.0);
    EXPECT_EQ(distanceToBoxExit(box, {{0, 0, 0}, {0, -1, 0}}), 2.0);
    EXPECT_EQ(distanceToBoxExit(box, {{0.5, 0, 1}, {0, 0, -1}}), 4.0);
    EXPECT_DOUBLE_EQ(*distanceToBoxExit(box, {{0, 0, 0}, {0.6, 0.8, 0}}), 1.0 / 0.6);
    // A corner: all three faces at once.
    EXPECT_DOUBLE_EQ(*distanceToBoxExit(box, {{0, 0, 0}, glm::normalize(glm::dvec3(1, 2, 3))}), std::sqrt(14.0));
    // Outside: the far face when it is met, else nothing.
    EXPECT_EQ(distanceToBoxExit(box, {{-5, 0, 0}, {1, 0, 0}}), 6.0);
    EXPECT_FALSE(distanceToBoxExit(box, {{-5, 2.5, 0}, {1, 0, 0}}));
    EXPECT_FALSE(distanceToBoxExit(box, {{-5, 0, 0}, {-1, 0, 0}}));
    EXPECT_FALSE(distanceToBoxExit(box, {{-5, 0, 0}, {0, 1, 0}}));
    // On a face: inside. Outwards it has left already.
    EXPECT_EQ(distanceToBoxExit(box, {{-1, 0, 0}, {1, 0, 0}}), 2.0);
    EXPECT_EQ(distanceToBoxExit(box, {{-1, 0, 0}, {-1, 0, 0}}), 0.0);
    EXPECT_EQ(distanceToBoxExit(box, {{-1, 0, 0}, {0, 1, 0}}), 2.0);
    EXPECT_EQ(distanceToBoxExit(box, {{-1, 0, 0}, {-0.0, 1, 0}}), 2.0);
}

TEST(DistanceToBoxExit, worksInTheProxysOwnFrame)
{
    ProxyVolume box = makeProxy({10, 0, 0}, {1, 2, 3});
    box.worldFromProxy = glm::dmat3(glm::rotate(glm::dmat4(1.0), glm::radians(90.0), glm::dvec3(0, 0, 1)));
    EXPECT_NEAR(*distanceToBoxExit(box, {{10, 0, 0}, {1, 0, 0}}), 2.0, 1e-12); // its y axis lies along the world's x
    EXPECT_NEAR(*distanceToBoxExit(box, {{10, 0, 0}, {0, 1, 0}}), 1.0, 1e-12);
}

RC_GTEST_PROP(DistanceToBoxExit, agreesWithTheSlabTest, ())
{
    ProxyVolume box = makeProxy(anyVector(300), glm::abs(anyVector(500)) + 0.1);
    box.worldFromProxy = glm::dmat3(glm::rotate(glm::dmat4(1.0), *rc::gen::inRange(0, 628) / 100.0, anyDirection()));
    const Ray ray{anyVector(800), anyDirection()};
    // A ray that touches an edge or runs along a face hits or misses by rounding.
    ProxyVolume smaller = box, larger = box;
    smaller.halfExtents -= 1e-9;
    larger.halfExtents += 1e-9;
    const auto shortest = slabExit(smaller, ray), longest = slabExit(larger, ray);
    RC_PRE(shortest.has_value() == longest.has_value());
    const auto exit = distanceToBoxExit(box, ray);
    RC_ASSERT(exit.has_value() == longest.has_value());
    if (exit) RC_ASSERT(*exit > *shortest - 1e-12 && *exit < *longest + 1e-12);
    if (exit && *longest - *shortest < 1e-7) RC_ASSERT(std::fabs(*exit - *slabExit(box, ray)) < 1e-11);
}

TEST(DistanceToSphereExit, byHand)
{
    const ProxyVolume ball = makeProxy({0, 0, -10}, {}, 2.0);
    EXPECT_EQ(distanceToSphereExit(ball, {{0, 0, -10}, {0, 1, 0}}), 2.0);
    EXPECT_EQ(distanceToSphereExit(ball, {{0, 0, 0}, {0, 0, -1}}), 12.0);
    EXPECT_FALSE(distanceToSphereExit(ball, {{0, 0, 0}, {0, 0, 1}}));
    EXPECT_FALSE(distanceToSphereExit(ball, {{0, 2.1, 0}, {0, 0, -1}}));
    EXPECT_EQ(distanceToSphereExit(ball, {{0, 2, 0}, {0, 0, -1}}), 10.0) << "it touches";
    EXPECT_EQ(distanceToSphereExit(ball, {{0, 2, -10}, {0, 1, 0}}), 0.0) << "on it, outwards";
    EXPECT_EQ(distanceToSphereExit(ball, {{0, 2, -10}, {0, -1, 0}}), 4.0) << "on it, inwards";
    EXPECT_EQ(distanceToSphereExit(ball, {{0, 2, -10}, {1, 0, 0}}), 0.0) << "on it, along it";
}

RC_GTEST_PROP(DistanceToSphereExit, isTheFarRoot, ())
{
    const ProxyVolume ball = makeProxy(anyVector(300), {}, *rc::gen::inRange(10, 800) / 100.0);
    const Ray ray{anyVector(800), anyDirection()};
    const glm::dvec3 origin = ray.originWS - ball.center;
    const double b = glm::dot(origin, ray.dirWS);
    const double c = glm::dot(origin, origin) - ball.radius * ball.radius;
    RC_PRE(std::fabs(b * b - c) > 1e-6 && std::fabs(c) > 1e-6);
    const auto exit = distanceToSphereExit(ball, ray);
    const bool meets = b * b > c && -b + std::sqrt(b * b - c) > 0.0;
    RC_ASSERT(exit.has_value() == meets);
    if (!exit) return;
    RC_ASSERT(std::fabs(*exit - (-b + std::sqrt(b * b - c))) < 1e-9);
    RC_ASSERT(std::fabs(glm::length(ray.originWS + *exit * ray.dirWS - ball.center) - ball.radius) < 1e-9);
}

TEST(ProjectOnProxy, aHitIsInFrontOfTheCameraAndNeedNotBeOnScreen)
{
    Camera camera; // at the origin, down -z
    const CameraFrame frame(camera);
    const ProxyVolume box = makeProxy({0, 0, 0}, {5, 5, 5});
    const auto project = [&](const glm::dvec3& origin, const glm::dvec3& dir) {
        return projectOnProxy(frame, ProjectionModel::kProxyBox, box, {HitReason::kNone, origin, dir, 0.0});
    };
    const RayEnd ahead = project({0, 0, -2}, {0, 0, -1});
    EXPECT_EQ(ahead.hitClass, HitClass::kHit);
    EXPECT_DOUBLE_EQ(ahead.screen.linearDepth, 5.0);
    EXPECT_DOUBLE_EQ(ahead.screen.positionSS.x, 32.0);
    const RayEnd aside = project({0, 0, -2}, {1, 0, 0});
    EXPECT_EQ(aside.hitClass, HitClass::kHit);
    EXPECT_FALSE(aside.screen.onScreen);
    const RayEnd behind = project({0, 0, -2}, {0, 0, 1});
    EXPECT_EQ(behind.hitClass, HitClass::kMiss);
    EXPECT_EQ(behind.reason, HitReason::kBehindCamera);
    const RayEnd past = project({0, 0, -9}, {0, 0, -1});
    EXPECT_EQ(past.hitClass, HitClass::kMiss);
    EXPECT_EQ(past.reason, HitReason::kNoProxyHit);
    const RayEnd none = projectOnProxy(frame, ProjectionModel::kProxyBox, box,
                                       {HitReason::kNoRefractedRay, {0, 0, -2}, {0, 0, -1}, 0.0});
    EXPECT_EQ(none.hitClass, HitClass::kNoRaycast);
    EXPECT_EQ(none.reason, HitReason::kNoRefractedRay);
    const RayEnd far =
        projectOnProxy(frame, ProjectionModel::kProxyInfinite, box, {HitReason::kNone, {0, 0, -2}, {0, 0, -1}, 0.0});
    EXPECT_DOUBLE_EQ(far.screen.linearDepth, 65506.0);
}
