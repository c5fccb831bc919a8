#include "tests/shader/generators.h"

#include "harness/backend/cpu/glsl.h"

#include "crossray/probe/influence.glsl"

#include "harness/backend/cpu/glsl_end.h"

using namespace CROSSRAY_SHADER_NAMESPACE;

namespace {

// A box of half extents 2, 3, 4 m around (1, 0, 0), blended over 1 m, captured at its centre, all faces open.
ProbeInfluence makeBox()
{
    return {kProbeShapeBox, vec3(1, 0, 0), mat3(1), vec3(2, 3, 4), vec3(1),       vec3(1),
            vec3(0),        vec3(0),       vec3(1), vec3(1),       vec3(1, 0, 0), 1};
}

ProbeInfluence makeSphere(Real radius, Real blend)
{
    ProbeInfluence probe = makeBox();
    probe.shape = kProbeShapeSphere;
    probe.centerWS = vec3(0);
    probe.capturePositionWS = vec3(0);
    probe.halfExtents = vec3(radius, 0, 0);
    probe.blendPositive = vec3(blend, 0, 0);
    return probe;
}

double clampUnit(double x)
{
    return std::min<double>(1, std::max<double>(0, x));
}

} // namespace

// By the distance to the surface instead of the centre's: depth below it over the blend distance.
RC_GTEST_PROP(ShaderProbeInfluence, SphereIsDepthOverBlend, ())
{
    const Real radius = drawReal(Real(0.5), 10);
    const Real blend = drawReal(Real(0.01), 15); // beyond the radius too
    const Real r = radius * drawReal(0, Real(1.5));
    const vec3 p = drawUnitVector<vec3>() * r;
    const double depth = static_cast<double>(radius) - static_cast<double>(r);
    const double expected = clampUnit(depth / static_cast<double>(blend));
    RC_ASSERT(std::fabs(static_cast<double>(computeSphereInfluence(p, radius, blend)) - expected) <
              static_cast<double>(20 * kUlps * radius / blend));
}

// Face by face: a plane each, the depth behind it over the face's own blend distance; the worst face decides.
RC_GTEST_PROP(ShaderProbeInfluence, BoxIsTheWorstOfSixFaces, ())
{
    const vec3 e(drawReal(Real(0.5), 5), drawReal(Real(0.5), 5), drawReal(Real(0.5), 5));
    const vec3 bp(drawReal(Real(0.05), 6), drawReal(Real(0.05), 6), drawReal(Real(0.05), 6));
    const vec3 bn(drawReal(Real(0.05), 6), drawReal(Real(0.05), 6), drawReal(Real(0.05), 6));
    const vec3 p = drawPoint<vec3>(Real(1.2)) * e;
    double expected = 1;
    for (int axis = 0; axis < 3; ++axis) {
        for (double side : {1.0, -1.0}) {
            const double depth = static_cast<double>(e[axis]) - side * static_cast<double>(p[axis]);
            const double blend = static_cast<double>(side > 0 ? bp[axis] : bn[axis]);
            expected = std::min(expected, clampUnit(depth / blend));
        }
    }
    RC_ASSERT(std::fabs(static_cast<double>(computeBoxInfluence(p, e, bp, bn)) - expected) <
              static_cast<double>(400 * kUlps));
}

TEST(ShaderProbeInfluence, BlendDistancesOfZeroAndBeyondHalfTheExtent)
{
    // Zero: a step. Inside the box's faces, outside the sphere's surface, 0.1 mm wide.
    EXPECT_EQ(computeSphereInfluence(vec3(0, 1, 0), 1, 0), 1);
    EXPECT_EQ(computeSphereInfluence(vec3(0, Real(1.0002), 0), 1, 0), 0);
    EXPECT_EQ(computeBoxInfluence(vec3(1, 0, 0), vec3(1), vec3(0), vec3(0)), 0);
    EXPECT_EQ(computeBoxInfluence(vec3(Real(0.9998), 0, 0), vec3(1), vec3(0), vec3(0)), 1);
    EXPECT_NEAR(computeBoxInfluence(vec3(Real(0.99995), 0, 0), vec3(1), vec3(0), vec3(0)), Real(0.5), 2e-3);
    // Four times the extent: a quarter in the middle, and never more.
    EXPECT_EQ(computeBoxInfluence(vec3(0), vec3(1), vec3(4), vec3(4)), Real(0.25));
    EXPECT_EQ(computeSphereInfluence(vec3(0), 1, 4), Real(0.25));
    // One wide face blend leaves the others alone.
    EXPECT_NEAR(computeBoxInfluence(vec3(-1, 0, 0), vec3(2), vec3(Real(0.5)), vec3(4, Real(0.5), Real(0.5))),
                Real(0.25), kUlps);
}

TEST(ShaderProbeInfluence, BlendNormalByTheAngleBetweenNormalAndWayFromTheCapture)
{
    const std::vector<std::pair<Real, Real>> cosines{
        {1, 0}, {Real(0.6), 0}, {Real(0.5), Real(0.25)}, {Real(0.4), Real(0.5)}, {Real(0.2), 1}, {0, 1}, {-1, 1}};
    for (auto [cosine, fade] : cosines) {
        const vec3 normal(std::sqrt(1 - cosine * cosine), cosine, 0);
        EXPECT_NEAR(computeBlendNormalFade(normal * 7.0, vec3(0, 3, 0)), fade, 8 * kUlps) << cosine;
    }
    EXPECT_EQ(computeBlendNormalFade(vec3(0, 1, 0), vec3(0)), 1); // at the capture position
    // So near to it that the way is rounding, and its direction noise.
    for (Real rounding : {Real(1e-16), Real(1e-7), Real(-1e-7), Real(9e-5)})
        EXPECT_EQ(computeBlendNormalFade(vec3(0, 1, 0), vec3(0, rounding, 0)), 1) << rounding;
    EXPECT_EQ(computeBlendNormalFade(vec3(0, 1, 0), vec3(0, Real(2e-4), 0)), 0);
    EXPECT_EQ(computeBlendNormalFade(vec3(0), vec3(0, 1, 0)), 1);
    EXPECT_EQ(computeBlendNormalFade(vec3(kNaN), vec3(0, 1, 0)), 1);
}

// Claim 12: outside the blend-normal volume a surface that faces away gets nothing; inside, or facing it, all.
TEST(ShaderProbeInfluence, OutsideTheBlendNormalVolumeASurfaceThatFacesAwayGetsNothing)
{
    ProbeInfluence box = makeBox();
    box.blendNormalPositive = vec3(Real(1.5), 0, 0);
    const vec3 near(Real(1.25), 0, 0);  // 0.25 m from the centre: inside the blend-normal volume (0.5 m)
    const vec3 outer(Real(1.75), 0, 0); // outside it, still 1.25 m from the face: volume weight 1
    const vec3 away(1, 0, 0);
    EXPECT_EQ(computeProbeWeight(box, outer, away, away).weight, 0);
    EXPECT_EQ(computeProbeWeight(box, outer, -away, away).weight, 1);
    EXPECT_EQ(computeProbeWeight(box, near, away, away).weight, 1);
    EXPECT_EQ(computeProbeWeight(box, vec3(Real(1.5), 0, 0), away, away).blendNormal, 1); // on its face: inside
    // The other faces have their own distance: 0 here.
    EXPECT_EQ(computeProbeWeight(box, vec3(Real(0.25), 0, 0), -away, away).weight, 1);

    ProbeInfluence sphere = makeSphere(4, 1);
    sphere.blendNormalPositive = vec3(2, 0, 0);
    EXPECT_EQ(computeProbeWeight(sphere, vec3(0, 0, Real(2.5)), vec3(0, 0, 1), away).weight, 0);
    EXPECT_EQ(computeProbeWeight(sphere, vec3(0, 0, 2), vec3(0, 0, 1), away).weight, 1);
}

TEST(ShaderProbeInfluence, FacesLetTheirSideThrough)
{
    const vec3 none(0);
    const vec3 onlyX(1, 0, 0);
    EXPECT_EQ(computeFaceFade(vec3(1, 0, 0), none, none), 0);
    EXPECT_EQ(computeFaceFade(vec3(1, 0, 0), onlyX, none), 1);
    EXPECT_EQ(computeFaceFade(vec3(-1, 0, 0), onlyX, none), 0);
    EXPECT_EQ(computeFaceFade(vec3(-1, 0, 0), none, onlyX), 1);
    EXPECT_EQ(computeFaceFade(vec3(0, 1, 0), onlyX, onlyX), 0);
    // A cosine of 0.25 is nothing, 0.5 all; between linear, and the face's own fade scales it.
    const auto towards = [](Real cosine) { return vec3(cosine, std::sqrt(1 - cosine * cosine), 0); };
    EXPECT_NEAR(computeFaceFade(towards(Real(0.25)), onlyX, none), 0, 8 * kUlps);
    EXPECT_NEAR(computeFaceFade(towards(Real(0.375)), onlyX, none), Real(0.5), 8 * kUlps);
    EXPECT_NEAR(computeFaceFade(towards(Real(0.5)), onlyX, none), 1, 8 * kUlps);
    EXPECT_NEAR(computeFaceFade(vec3(1, 0, 0), vec3(Real(0.25), 0, 0), none), Real(0.75), 8 * kUlps);
    EXPECT_EQ(computeFaceFade(none, vec3(1), vec3(1)), 0);
}

RC_GTEST_PROP(ShaderProbeInfluence, OpenFacesLetAllThrough, ())
{
    RC_ASSERT(computeFaceFade(drawUnitVector<vec3>(), vec3(1), vec3(1)) == Real(1));
}

TEST(ShaderProbeInfluence, TheWeightIsTheSmoothedProductTimesTheProbes)
{
    ProbeInfluence box = makeBox();
    box.weight = Real(0.5);
    box.facePositive = vec3(Real(0.25), 1, 1);
    // 0.5 m from the +x face: volume 0.5; reflection along +x: 3 * 0.25; alpha 0.375.
    const ProbeWeight w = computeProbeWeight(box, vec3(Real(2.5), 0, 0), vec3(0, 1, 0), vec3(5, 0, 0));
    EXPECT_NEAR(w.volume, Real(0.5), 8 * kUlps);
    EXPECT_NEAR(w.faceFade, Real(0.75), 8 * kUlps);
    const double alpha = 0.375;
    EXPECT_NEAR(static_cast<double>(w.weight), 0.5 * (3 * alpha * alpha - 2 * alpha * alpha * alpha), 1e-6);
    EXPECT_EQ(multiplyProbeColor(vec3(1, 2, 4), Real(0.5)), vec3(Real(0.5), 1, 2));
}

// Turning the volume, the point, the normal and the ray together changes nothing.
RC_GTEST_PROP(ShaderProbeInfluence, TurnsWithItsFrame, ())
{
    const vec3 x = drawUnitVector<vec3>();
    const vec3 y = normalize(cross(x, std::fabs(x.y) < Real(0.9) ? vec3(0, 1, 0) : vec3(1, 0, 0)));
    const mat3 turn(x, y, cross(x, y));
    ProbeInfluence upright = makeBox();
    upright.centerWS = vec3(0);
    upright.capturePositionWS = vec3(Real(0.3), 0, Real(-0.2));
    upright.blendNormalPositive = vec3(1);
    upright.facePositive = vec3(Real(0.3), 1, Real(0.5));
    ProbeInfluence turned = upright;
    turned.worldFromInfluence = turn;
    turned.centerWS = vec3(1, 2, 3);
    turned.capturePositionWS = turn * upright.capturePositionWS + turned.centerWS;
    const vec3 p = drawPoint<vec3>(1) * upright.halfExtents;
    // The blend normal has a hard edge: keep off it.
    RC_PRE(std::fabs(maxComponent(p - upright.halfExtents + vec3(1))) > Real(1e-3));
    const vec3 n = drawUnitVector<vec3>();
    const vec3 r = drawUnitVector<vec3>();
    const Real a = computeProbeWeight(upright, p, n, r).weight;
    const Real b = computeProbeWeight(turned, turn * p + turned.centerWS, turn * n, turn * r).weight;
    RC_ASSERT(std::fabs(a - b) < 400 * kUlps);
}

TEST(ShaderProbeInfluence, ShapesMustMatch)
{
    EXPECT_TRUE(acceptsProxyShape(kProbeShapeBox, kProbeShapeBox));
    EXPECT_TRUE(acceptsProxyShape(kProbeShapeSphere, kProbeShapeSphere));
    EXPECT_TRUE(acceptsProxyShape(kProbeShapeSphere, kProbeShapeInfinite));
    EXPECT_FALSE(acceptsProxyShape(kProbeShapeBox, kProbeShapeSphere));
    EXPECT_FALSE(acceptsProxyShape(kProbeShapeSphere, kProbeShapeBox));
    EXPECT_FALSE(acceptsProxyShape(kProbeShapeInfinite, kProbeShapeInfinite));
    EXPECT_FALSE(acceptsProxyShape(99, 99));
}

TEST(ShaderProbeInfluence, WithoutSizeOrShapeNothing)
{
    EXPECT_EQ(computeSphereInfluence(vec3(0), kNaN, 1), 0);
    EXPECT_EQ(computeSphereInfluence(vec3(0), -1, 1), 0);
    EXPECT_EQ(computeSphereInfluence(vec3(0, kNaN, 0), 1, 1), 0);
    EXPECT_EQ(computeBoxInfluence(vec3(0), vec3(1, kNaN, 1), vec3(1), vec3(1)), 0);
    EXPECT_EQ(computeBoxInfluence(vec3(0), vec3(1, 1, -1), vec3(1), vec3(1)), 0);
    EXPECT_EQ(computeBoxInfluence(vec3(0, 0, kNaN), vec3(1), vec3(1), vec3(1)), 0);
    ProbeInfluence odd = makeBox();
    odd.shape = kProbeShapeInfinite;
    EXPECT_EQ(computeProbeWeight(odd, vec3(1, 0, 0), vec3(1), vec3(1)).weight, 0);
    EXPECT_EQ(multiplyProbeColor(vec3(kNaN, -1, kInfinity), 2), vec3(0));
    EXPECT_EQ(multiplyProbeColor(vec3(1), kNaN), vec3(0));
    EXPECT_EQ(multiplyProbeColor(vec3(40000), 2), vec3(65504));
}

RC_GTEST_PROP(ShaderProbeInfluence, AnswersAnything, ())
{
    ProbeInfluence probe;
    probe.shape = *rc::gen::inRange(0, 5);
    probe.centerWS = *rc::gen::inRange(0, 2) == 0 ? vec3(0) : drawHostileVector<vec3>();
    probe.worldFromInfluence = mat3(1);
    for (vec3* v : {&probe.halfExtents, &probe.blendPositive, &probe.blendNegative, &probe.blendNormalPositive,
                    &probe.blendNormalNegative, &probe.facePositive, &probe.faceNegative, &probe.capturePositionWS})
        *v = drawHostileVector<vec3>();
    probe.weight = drawHostile();
    const ProbeWeight w =
        computeProbeWeight(probe, drawHostileVector<vec3>(), drawHostileVector<vec3>(), drawHostileVector<vec3>());
    for (Real part : {w.volume, w.blendNormal, w.faceFade, w.weight})
        RC_ASSERT(part >= 0 && part <= 1);
    const vec3 color = multiplyProbeColor(drawHostileVector<vec3>(), drawHostile());
    RC_ASSERT(isFinite(color) && minComponent(color) >= 0 && maxComponent(color) <= Real(65504));
}
