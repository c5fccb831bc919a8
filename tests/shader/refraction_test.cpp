#include "tests/shader/generators.h"

#include "harness/backend/cpu/glsl.h"

#include "crossray/refract/absorption.glsl"
#include "crossray/refract/refraction.glsl"

#include "harness/backend/cpu/glsl_end.h"

using namespace CROSSRAY_SHADER_NAMESPACE;

namespace {

// Snell's law by angles, apart from the vector formula: the refracted direction in the plane of incidence.
vec3 refractByAngle(vec3 incident, vec3 normal, Real relativeIndex)
{
    const Real cosine = -dot(incident, normal);
    const vec3 tangent = incident + normal * cosine;
    const Real sine = length(tangent);
    if (sine == 0) return incident;
    const Real angle = std::asin(sine / relativeIndex);
    return tangent * (std::sin(angle) / sine) - normal * std::cos(angle);
}

struct Entry {
    vec3 position, normal, view;
    Real index, thickness;
};

// An ordinary surface point: at most 84 degrees from the normal, index 1.05 to 2.5.
Entry drawEntry()
{
    Entry e{drawPoint<vec3>(3), drawUnitVector<vec3>(), vec3(0), drawReal(Real(1.05), Real(2.5)),
            drawReal(Real(0.01), 3)};
    vec3 v = drawUnitVector<vec3>();
    if (dot(v, e.normal) < 0) v = -v;
    e.view = normalize(v + e.normal * Real(0.1));
    return e;
}

Real angleBetween(vec3 a, vec3 b)
{
    return 2 * std::asin(std::min(Real(1), length(a - b) / 2));
}

void expectSane(const RefractionExit& exit, bool hasView)
{
    RC_ASSERT(isFinite(exit.positionWS));
    RC_ASSERT(isFinite(exit.pathLength) && exit.pathLength >= 0);
    RC_ASSERT(std::fabs(length(exit.dirWS) - (hasView ? 1 : 0)) < 8 * kUlps);
    RC_ASSERT(exit.status >= 0 && exit.status < kHitReasonCount);
}

} // namespace

// A ray through a real sphere, by geometry: it enters, runs to the far root, and leaves by Snell's law there.
RC_GTEST_PROP(ShaderRefraction, SphereIsExactOnASphere, ())
{
    const Entry e = drawEntry();
    const RefractionExit exit = computeRefractionSphere(e.position, e.normal, e.view, e.index, e.thickness);
    const vec3 center = e.position - e.normal * (e.thickness / 2);
    const vec3 inside = refractByAngle(-e.view, e.normal, e.index);
    const Real far = 2 * dot(center - e.position, inside);
    const vec3 leave = e.position + inside * far;
    const vec3 out = refractByAngle(inside, normalize(center - leave), 1 / e.index);
    RC_ASSERT(exit.status == kHitReasonNone);
    RC_ASSERT(std::fabs(exit.pathLength - far) < 8 * kUlps * (e.thickness + 3));
    RC_ASSERT(length(exit.positionWS - leave) < 8 * kUlps * (e.thickness + 3));
    // At the exit, too, the angle is as steep as the entry's: asin loses there what the cosine is small.
    RC_ASSERT(angleBetween(exit.dirWS, out) < 100 * kUlps / dot(e.normal, e.view));
    RC_ASSERT(std::fabs(length(exit.positionWS - center) - e.thickness / 2) < 8 * kUlps * (e.thickness + 3));
}

RC_GTEST_PROP(ShaderRefraction, BoxIsExactOnASlab, ())
{
    const Entry e = drawEntry();
    const RefractionExit exit = computeRefractionBox(e.position, e.normal, e.view, e.index, e.thickness);
    RC_ASSERT(exit.status == kHitReasonNone);
    RC_ASSERT(angleBetween(exit.dirWS, -e.view) < 2 * kUlps);
    // The exit lies on the far face, and the way there follows Snell's law.
    RC_ASSERT(std::fabs(dot(exit.positionWS - e.position, e.normal) + e.thickness) < 16 * kUlps * (e.thickness + 3));
    const vec3 inside = refractByAngle(-e.view, e.normal, e.index);
    RC_ASSERT(length(exit.positionWS - e.position - inside * exit.pathLength) < 16 * kUlps * (e.thickness + 3));
}

TEST(ShaderRefraction, KnownNumbers)
{
    // 45 degrees into index sqrt(2): 30 degrees inside. A slab of 1 m: path 2/sqrt(3); a sphere of diameter 1: path
    // cos 30.
    const Real s = std::sqrt(Real(0.5));
    const vec3 view(s, s, 0);
    RefractionExit box = computeRefractionBox(vec3(0), vec3(0, 1, 0), view, std::sqrt(Real(2)), 1);
    EXPECT_NEAR(box.pathLength, Real(1.1547005383792517), kUlps);
    EXPECT_NEAR(box.positionWS.x, Real(-0.5773502691896257), kUlps);
    EXPECT_NEAR(box.positionWS.y, -1, kUlps);
    RefractionExit sphere = computeRefractionSphere(vec3(0), vec3(0, 1, 0), view, std::sqrt(Real(2)), 1);
    EXPECT_NEAR(sphere.pathLength, Real(0.8660254037844386), kUlps);
    // Bent by 15 degrees twice: from 45 degrees off the downward axis to 15.
    EXPECT_NEAR(sphere.dirWS.x, -std::sin(Real(0.2617993877991494)), kUlps);
    EXPECT_NEAR(sphere.dirWS.y, -std::cos(Real(0.2617993877991494)), kUlps);
    RefractionExit thin = computeRefractionThin(vec3(0), vec3(0, 1, 0), view, std::sqrt(Real(2)));
    EXPECT_NEAR(thin.pathLength, Real(0.005) * Real(1.1547005383792517), kUlps);
}

TEST(ShaderRefraction, StraightOnAndNone)
{
    for (int model : {kRefractionSphere, kRefractionBox, kRefractionThin, kRefractionNone, 17}) {
        RefractionExit exit = computeRefraction(model, vec3(1, 2, 3), vec3(0, 0, 1), vec3(0, 0, 1), Real(1.5), 2);
        const Real path = model == kRefractionThin ? Real(0.005) : model == kRefractionNone || model == 17 ? 0 : 2;
        EXPECT_NEAR(exit.pathLength, path, kUlps) << model;
        EXPECT_NEAR(exit.positionWS.z, 3 - path, kUlps) << model;
        EXPECT_NEAR(exit.dirWS.z, -1, kUlps) << model;
        EXPECT_EQ(exit.status, kHitReasonNone) << model;
    }
}

TEST(ShaderRefraction, DegenerateInputIsAnswered)
{
    const vec3 p(1, 2, 3), n(0, 1, 0), v = normalize(vec3(1, 1, 0));
    // Total reflection on entry: index 0.5 beyond 30 degrees.
    for (int model : {kRefractionSphere, kRefractionBox, kRefractionThin}) {
        RefractionExit total = computeRefraction(model, p, n, v, Real(0.5), 1);
        EXPECT_EQ(total.status, kHitReasonNoRefractedRay);
        EXPECT_NEAR(total.dirWS.y, std::sqrt(Real(0.5)), kUlps);
        EXPECT_EQ(total.pathLength, 0);
        for (Real index : {Real(0), Real(-1), kNaN, kInfinity}) {
            RefractionExit none = computeRefraction(model, p, n, v, index, 1);
            EXPECT_EQ(none.status, kHitReasonDegenerateInput);
            EXPECT_TRUE(none.positionWS == p);
            EXPECT_NEAR(none.dirWS.x, -v.x, kUlps);
        }
        EXPECT_EQ(computeRefraction(model, p, vec3(0), v, Real(1.5), 1).status, kHitReasonDegenerateRay);
        EXPECT_EQ(computeRefraction(model, p, n, vec3(0), Real(1.5), 1).status, kHitReasonDegenerateRay);
        EXPECT_EQ(computeRefraction(model, p, -v, v, Real(1.5), 1).status, kHitReasonDegenerateRay);
        EXPECT_EQ(computeRefraction(model, vec3(kNaN, 0, 0), n, v, Real(1.5), 1).status, kHitReasonDegenerateRay);
        // A normal of another length is the same normal.
        RefractionExit a = computeRefraction(model, p, n, v, Real(1.5), 1);
        RefractionExit b = computeRefraction(model, p, n * Real(7), v * Real(0.1), Real(1.5), 1);
        EXPECT_NEAR(length(a.positionWS - b.positionWS), 0, 4 * kUlps);
        // Facing away by a normal map: as at grazing, and continuous with it.
        RefractionExit away = computeRefraction(model, p, vec3(0, -1, 0) + Real(0.2) * v, v, Real(1.5), 1);
        EXPECT_EQ(away.status, kHitReasonNone);
    }
    EXPECT_EQ(computeRefractionNone(p, vec3(0)).status, kHitReasonDegenerateRay);
    // No thickness: the position stays; the slab keeps the direction, the sphere's limit bends it.
    RefractionExit flat = computeRefractionSphere(p, n, v, Real(1.5), 0);
    RefractionExit small = computeRefractionSphere(p, n, v, Real(1.5), Real(1e-3));
    EXPECT_TRUE(flat.positionWS == p);
    EXPECT_NEAR(length(flat.dirWS - small.dirWS), 0, kUlps);
    EXPECT_EQ(computeRefractionBox(p, n, v, Real(1.5), kNaN).pathLength, 0);
    // Index 1 at grazing: 1 cm of slab is 1 m of path at most, and the ray is not bent.
    RefractionExit grazing = computeRefractionBox(p, n, normalize(vec3(1, Real(1e-5), 0)), 1, Real(0.01));
    EXPECT_LE(grazing.pathLength, Real(1.00001));
    RefractionExit sphere = computeRefractionSphere(p, n, normalize(vec3(1, Real(1e-3), 0)), 1, 2);
    EXPECT_EQ(sphere.status, kHitReasonNone);
    EXPECT_NEAR(sphere.dirWS.x, -1, Real(1e-5));
    EXPECT_NEAR(sphere.pathLength, Real(2e-3), Real(1e-6));
}

TEST(ShaderRefraction, HoldsUpToTheHorizon)
{
    // Every tenth of a thousandth of a degree over the last tenth: always a unit direction, and without jumps.
    vec3 last(0);
    for (int step = 0; step <= 1000; ++step) {
        const Real elevation = static_cast<Real>(1000 - step) * Real(1.7453292519943295e-6);
        const vec3 view(std::cos(elevation), std::sin(elevation), 0);
        RefractionExit exit = computeRefractionSphere(vec3(0), vec3(0, 1, 0), view, Real(1.5), 2);
        ASSERT_EQ(exit.status, kHitReasonNone);
        ASSERT_NEAR(length(exit.dirWS), 1, kUlps);
        if (step > 0) {
            ASSERT_LT(length(exit.dirWS - last), Real(1e-4)) << step;
        }
        last = exit.dirWS;
    }
}

RC_GTEST_PROP(ShaderRefraction, AnswersAnything, ())
{
    const int model = *rc::gen::inRange(-1, 5);
    const vec3 view = *rc::gen::inRange(0, 2) == 0 ? drawHostileVector<vec3>() : drawUnitVector<vec3>();
    const vec3 normal = *rc::gen::inRange(0, 2) == 0 ? drawHostileVector<vec3>() : drawUnitVector<vec3>();
    const RefractionExit exit =
        computeRefraction(model, drawHostileVector<vec3>(), normal, view, drawHostile(), drawHostile());
    expectSane(exit, hasDirection(view));
}

TEST(ShaderAbsorption, ColourAfterTheDistance)
{
    const vec3 color(Real(0.9), Real(0.5), Real(0.1));
    vec3 one = computeTransmittance(color, 2, 2);
    vec3 two = computeTransmittance(color, 2, 4);
    for (int channel = 0; channel < 3; ++channel) {
        EXPECT_NEAR(one[channel], color[channel], kUlps);
        EXPECT_NEAR(two[channel], color[channel] * color[channel], kUlps);
    }
    EXPECT_TRUE(computeTransmittance(color, 2, 0) == vec3(1));
    EXPECT_TRUE(computeTransmittance(vec3(2, kNaN, 1), 1, 5) == vec3(1));
}

RC_GTEST_PROP(ShaderAbsorption, NeverAmplifies, ())
{
    const vec3 t = computeTransmittance(drawHostileVector<vec3>(), drawHostile(), drawHostile());
    for (int channel = 0; channel < 3; ++channel)
        RC_ASSERT(t[channel] >= 0 && t[channel] <= 1);
}
