#include "tests/shader/generators.h"

#include "harness/backend/cpu/glsl.h"

#include "crossray/project/proxy.glsl"
#include "tests/shader/views.h"

#include "harness/backend/cpu/glsl_end.h"

using namespace CROSSRAY_SHADER_NAMESPACE;

namespace {

const mat3 kUpright(1);

mat3 drawRotation()
{
    const vec3 x = drawUnitVector<vec3>();
    const vec3 y = normalize(cross(x, std::fabs(x.y) < Real(0.9) ? vec3(0, 1, 0) : vec3(1, 0, 0)));
    return mat3(x, y, cross(x, y));
}

bool isMiss(const ProxyHit& hit, int reason)
{
    return !hit.hit && hit.reason == reason && hit.distance == 0;
}

} // namespace

// From inside: the hit is on the box, ahead, and nothing before it is: the largest of the scaled coordinates is 1.
RC_GTEST_PROP(ShaderProxy, BoxFromInsideLeavesThroughAFace, ())
{
    const mat3 rotation = drawRotation();
    const vec3 center = drawPoint<vec3>(5);
    const vec3 extents(drawReal(Real(0.5), 4), drawReal(Real(0.5), 4), drawReal(Real(0.5), 4));
    const vec3 local = drawPoint<vec3>(Real(0.999)) * extents;
    const vec3 dir = drawUnitVector<vec3>();
    const vec3 origin = center + rotation * local;
    const ProxyHit hit = projectProxyBox(origin, dir, center, rotation, extents);
    RC_ASSERT(hit.hit && hit.reason == kHitReasonNone);
    const vec3 scaled = abs(transpose(rotation) * (hit.positionWS - center)) / extents;
    RC_ASSERT(std::fabs(maxComponent(scaled) - 1) < 200 * kUlps);
    RC_ASSERT(length(hit.positionWS - origin - dir * hit.distance) < 20 * kUlps);
    // A little further it is outside, so that it is the far face.
    const vec3 beyond = abs(transpose(rotation) * (hit.positionWS + dir * Real(0.01) - center)) / extents;
    RC_ASSERT(maxComponent(beyond) > 1);
}

// From outside a ray that runs through a point inside meets the box, at the same far face as the ray from that point.
RC_GTEST_PROP(ShaderProxy, FromOutsideTheFarFaceToo, ())
{
    const vec3 extents(drawReal(Real(0.5), 4), drawReal(Real(0.5), 4), drawReal(Real(0.5), 4));
    const vec3 inside = drawPoint<vec3>(Real(0.99)) * extents;
    const vec3 dir = drawUnitVector<vec3>();
    const vec3 origin = inside - dir * Real(20);
    const ProxyHit far = projectProxyBox(origin, dir, vec3(0), kUpright, extents);
    const ProxyHit near = projectProxyBox(inside, dir, vec3(0), kUpright, extents);
    RC_ASSERT(far.hit && near.hit);
    // Grazing a face moves the hit along it: compare on the box's own scale.
    RC_ASSERT(std::fabs(maxComponent(abs(far.positionWS) / extents) - 1) < 400 * kUlps);
    RC_ASSERT(isMiss(projectProxyBox(origin, -dir, vec3(0), kUpright, extents), kHitReasonNoProxyHit));
}

RC_GTEST_PROP(ShaderProxy, SphereHitsAreOnTheSphere, ())
{
    const vec3 center = drawPoint<vec3>(5);
    const Real radius = drawReal(Real(0.5), 6);
    const vec3 origin = center + drawUnitVector<vec3>() * (radius * drawReal(0, 2));
    const vec3 dir = drawUnitVector<vec3>();
    const ProxyHit hit = projectProxySphere(origin, dir, center, radius);
    // By the distance of the ray's line from the centre, and whether the sphere is ahead.
    const vec3 offset = center - origin;
    const Real ahead = dot(offset, dir);
    const Real missed = length(offset - dir * ahead);
    const bool inside = length(offset) < radius;
    if (std::fabs(missed - radius) > Real(1e-2) && std::fabs(length(offset) - radius) > Real(1e-2)) {
        RC_ASSERT(hit.hit == (inside || (missed < radius && ahead > 0)));
    }
    if (hit.hit) {
        RC_ASSERT(std::fabs(length(hit.positionWS - center) - radius) < Real(2e-4) * radius);
        RC_ASSERT(hit.distance >= ahead - Real(1e-3));
        RC_ASSERT(length(hit.positionWS - origin - dir * hit.distance) < 40 * kUlps);
    } else {
        RC_ASSERT(isMiss(hit, kHitReasonNoProxyHit));
    }
}

TEST(ShaderProxy, KnownNumbers)
{
    ProxyHit box = projectProxyBox(vec3(1, 0, 0), vec3(0, 3, 4), vec3(0, 1, 0), kUpright, vec3(2, 3, 4));
    EXPECT_TRUE(box.hit); // the direction is normalised: z face at 5 m, y face at 4 / 0.6
    EXPECT_NEAR(box.distance, 5, 8 * kUlps);
    EXPECT_NEAR(box.positionWS.y, 3, 8 * kUlps);
    ProxyHit sphere = projectProxySphere(vec3(3, 4, 0), vec3(-1, 0, 0), vec3(0), 5);
    EXPECT_NEAR(sphere.distance, 6, 8 * kUlps);
    ProxyHit infinite = projectProxyInfinite(vec3(1, 2, 3), vec3(0, 0, -2));
    EXPECT_EQ(infinite.distance, 65504);
    EXPECT_EQ(infinite.positionWS.z, 3 - Real(65504));
}

TEST(ShaderProxy, ZeroComponentsAndFaces)
{
    const vec3 e(1, 2, 3);
    for (Real zero : {Real(0.0), Real(-0.0)}) {
        for (vec3 origin : {vec3(0), vec3(1, 0, 0), vec3(-1, 0, 0), vec3(1, 2, 0), vec3(1, 2, -3)}) {
            ProxyHit hit = projectProxyBox(origin, vec3(zero, zero, 1), vec3(0), kUpright, e);
            EXPECT_TRUE(hit.hit);
            EXPECT_EQ(hit.positionWS.z, 3);
            EXPECT_EQ(hit.positionWS.x, origin.x);
        }
        EXPECT_TRUE(isMiss(projectProxyBox(vec3(Real(1.1), 0, 0), vec3(zero, 0, 1), vec3(0), kUpright, e), 6));
    }
    // Along a face but for a rounding, outwards: the face is not met, as if the ray ran along it.
    for (Real rounding : {Real(1e-17), Real(6e-8), Real(-6e-8)}) {
        ProxyHit hit = projectProxyBox(vec3(1, 2, 0), vec3(rounding, rounding, 1), vec3(0), kUpright, e);
        EXPECT_TRUE(hit.hit);
        EXPECT_EQ(hit.positionWS.z, 3) << rounding;
    }
    // On a face, outwards: the origin itself. Outside by a rounding: the same.
    for (Real x : {Real(1), 1 + kUlps, 1 - kUlps}) {
        ProxyHit hit = projectProxyBox(vec3(x, 0, 0), vec3(1, 0, 0), vec3(0), kUpright, e);
        EXPECT_TRUE(hit.hit);
        EXPECT_NEAR(hit.distance, 0, 2 * kUlps);
        ProxyHit ball = projectProxySphere(vec3(x, 0, 0), vec3(1, 0, 0), vec3(0), 1);
        EXPECT_TRUE(ball.hit);
        EXPECT_NEAR(ball.distance, 0, 2 * kUlps);
        ProxyHit tangent = projectProxySphere(vec3(1, 0, 0), vec3(0, 1, 0), vec3(0), 1);
        EXPECT_TRUE(tangent.hit);
        EXPECT_NEAR(tangent.distance, 0, 2 * kUlps);
    }
    // Through an edge exactly.
    EXPECT_TRUE(projectProxyBox(vec3(-2, 1, 0), vec3(1, 1, 0), vec3(0), kUpright, e).hit);
    // Flat and empty proxies.
    EXPECT_TRUE(projectProxyBox(vec3(0, -5, 0), vec3(0, 1, 0), vec3(0), kUpright, vec3(1, 0, 1)).hit);
    EXPECT_FALSE(projectProxySphere(vec3(0, -5, 1), vec3(0, 1, 0), vec3(0), 0).hit);
}

TEST(ShaderProxy, DegenerateInputIsAnswered)
{
    const vec3 e(1);
    EXPECT_TRUE(isMiss(projectProxyBox(vec3(0), vec3(0), vec3(0), kUpright, e), kHitReasonDegenerateRay));
    EXPECT_TRUE(isMiss(projectProxyBox(vec3(kNaN), vec3(1), vec3(0), kUpright, e), kHitReasonDegenerateRay));
    EXPECT_TRUE(
        isMiss(projectProxyBox(vec3(0), vec3(1), vec3(0), kUpright, vec3(-1, 1, 1)), kHitReasonDegenerateInput));
    EXPECT_TRUE(isMiss(projectProxySphere(vec3(0), vec3(1), vec3(0), kNaN), kHitReasonDegenerateInput));
    EXPECT_TRUE(isMiss(projectProxyInfinite(vec3(0), vec3(kInfinity, 0, 0)), kHitReasonDegenerateRay));
}

RC_GTEST_PROP(ShaderProxy, AnswersAnything, ())
{
    const vec3 origin = drawHostileVector<vec3>();
    const vec3 dir = drawHostileVector<vec3>();
    const vec3 center = *rc::gen::inRange(0, 2) == 0 ? drawHostileVector<vec3>() : drawPoint<vec3>(3);
    for (const ProxyHit& hit :
         {projectProxyBox(origin, dir, center, kUpright, drawHostileVector<vec3>()),
          projectProxySphere(origin, dir, center, drawHostile()), projectProxyInfinite(origin, dir)}) {
        RC_ASSERT(isFinite(hit.positionWS));
        RC_ASSERT(isFinite(hit.distance) && hit.distance >= 0);
        RC_ASSERT(hit.hit == (hit.reason == kHitReasonNone));
    }
}
