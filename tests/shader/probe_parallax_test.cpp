#include "tests/shader/generators.h"

#include "harness/backend/cpu/glsl.h"

#include "crossray/probe/parallax.glsl"
#include "crossray/probe/roughness.glsl"

#include "harness/backend/cpu/glsl_end.h"

using namespace CROSSRAY_SHADER_NAMESPACE;

namespace {

const mat3 kUpright(1);

ProbeProxy makeProxy(int shape, vec3 center, vec3 extents, Real minDistance = 0)
{
    return {shape, center, kUpright, extents, minDistance};
}

// Six planes, each solved, the nearest ahead that lies on the box: nothing of the slab method.
double solveSixPlanes(vec3 origin, vec3 dir, vec3 center, vec3 extents)
{
    double nearest = std::numeric_limits<double>::max();
    for (int axis = 0; axis < 3; ++axis) {
        for (double side : {1.0, -1.0}) {
            const double toPlane = static_cast<double>(center[axis]) + side * static_cast<double>(extents[axis]) -
                                   static_cast<double>(origin[axis]);
            const double t = toPlane / static_cast<double>(dir[axis]);
            if (t >= 0 && t < nearest) nearest = t;
        }
    }
    return nearest;
}

Real sineBetween(vec3 a, vec3 b)
{
    return length(cross(a, b));
}

} // namespace

RC_GTEST_PROP(ShaderParallax, BoxPointsFromTheCaptureAtTheSamePoint, ())
{
    const vec3 center = drawPoint<vec3>(3);
    const vec3 e(drawReal(1, 4), drawReal(1, 4), drawReal(1, 4));
    const vec3 p = center + drawPoint<vec3>(Real(0.95)) * e;
    const vec3 capture = center + drawPoint<vec3>(Real(0.5)) * e;
    const vec3 dir = drawUnitVector<vec3>();
    const double t = solveSixPlanes(p, dir, center, e);
    const ParallaxRay ray = computeParallax(p, dir * 3.0, makeProxy(kProbeShapeBox, center, e), capture);
    RC_ASSERT(ray.hit && ray.reason == kHitReasonNone);
    RC_ASSERT(std::fabs(static_cast<double>(ray.distance) - t) < static_cast<double>(400 * kUlps));
    RC_ASSERT(std::fabs(length(ray.dirWS) - 1) < kUlps);
    // Both rays end in one point.
    RC_ASSERT(length(capture + ray.dirWS * ray.distanceFromCapture - p - dir * Real(t)) < 1000 * kUlps);
}

// The two ends of the ray from the capture and from the surface are one point, and it lies on the sphere.
RC_GTEST_PROP(ShaderParallax, SpherePointsFromTheCaptureAtTheSamePoint, ())
{
    const vec3 center = drawPoint<vec3>(3);
    const Real radius = drawReal(1, 6);
    const vec3 p = center + drawUnitVector<vec3>() * (radius * drawReal(0, Real(0.95)));
    const vec3 capture = center + drawUnitVector<vec3>() * (radius * drawReal(0, Real(0.5)));
    const vec3 dir = drawUnitVector<vec3>();
    const ParallaxRay ray = computeParallax(p, dir, makeProxy(kProbeShapeSphere, center, vec3(radius)), capture);
    const vec3 seen = capture + ray.dirWS * ray.distanceFromCapture;
    RC_ASSERT(ray.hit);
    RC_ASSERT(std::fabs(length(seen - center) - radius) < 400 * kUlps);
    RC_ASSERT(sineBetween(normalize(seen - p), dir) < 4000 * kUlps);
    RC_ASSERT(dot(seen - p, dir) > 0);
}

TEST(ShaderParallax, KnownNumbers)
{
    // A room 4 m high, captured in its middle; from the floor at x = 1 straight up: the ceiling at x = 1.
    const ProbeProxy room = makeProxy(kProbeShapeBox, vec3(0, 2, 0), vec3(5, 2, 5));
    const ParallaxRay up = computeParallax(vec3(1, 0, 0), vec3(0, 1, 0), room, vec3(0, 2, 0));
    EXPECT_NEAR(up.dirWS.x, 1 / std::sqrt(Real(5)), 8 * kUlps);
    EXPECT_NEAR(up.dirWS.y, 2 / std::sqrt(Real(5)), 8 * kUlps);
    EXPECT_NEAR(up.distance, 4, 8 * kUlps);
    EXPECT_NEAR(up.distanceFromCapture, std::sqrt(Real(5)), 8 * kUlps);
    // No proxy: 65504 m away, so that the capture position hardly matters.
    const ParallaxRay far =
        computeParallax(vec3(1, 0, 0), vec3(0, 1, 0), makeProxy(kProbeShapeInfinite, vec3(0), vec3(0)), vec3(0, 2, 0));
    EXPECT_TRUE(far.hit);
    EXPECT_EQ(far.distance, Real(65504));
    EXPECT_NEAR(far.dirWS.x, Real(1.0 / 65502), 1e-9);
}

TEST(ShaderParallax, NotNearerThanTheMinimumDistance)
{
    const auto room = [](Real nearest) { return makeProxy(kProbeShapeBox, vec3(0), vec3(2), nearest); };
    const vec3 capture(0, 1, 0);
    EXPECT_EQ(computeParallax(vec3(0), vec3(1, 0, 0), room(1), capture).distance, 2);
    const ParallaxRay pushed = computeParallax(vec3(0), vec3(1, 0, 0), room(10), capture);
    EXPECT_EQ(pushed.distance, 10);
    EXPECT_NEAR(pushed.dirWS.y, -1 / std::sqrt(Real(101)), 4 * kUlps);
    for (Real odd : {kNaN, Real(-5), -kInfinity})
        EXPECT_EQ(computeParallax(vec3(0), vec3(1, 0, 0), room(odd), capture).distance, 2);
    EXPECT_EQ(computeParallax(vec3(0), vec3(1, 0, 0), room(kInfinity), capture).distance, Real(65504));
}

TEST(ShaderParallax, AtTheCapturePositionTheDirectionStays)
{
    // From the capture position itself every proxy leaves the direction alone.
    const vec3 p(Real(0.5), 0, 0);
    for (int shape : {kProbeShapeInfinite, kProbeShapeBox, kProbeShapeSphere}) {
        const ParallaxRay ray = computeParallax(p, vec3(0, 3, 4), makeProxy(shape, vec3(0), vec3(2)), p);
        EXPECT_NEAR(ray.dirWS.y, Real(0.6), 8 * kUlps);
        EXPECT_NEAR(ray.dirWS.z, Real(0.8), 8 * kUlps);
        EXPECT_NEAR(ray.distance, ray.distanceFromCapture, ray.distance * 8 * kUlps);
    }
    // And where it lies on the face that the ray leaves by: the way is 0, the direction stays.
    const ParallaxRay none =
        computeParallax(vec3(2, 0, 0), vec3(3, 0, 0), makeProxy(kProbeShapeBox, vec3(0), vec3(2)), vec3(2, 0, 0));
    EXPECT_EQ(none.dirWS, vec3(1, 0, 0));
    EXPECT_EQ(none.distance, 0);
}

TEST(ShaderParallax, OutsideAndNotMeetingItReadsAsIfThereWereNoProxy)
{
    for (int shape : {kProbeShapeBox, kProbeShapeSphere}) {
        const ParallaxRay ray =
            computeParallax(vec3(5, 0, 0), vec3(0, 1, 0), makeProxy(shape, vec3(0), vec3(2)), vec3(0));
        EXPECT_FALSE(ray.hit);
        EXPECT_EQ(ray.reason, kHitReasonNoProxyHit);
        EXPECT_NEAR(ray.dirWS.y, 1, 1e-6);
        EXPECT_EQ(ray.distance, Real(65504));
    }
    // From outside through it: the far face, from wherever the ray starts.
    const ParallaxRay through =
        computeParallax(vec3(5, 1, 0), vec3(-1, 0, 0), makeProxy(kProbeShapeBox, vec3(0), vec3(2)), vec3(0));
    EXPECT_TRUE(through.hit);
    EXPECT_NEAR(sineBetween(through.dirWS, normalize(vec3(-2, 1, 0))), 0, 8 * kUlps);
    const ParallaxRay odd = computeParallax(vec3(0), vec3(0, 1, 0), makeProxy(99, vec3(0), vec3(2)), vec3(0));
    EXPECT_EQ(odd.reason, kHitReasonDegenerateInput);
    EXPECT_EQ(odd.dirWS, vec3(0, 1, 0));
}

RC_GTEST_PROP(ShaderParallax, AnswersAnything, ())
{
    const ProbeProxy proxy{*rc::gen::inRange(0, 5), drawHostileVector<vec3>(), kUpright, drawHostileVector<vec3>(),
                           drawHostile()};
    const vec3 dir = drawHostileVector<vec3>();
    const ParallaxRay ray = computeParallax(drawHostileVector<vec3>(), dir, proxy, drawHostileVector<vec3>());
    RC_ASSERT(isFinite(ray.dirWS) && isFinite(ray.distance) && isFinite(ray.distanceFromCapture));
    RC_ASSERT(std::fabs(length(ray.dirWS) - (hasDirection(dir) ? 1 : 0)) < kUlps);
    RC_ASSERT(ray.hit == (ray.reason == kHitReasonNone));
}

// With one r: mip steps are not linear in it, and each end is exact.
TEST(ShaderRoughness, MipsByTheirExponents)
{
    EXPECT_EQ(computeReflectionMip(0, 7), 0);
    EXPECT_EQ(computeReflectionMip(1, 7), 6);
    EXPECT_EQ(computeRefractionMip(1, 7), 6);
    // Powers of two make the exponents visible: 2^-5 to the 0.8 is 2^-4, 2^-10 to the 1.3 is 2^-13.
    EXPECT_NEAR(computeReflectionMip(Real(0.03125), 2), Real(0.0625), kUlps);
    EXPECT_NEAR(computeRefractionMip(Real(0.0009765625), 2), Real(0.0001220703125), kUlps);
    EXPECT_EQ(computeReflectionMip(2, 7), 6); // above 1
    EXPECT_EQ(computeReflectionMip(-1, 7), 0);
    EXPECT_EQ(computeReflectionMip(kNaN, 7), 0);
    for (int lods : {1, 0, -3})
        EXPECT_EQ(computeRefractionMip(1, lods), 0); // one level, or none
}

RC_GTEST_PROP(ShaderRoughness, BuiltInExactFormInOneFraction, ())
{
    // The chain of power and back, resolved by hand: level/6 to the fourth is 4 r^4 / (1 + 3 r^4).
    const Real r = drawReal(Real(0.05), 1);
    const double fourth = std::pow(static_cast<double>(r), 4);
    const double expected = 6 * std::pow(4 * fourth / (1 + 3 * fourth), 0.25);
    RC_ASSERT(std::fabs(static_cast<double>(computeBuiltInMipExact(r)) - expected) < static_cast<double>(100 * kUlps));
    // And the parabola stays within a third of a level of it.
    const Real parabola = computeBuiltInMip(r);
    RC_ASSERT(std::fabs(parabola - Real(6) * r * (Real(1.7) - Real(0.7) * r)) < 8 * kUlps);
    RC_ASSERT(std::fabs(static_cast<double>(parabola) - expected) < 0.35);
}

TEST(ShaderRoughness, BuiltInEnds)
{
    EXPECT_EQ(computeBuiltInMip(0), 0);
    EXPECT_NEAR(computeBuiltInMip(1), 6, 8 * kUlps);
    EXPECT_NEAR(computeBuiltInMip(Real(0.5)), Real(4.05), 8 * kUlps); // not 3: it is not linear
    EXPECT_NEAR(computeBuiltInMipExact(1), 6, 8 * kUlps);
    EXPECT_NEAR(computeBuiltInMipExact(0), 0.15767, 1e-5);
    EXPECT_NEAR(computeBuiltInMipExact(kNaN), 0.15767, 1e-5);
    EXPECT_NEAR(computeBuiltInMip(kInfinity), 6, 8 * kUlps);
}

TEST(ShaderRoughness, SharperWhereTheSurfaceIsNearerThanTheCapture)
{
    EXPECT_NEAR(computeDistanceBasedRoughness(Real(0.5), 1, 2), Real(0.375), 2 * kUlps); // 0.25 + (0.5 - 0.25) * 0.5
    EXPECT_EQ(computeDistanceBasedRoughness(Real(0.5), 3, 2), Real(0.5));                // never rougher
    EXPECT_EQ(computeDistanceBasedRoughness(1, Real(0.1), 2), 1);                        // a diffuse one stays
    EXPECT_NEAR(computeDistanceBasedRoughness(Real(0.5), 0, 2), Real(0.25), 2 * kUlps);  // on the hit: r * r
    for (Real odd : {kNaN, kInfinity, Real(0)})
        EXPECT_EQ(computeDistanceBasedRoughness(Real(0.5), odd, odd), Real(0.5));
    EXPECT_EQ(computeDistanceBasedRoughness(Real(0.5), 1, 0), Real(0.5)); // the capture on the hit
    EXPECT_NEAR(computeDistanceBasedRoughness(Real(0.5), -1, 2), Real(0.25), 2 * kUlps);
}

TEST(ShaderRoughness, TheDominantDirectionLeansToTheNormal)
{
    const vec3 n(0, 1, 0);
    const vec3 v = normalize(vec3(-1, 1, 0));
    const vec3 r = normalize(vec3(1, 1, 0));
    EXPECT_NEAR(length(computeDominantDirection(n, r, v, 0, kDominantPlain) - r), 0, 4 * kUlps);
    EXPECT_NEAR(length(computeDominantDirection(n, r, v, 1, kDominantPlain) - n), 0, 4 * kUlps);
    // r = 0.9: r2 = 0.81, factor = (sqrt(0.19) + 0.81) * (0.19^2 + 0.19 * cos 45).
    const double factor = (std::sqrt(0.19) + 0.81) * (0.19 * 0.19 + 0.19 * std::sqrt(0.5));
    const double x = factor * std::sqrt(0.5);
    const double y = 1 - factor + factor * std::sqrt(0.5);
    const vec3 d = computeDominantDirection(n * 3.0, r * 2.0, v * 5.0, Real(0.9), kDominantPlain);
    EXPECT_NEAR(static_cast<double>(d.x / d.y), x / y, 1e-5);
    // The square of cos 45 is one half.
    const double squared = (std::sqrt(0.19) + 0.81) * (0.19 * 0.19 + 0.19 * 0.5);
    const vec3 e = computeDominantDirection(n, r, v, Real(0.9), kDominantSquared);
    EXPECT_NEAR(static_cast<double>(e.x / e.y), squared * std::sqrt(0.5) / (1 - squared + squared * std::sqrt(0.5)),
                1e-5);
    EXPECT_NEAR(length(computeDominantDirection(n, r, v, Real(0.9), kDominantOff) - r), 0, 4 * kUlps);
    // What is missing is left out.
    EXPECT_EQ(computeDominantDirection(vec3(0), vec3(1, 0, 0), v, Real(0.5), kDominantPlain), vec3(1, 0, 0));
    EXPECT_EQ(computeDominantDirection(n, vec3(1, 0, 0), vec3(0), Real(0.5), kDominantPlain), vec3(1, 0, 0));
    EXPECT_EQ(computeDominantDirection(n, vec3(0), vec3(0), Real(0.5), kDominantPlain), n);
    EXPECT_EQ(computeDominantDirection(vec3(0), vec3(0), vec3(0), Real(0.5), kDominantPlain), vec3(0));
}

RC_GTEST_PROP(ShaderRoughness, AnswersAnything, ())
{
    const Real r = drawHostile();
    const int lods = *rc::gen::inRange(-2, 15);
    RC_ASSERT(isFinite(computeReflectionMip(r, lods)) && isFinite(computeRefractionMip(r, lods)));
    RC_ASSERT(isFinite(computeBuiltInMip(r)) && isFinite(computeBuiltInMipExact(r)));
    const Real sharper = computeDistanceBasedRoughness(r, drawHostile(), drawHostile());
    RC_ASSERT(sharper >= 0 && sharper <= 1);
    const vec3 d = computeDominantDirection(drawHostileVector<vec3>(), drawHostileVector<vec3>(),
                                            drawHostileVector<vec3>(), r, kDominantSquared);
    RC_ASSERT(isFinite(d));
    RC_ASSERT(length(d) < 1 + kUlps);
}
