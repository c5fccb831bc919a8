#include "tests/unit/expect/cases.h"

#include <rapidcheck/gtest.h>

#include <optional>

using namespace crossray;
using namespace crossray::test;

namespace {

constexpr double kDegree = 0.017453292519943295769;

// The surface z = 0 seen from above at an angle; the light runs towards +x and down.
SurfacePoint seenAt(double degrees)
{
    return {{0, 0, 0}, {0, 0, 1}, {-std::sin(degrees * kDegree), 0, std::cos(degrees * kDegree)}};
}

void expectNear(const glm::dvec3& actual, const glm::dvec3& expected, double bound)
{
    EXPECT_LE(glm::length(actual - expected), bound)
        << "(" << actual.x << ", " << actual.y << ", " << actual.z << ") is not (" << expected.x << ", " << expected.y
        << ", " << expected.z << ")";
}

// Refraction of a vector as GLSL defines it, and the models step by step as the domain text writes them.
std::optional<glm::dvec3> refractVector(const glm::dvec3& in, const glm::dvec3& normal, double eta)
{
    const double cosine = glm::dot(normal, in);
    const double k = 1.0 - eta * eta * (1.0 - cosine * cosine);
    if (k < 0.0) return std::nullopt;
    return eta * in - (eta * cosine + std::sqrt(k)) * normal;
}

EffectRay sphereStepByStep(const SurfacePoint& s, double ior, double thickness)
{
    const glm::dvec3 center = s.positionWS - s.normalWS * thickness * 0.5;
    const glm::dvec3 inside = *refractVector(-s.toEyeWS, s.normalWS, 1.0 / ior);
    const double distance = -glm::dot(s.normalWS, inside) * thickness;
    const glm::dvec3 exit = s.positionWS + inside * distance;
    const glm::dvec3 outside = *refractVector(inside, glm::normalize(center - exit), ior);
    return {HitReason::kNone, exit, outside, distance};
}

// A surface in general position with N.V from 0.05 to 1, and the parameters of a material that lets the light in.
struct Sample {
    SurfacePoint surface;
    double ior, thickness;
};

Sample anySample()
{
    const auto number = [](int low, int high) { return *rc::gen::inRange(low, high) / 1000.0; };
    // By angles: a loop that waits for a good draw would never end while a failure is shrunk.
    const double azimuth = number(0, 6284), height = number(-1000, 1001), turn = number(0, 6284);
    const double across = std::sqrt(1.0 - height * height);
    Sample sample;
    const glm::dvec3 normal(across * std::cos(azimuth), across * std::sin(azimuth), height);
    sample.surface.normalWS = glm::normalize(normal);
    const glm::dvec3 east(-std::sin(azimuth), std::cos(azimuth), 0.0);
    const glm::dvec3 side = std::cos(turn) * east + std::sin(turn) * glm::cross(sample.surface.normalWS, east);
    const double cosine = number(50, 1001);
    sample.surface.toEyeWS = glm::normalize(cosine * sample.surface.normalWS + std::sqrt(1.0 - cosine * cosine) * side);
    sample.surface.positionWS = {number(-9000, 9000), number(-9000, 9000), number(-9000, 9000)};
    sample.ior = number(1000, 2500);
    sample.thickness = number(1, 5000);
    return sample;
}

} // namespace

TEST(RefractThroughSphere, byHandAt45Degrees)
{
    // sin b = sin 45 / 1.5, b = 28.12550570 degrees; path 2 cos b; the exit runs at 2b - 45 = 11.25101140 degrees from
    // -N.
    const EffectRay ray = refractThroughSphere(seenAt(45.0), 1.5, 2.0);
    EXPECT_EQ(ray.status, HitReason::kNone);
    EXPECT_NEAR(ray.pathLength, 1.7638342073763937, 1e-14);
    expectNear(ray.dirWS, {std::sin(11.25101140 * kDegree), 0, -std::cos(11.25101140 * kDegree)}, 1e-9);
    expectNear(ray.originWS, {1.7638342073763937 * std::sqrt(2.0) / 3.0, 0, -1.7638342073763937 * std::sqrt(7.0) / 3.0},
               1e-14);
}

TEST(RefractThroughSphere, straightAtNormalIncidenceAndWithIndex1)
{
    const EffectRay center = refractThroughSphere(seenAt(0.0), 1.5, 2.0);
    expectNear(center.dirWS, {0, 0, -1}, 0.0);
    expectNear(center.originWS, {0, 0, -2}, 0.0);
    EXPECT_EQ(center.pathLength, 2.0);
    const SurfacePoint slanted = seenAt(60.0);
    const EffectRay clear = refractThroughSphere(slanted, 1.0, 2.0);
    expectNear(clear.dirWS, -slanted.toEyeWS, 1e-15);
    EXPECT_NEAR(clear.pathLength, 1.0, 1e-15);
    expectNear(clear.originWS, -slanted.toEyeWS, 1e-15);
}

RC_GTEST_PROP(RefractThroughSphere, equalsTheModelStepByStep, ())
{
    const Sample sample = anySample();
    const EffectRay formed = refractThroughSphere(sample.surface, sample.ior, sample.thickness);
    const EffectRay stepped = sphereStepByStep(sample.surface, sample.ior, sample.thickness);
    RC_ASSERT(glm::length(formed.dirWS - stepped.dirWS) < 1e-10); // normalize(C - P1) loses digits in the steps
    RC_ASSERT(glm::length(formed.originWS - stepped.originWS) < 1e-12 * (1.0 + sample.thickness));
    RC_ASSERT(std::fabs(formed.pathLength - stepped.pathLength) < 1e-12 * (1.0 + sample.thickness));
}

RC_GTEST_PROP(RefractThroughSphere, isReversible, ())
{
    // Light sent back along the exit ray comes out where and how it went in.
    const Sample sample = anySample();
    const EffectRay there = refractThroughSphere(sample.surface, sample.ior, sample.thickness);
    const glm::dvec3 center = sample.surface.positionWS - 0.5 * sample.thickness * sample.surface.normalWS;
    const SurfacePoint far{there.originWS, glm::normalize(there.originWS - center), there.dirWS};
    const EffectRay back = refractThroughSphere(far, sample.ior, sample.thickness);
    RC_ASSERT(glm::length(back.originWS - sample.surface.positionWS) < 1e-9);
    RC_ASSERT(glm::length(back.dirWS - sample.surface.toEyeWS) < 1e-9);
}

TEST(RefractThroughBox, byHandAt45Degrees)
{
    // It sinks by t and moves t tan b aside; tan b = sqrt(2)/3 / (sqrt(7)/3).
    const EffectRay ray = refractThroughBox(seenAt(45.0), 1.5, 0.5);
    EXPECT_EQ(ray.status, HitReason::kNone);
    expectNear(ray.originWS, {0.5 * std::sqrt(2.0 / 7.0), 0, -0.5}, 1e-15);
    expectNear(ray.dirWS, {std::sqrt(0.5), 0, -std::sqrt(0.5)}, 1e-15);
    EXPECT_NEAR(ray.pathLength, 0.5 * 3.0 / std::sqrt(7.0), 1e-15);
}

RC_GTEST_PROP(RefractThroughBox, equalsTheModelStepByStep, ())
{
    const Sample sample = anySample();
    const glm::dvec3 inside = *refractVector(-sample.surface.toEyeWS, sample.surface.normalWS, 1.0 / sample.ior);
    const double path = sample.thickness / glm::dot(inside, -sample.surface.normalWS);
    const EffectRay formed = refractThroughBox(sample.surface, sample.ior, sample.thickness);
    RC_ASSERT(std::fabs(formed.pathLength - path) < 1e-11 * (1.0 + path));
    RC_ASSERT(glm::length(formed.originWS - (sample.surface.positionWS + inside * path)) < 1e-10 * (1.0 + path));
    RC_ASSERT(glm::length(formed.dirWS + sample.surface.toEyeWS) == 0.0);
}

TEST(RefractThroughBox, thePathIsAtMostAHundredThicknesses)
{
    // Index 1, 89.9 degrees: the way would be 573 thicknesses.
    const SurfacePoint grazing = seenAt(89.9);
    const EffectRay cut = refractThroughBox(grazing, 1.0, 0.01);
    EXPECT_DOUBLE_EQ(cut.pathLength, 1.0);
    expectNear(cut.originWS, -grazing.toEyeWS, 1e-13);
    // 89 degrees is not cut: 57.3 thicknesses.
    EXPECT_NEAR(refractThroughBox(seenAt(89.0), 1.0, 0.01).pathLength, 0.01 / std::cos(89.0 * kDegree), 1e-12);
}

TEST(RefractThroughThin, isABoxOf5Millimetres)
{
    const EffectRay thin = refractThroughThin(seenAt(30.0), 1.5);
    const EffectRay slab = refractThroughBox(seenAt(30.0), 1.5, 0.005);
    EXPECT_EQ(thin.pathLength, slab.pathLength);
    expectNear(thin.originWS, slab.originWS, 0.0);
    EXPECT_NEAR(thin.originWS.z, -0.005, 1e-17);
}

TEST(PassStraight, goesOnAlongTheView)
{
    const SurfacePoint surface = seenAt(30.0);
    const EffectRay ray = passStraight(surface);
    expectNear(ray.dirWS, -surface.toEyeWS, 0.0);
    expectNear(ray.originWS, surface.positionWS, 0.0);
    EXPECT_EQ(ray.pathLength, 0.0);
}

TEST(Refraction, totalReflectionAtTheEntryIsNoRay)
{
    // Index 0.5: the critical angle is 30 degrees.
    for (const auto model : {refractThroughSphere, refractThroughBox}) {
        const EffectRay ray = model(seenAt(31.0), 0.5, 1.0);
        EXPECT_EQ(ray.status, HitReason::kNoRefractedRay);
        expectNear(ray.dirWS, {std::sin(31.0 * kDegree), 0, std::cos(31.0 * kDegree)}, 1e-15);
        expectNear(ray.originWS, {0, 0, 0}, 0.0);
        EXPECT_EQ(ray.pathLength, 0.0);
        EXPECT_EQ(model(seenAt(29.0), 0.5, 1.0).status, HitReason::kNone);
    }
    // A sphere never reflects at the exit: 29 degrees outside are 75.8 inside, and 29 outside again.
    const EffectRay out = refractThroughSphere(seenAt(29.0), 0.5, 1.0);
    const double inside = std::asin(std::sin(29.0 * kDegree) / 0.5);
    expectNear(out.dirWS, {std::sin(2 * inside - 29.0 * kDegree), 0, -std::cos(2 * inside - 29.0 * kDegree)}, 1e-14);
}

TEST(Refraction, thickness0StaysAtTheEntry)
{
    for (const double thickness : {0.0, -0.0, -1.0, kNan}) {
        const SurfacePoint surface = seenAt(45.0);
        const EffectRay slab = refractThroughBox(surface, 1.5, thickness);
        EXPECT_EQ(slab.status, HitReason::kNone);
        expectNear(slab.originWS, {0, 0, 0}, 0.0);
        expectNear(slab.dirWS, -surface.toEyeWS, 0.0);
        EXPECT_EQ(slab.pathLength, 0.0);
        const EffectRay ball = refractThroughSphere(surface, 1.5, thickness);
        expectNear(ball.originWS, {0, 0, 0}, 0.0);
        expectNear(ball.dirWS, refractThroughSphere(surface, 1.5, 1e-6).dirWS, 1e-15);
    }
}

TEST(Refraction, aNormalThatFacesAwayIsTiltedToGrazing)
{
    const double grazing = std::acos(1e-4) / kDegree;
    for (const double degrees : {90.0, 100.0, 135.0, 170.0}) {
        const EffectRay tilted = refractThroughSphere(seenAt(degrees), 1.5, 1.0);
        EXPECT_EQ(tilted.status, HitReason::kNone) << degrees;
        // The same as a surface turned in the plane of N and V until it is seen at that grazing angle.
        const SurfacePoint seen = seenAt(degrees);
        const double turn = (degrees - grazing) * kDegree; // towards the eye, which is at -x
        const SurfacePoint turned{{0, 0, 0}, {-std::sin(turn), 0, std::cos(turn)}, seen.toEyeWS};
        expectNear(tilted.dirWS, sphereStepByStep(turned, 1.5, 1.0).dirWS, 1e-8);
        expectNear(tilted.originWS, sphereStepByStep(turned, 1.5, 1.0).originWS, 1e-11);
    }
    const EffectRay opposite = refractThroughBox({{1, 2, 3}, {0, 0, 1}, {0, 0, -1}}, 1.5, 1.0);
    EXPECT_EQ(opposite.status, HitReason::kDegenerateRay);
    expectNear(opposite.dirWS, {0, 0, 1}, 0.0);
    expectNear(opposite.originWS, {1, 2, 3}, 0.0);
}

TEST(Refraction, anIndexWithoutMeaningIsNoRay)
{
    for (const double ior : {0.0, -1.5, kNan, kInf, -kInf}) {
        const SurfacePoint surface = seenAt(20.0);
        const EffectRay ray = refractThroughSphere(surface, ior, 1.0);
        EXPECT_EQ(ray.status, HitReason::kDegenerateInput) << ior;
        expectNear(ray.dirWS, -surface.toEyeWS, 0.0);
    }
    expectNear(refractThroughBox(seenAt(20.0), 1e6, 1.0).originWS, refractThroughBox(seenAt(20.0), 1e3, 1.0).originWS,
               0.0);
}

TEST(Refraction, indexAndThicknessHaveBounds)
{
    EXPECT_EQ(refractThroughBox(seenAt(0.0), 1.5, 1e9).pathLength, 65504.0);
    EXPECT_EQ(refractThroughSphere(seenAt(0.0), 1.5, kInf).pathLength, 65504.0);
    // 0.03 degrees enter an index of 0.001, the smallest: sin b = 0.5236.
    const double sine = std::sin(0.03 * kDegree) / 0.001;
    EXPECT_NEAR(refractThroughBox(seenAt(0.03), 1e-6, 1.0).pathLength, 1.0 / std::sqrt(1.0 - sine * sine), 1e-12);
    EXPECT_EQ(refractThroughBox(seenAt(0.06), 1e-6, 1.0).status, HitReason::kNoRefractedRay);
}

RC_GTEST_PROP(Refraction, isFiniteAndUnitForWhateverComes, ())
{
    constexpr double kNumbers[] = {0.0,         -0.0, 1e-300, 1e-9,  0.3,  0.5,  1.0,
                                   1.0 + 1e-15, 1.5,  1e9,    1e300, -1.0, kNan, kInf};
    Sample sample = anySample();
    const double degrees =
        *rc::gen::element(0.0, 1e-10, 1e-5, 45.0, 89.99, 89.9999, 90.0, 90.0001, 120.0, 179.99999, 180.0);
    sample.surface = seenAt(degrees);
    const double ior = kNumbers[*rc::gen::inRange(0, 14)];
    const double thickness = kNumbers[*rc::gen::inRange(0, 14)];
    for (const auto model : {refractThroughSphere, refractThroughBox}) {
        const EffectRay ray = model(sample.surface, ior, thickness);
        RC_ASSERT(std::fabs(glm::length(ray.dirWS) - 1.0) < 1e-12);
        RC_ASSERT(std::isfinite(glm::length(ray.originWS)));
        RC_ASSERT(std::isfinite(ray.pathLength));
        RC_ASSERT(ray.pathLength >= 0.0);
    }
}

TEST(ReflectAtSurface, byHand)
{
    expectNear(reflectAtSurface(seenAt(30.0)).dirWS, {0.5, 0, std::sqrt(0.75)}, 1e-15);
    expectNear(reflectAtSurface(seenAt(0.0)).dirWS, {0, 0, 1}, 0.0);
    expectNear(reflectAtSurface({{1, 2, 3}, {0, 1, 0}, {0.6, 0.8, 0}}).dirWS, {-0.6, 0.8, 0}, 1e-15);
    expectNear(reflectAtSurface({{1, 2, 3}, {0, 1, 0}, {0.6, 0.8, 0}}).originWS, {1, 2, 3}, 0.0);
    // Seen from behind: as the grazing surface between the two, straight on.
    expectNear(reflectAtSurface(seenAt(120.0)).dirWS, -seenAt(120.0).toEyeWS, 1e-15);
    expectNear(reflectAtSurface(seenAt(90.0)).dirWS, {1, 0, 0}, 1e-15);
    const EffectRay none = reflectAtSurface({{1, 2, 3}, {0, 0, 0}, {0, 0, 1}});
    EXPECT_EQ(none.status, HitReason::kDegenerateRay);
    expectNear(none.dirWS, {0, 0, 0}, 0.0);
}
