#include "tests/shader/generators.h"

#include "harness/backend/cpu/glsl.h"

#include "crossray/probe/box_projection.glsl"
#include "crossray/probe/cubemap.glsl"
#include "crossray/probe/rgbm.glsl"
#include "crossray/probe/sky.glsl"
#include "crossray/probe/two_probes.glsl"

#include "harness/backend/cpu/glsl_end.h"

using namespace CROSSRAY_SHADER_NAMESPACE;

namespace {

// The form that circulates as "optimized": it chooses the face behind the ray. Kept to show that the tests see it.
vec3 projectWithSwappedSelect(vec3 position, vec3 dir, const ProbeBox& box)
{
    const vec3 face = mix(box.maxWS, box.minWS, step(vec3(0), dir));
    const vec3 distances = (face - position) / dir;
    return normalize(position + dir * minComponent(distances) - box.capturePositionWS.xyz);
}

// The point where a ray from inside leaves the box, by six planes: the smallest crossing ahead.
vec3 leaveBox(vec3 position, vec3 dir, const ProbeBox& box)
{
    Real nearest = Real(1e30);
    for (int axis = 0; axis < 3; ++axis) {
        for (Real plane : {box.minWS[axis], box.maxWS[axis]}) {
            const Real t = (plane - position[axis]) / dir[axis];
            if (t > 0) nearest = std::min(nearest, t);
        }
    }
    return position + dir * nearest;
}

struct Room {
    ProbeBox box;
    vec3 position;
};

Room drawRoom()
{
    const vec3 center = drawPoint<vec3>(3);
    const vec3 e(drawReal(1, 4), drawReal(1, 4), drawReal(1, 4));
    const vec3 capture = center + drawPoint<vec3>(Real(0.5)) * e;
    return {{center - e, center + e, vec4(capture, 1)}, center + drawPoint<vec3>(Real(0.95)) * e};
}

Real angleDegrees(vec3 a, vec3 b)
{
    return std::atan2(length(cross(a, b)), dot(a, b)) * Real(57.29577951308232);
}

const ProbeBox kRoom{vec3(-2, -1, -2), vec3(2, 1, 2), vec4(0, 0, 0, 1)};

BoxProjection project(int form, vec3 position, vec3 dir, const ProbeBox& box)
{
    return form == 0 ? computeBoxProjectionDivision(position, dir, box)
                     : computeBoxProjectionSelect(position, dir, box);
}

} // namespace

RC_GTEST_PROP(ShaderBoxProjection, BothFormsSeeWhereTheRayLeavesTheBox, ())
{
    const Room room = drawRoom();
    const vec3 dir = drawUnitVector<vec3>();
    const vec3 expected = normalize(leaveBox(room.position, dir, room.box) - room.box.capturePositionWS.xyz);
    for (int form : {0, 1}) {
        const BoxProjection projected = project(form, room.position, dir * 4.0, room.box);
        RC_ASSERT(projected.applied);
        RC_ASSERT(length(projected.dirWS - expected) < 2000 * kUlps);
    }
}

// The published selection is the wrong way round: for most rays it is not a little off but behind. The mended form, in
// the same test, is exact.
TEST(ShaderBoxProjection, TheSwappedSelectionLooksBehindTheRay)
{
    // A ray to the right in a room: the swapped form answers with the wall on the left.
    const vec3 along = normalize(vec3(1, Real(0.01), Real(0.01)));
    EXPECT_LT(projectWithSwappedSelect(vec3(0), along, kRoom).x, 0);
    EXPECT_GT(computeBoxProjectionSelect(vec3(0), along, kRoom).dirWS.x, 0);
    Real swapped = 0;
    Real mended = 0;
    int count = 0;
    for (int i = 0; i < 400; ++i) { // a spiral over the sphere
        const Real z = 1 - (2 * Real(i) + 1) / 400;
        const Real turn = Real(2.399963) * Real(i) + Real(0.1); // no component is exactly 0
        const vec3 dir(std::sqrt(1 - z * z) * std::cos(turn), std::sqrt(1 - z * z) * std::sin(turn), z);
        const vec3 position(Real(0.5), Real(-0.25), Real(1));
        const vec3 expected = normalize(leaveBox(position, dir, kRoom));
        swapped += angleDegrees(projectWithSwappedSelect(position, dir, kRoom), expected);
        mended += angleDegrees(computeBoxProjectionSelect(position, dir, kRoom).dirWS, expected);
        ++count;
    }
    EXPECT_GT(swapped / Real(count), 90); // degrees, mean
    EXPECT_LT(mended / Real(count), 1e-4);
}

TEST(ShaderBoxProjection, ZeroComponentsMeetNoFace)
{
    for (int form : {0, 1}) {
        for (Real zero : {Real(0.0), Real(-0.0)}) {
            const BoxProjection up = project(form, vec3(1, 0, 0), vec3(zero, 2, zero), kRoom);
            EXPECT_TRUE(up.applied);
            EXPECT_EQ(up.distance, 1);
            EXPECT_NEAR(up.dirWS.x, std::sqrt(Real(0.5)), kUlps);
            EXPECT_NEAR(up.dirWS.y, std::sqrt(Real(0.5)), kUlps);
            // Along a face, and along an edge.
            EXPECT_EQ(project(form, vec3(2, 0, 0), vec3(zero, 1, zero), kRoom).distance, 1);
            EXPECT_EQ(project(form, vec3(2, -1, 0), vec3(zero, zero, 1), kRoom).distance, 2);
        }
        // On a face, pointing out: the point itself.
        const BoxProjection out = project(form, vec3(2, Real(0.5), 0), vec3(1, 0, 0), kRoom);
        EXPECT_TRUE(out.applied);
        EXPECT_EQ(out.distance, 0);
        EXPECT_NEAR(angleDegrees(out.dirWS, vec3(2, Real(0.5), 0)), 0, 1e-3);
    }
}

TEST(ShaderBoxProjection, OutsideTheFarFaceOrNothing)
{
    for (int form : {0, 1}) {
        const BoxProjection through = project(form, vec3(5, 0, 0), vec3(-1, 0, 0), kRoom);
        EXPECT_TRUE(through.applied);
        EXPECT_EQ(through.distance, 7);
        for (vec3 dir : {vec3(1, 0, 0), vec3(0, 1, 0), vec3(-1, -1, 0)}) {
            const BoxProjection past = project(form, vec3(5, 0, 0), dir, kRoom);
            EXPECT_FALSE(past.applied);
            EXPECT_NEAR(angleDegrees(past.dirWS, dir), 0, 1e-3);
        }
    }
}

TEST(ShaderBoxProjection, AppliesOnlyWhereTheProbeEnablesIt)
{
    const vec3 dir(1, 0, 0);
    for (int form : {0, 1}) {
        for (Real w : {Real(0), Real(-1), kNaN}) {
            const ProbeBox off{kRoom.minWS, kRoom.maxWS, vec4(0, Real(0.5), 0, w)};
            const BoxProjection projected = project(form, vec3(1, 0, 0), dir, off);
            EXPECT_FALSE(projected.applied);
            EXPECT_EQ(projected.dirWS, dir);
        }
        // Boxes that are none.
        for (vec3 top : {vec3(-3, 1, 2), vec3(kNaN, 1, 2), vec3(kInfinity, 1, 2)})
            EXPECT_FALSE(project(form, vec3(0), dir, {kRoom.minWS, top, vec4(0, 0, 0, 1)}).applied);
        EXPECT_FALSE(project(form, vec3(0), vec3(0), kRoom).applied);
        EXPECT_EQ(project(form, vec3(0), vec3(kNaN), kRoom).dirWS, vec3(0));
        // The answered point is the capture position.
        const ProbeBox onFace{kRoom.minWS, kRoom.maxWS, vec4(2, 0, 0, 1)};
        EXPECT_EQ(project(form, vec3(1, 0, 0), dir, onFace).dirWS, dir);
    }
}

RC_GTEST_PROP(ShaderBoxProjection, AnswersAnything, ())
{
    const ProbeBox box{drawHostileVector<vec3>(), drawHostileVector<vec3>(),
                       vec4(drawHostileVector<vec3>(), drawHostile())};
    const vec3 dir = drawHostileVector<vec3>();
    const vec3 position = drawHostileVector<vec3>();
    for (int form : {0, 1}) {
        const BoxProjection projected = project(form, position, dir, box);
        RC_ASSERT(isFinite(projected.dirWS) && isFinite(projected.distance) && projected.distance >= 0);
        RC_ASSERT(std::fabs(length(projected.dirWS) - (hasDirection(dir) ? 1 : 0)) < kUlps);
    }
}

TEST(ShaderRgbm, DecodesByItsConstants)
{
    // Range 5, exponent 2: alpha 0.5 is a factor 5/4 in linear, 5/2 in gamma.
    const vec4 texel(Real(0.2), Real(0.4), Real(0.8), Real(0.5));
    const vec3 linear = decodeRgbmLinear(texel, vec4(5, 2, 0, 1));
    const vec3 gamma = decodeRgbmGamma(texel, vec4(5, 2, 0, 1));
    EXPECT_NEAR(linear.x, Real(0.25), 4 * kUlps);
    EXPECT_NEAR(linear.z, 1, 4 * kUlps);
    EXPECT_NEAR(gamma.y, 1, 4 * kUlps);
    // w = 0: alpha does not count; w = 0.5: half of it.
    EXPECT_NEAR(decodeRgbmGamma(texel, vec4(5, 2, 0, 0)).y, 2, 4 * kUlps);
    EXPECT_NEAR(decodeRgbmGamma(texel, vec4(5, 2, 0, Real(0.5))).y, Real(1.5), 4 * kUlps);
}

TEST(ShaderRgbm, AlphaOfZeroAndBelowIsBlack)
{
    for (Real alpha : {Real(0), Real(-0.0), Real(-0.5), -kInfinity, kNaN}) {
        EXPECT_EQ(decodeRgbmLinear(vec4(1, 1, 1, alpha), vec4(5, Real(2.2), 0, 1)), vec3(0));
        EXPECT_EQ(decodeRgbmGamma(vec4(1, 1, 1, alpha), vec4(5, Real(2.2), 0, 1)), vec3(0));
    }
    // An exponent of 0 switches alpha off, at 0 too.
    EXPECT_EQ(decodeRgbmLinear(vec4(1, 1, 1, 0), vec4(5, 0, 0, 1)), vec3(5));
}

// Each probe has its own constants: with the first's the second comes out wrong by their ratio.
TEST(ShaderTwoProbes, EachDecodedWithItsOwnConstants)
{
    const vec4 first(5, 1, 0, 1);
    const vec4 second(34, 1, 0, 1);
    const vec4 texel(1, 1, 1, Real(0.5));
    const vec3 mixed = blendTwoProbes(decodeRgbmLinear(texel, first), decodeRgbmLinear(texel, second), Real(0.25));
    EXPECT_NEAR(mixed.x, Real(0.25 * 2.5 + 0.75 * 17), 100 * kUlps);
}

// Claim 15: the second probe is sampled only below a weight of 0.99999.
TEST(ShaderTwoProbes, SharesSumToOne)
{
    EXPECT_EQ(computeTwoProbeWeights(Real(0.25)).first, Real(0.25));
    EXPECT_EQ(computeTwoProbeWeights(Real(0.25)).second, Real(0.75));
    EXPECT_GT(computeTwoProbeWeights(Real(0.99998)).second, 0);
    for (Real whole : {Real(0.99999), Real(1), Real(2), kNaN}) {
        EXPECT_EQ(computeTwoProbeWeights(whole).first, 1);
        EXPECT_EQ(computeTwoProbeWeights(whole).second, 0);
    }
    EXPECT_EQ(computeTwoProbeWeights(Real(-1)).second, 1);
}

TEST(ShaderTwoProbes, TheSecondOnlyBelowTheCut)
{
    EXPECT_TRUE(needsSecondProbe(Real(0.99998)));
    EXPECT_FALSE(needsSecondProbe(Real(0.99999)));
    EXPECT_FALSE(needsSecondProbe(1));
    EXPECT_FALSE(needsSecondProbe(kNaN));
    EXPECT_TRUE(needsSecondProbe(0));
    const vec3 a(1, 2, 3);
    const vec3 b(5, 6, 7);
    EXPECT_EQ(blendTwoProbes(a, vec3(kNaN), Real(0.99999)), a);
    EXPECT_EQ(blendTwoProbes(vec3(kNaN), b, 0), b);
    EXPECT_EQ(blendTwoProbes(vec3(kNaN), b, -2), b);
    EXPECT_EQ(blendTwoProbes(a, b, 7), a);
    EXPECT_NEAR(blendTwoProbes(a, b, Real(0.75)).x, 2, kUlps);
}

RC_GTEST_PROP(ShaderRgbm, AnswersAnything, ())
{
    const vec4 texel(drawHostileVector<vec3>(), drawHostile());
    const vec4 decode(drawHostileVector<vec3>(), drawHostile());
    for (vec3 color : {decodeRgbmLinear(texel, decode), decodeRgbmGamma(texel, decode)})
        RC_ASSERT(minComponent(color) >= 0 && maxComponent(color) <= Real(65504));
}

TEST(ShaderSky, GradientByElevation)
{
    const GradientSky sky{vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1), vec3(0, 2, 0), 1};
    EXPECT_EQ(evaluateGradientSky(sky, vec3(0, 5, 0)), vec3(1, 0, 0));
    EXPECT_EQ(evaluateGradientSky(sky, vec3(0, -5, 0)), vec3(0, 0, 1));
    EXPECT_EQ(evaluateGradientSky(sky, vec3(3, 0, 4)), vec3(0, 1, 0));
    // 30 degrees up: half way. 30 degrees down as well.
    EXPECT_NEAR(evaluateGradientSky(sky, vec3(std::sqrt(Real(3)), 1, 0)).x, Real(0.5), 4 * kUlps);
    EXPECT_NEAR(evaluateGradientSky(sky, vec3(std::sqrt(Real(3)), -1, 0)).z, Real(0.5), 4 * kUlps);
    GradientSky sharp = sky;
    sharp.sharpness = 2;
    EXPECT_NEAR(evaluateGradientSky(sharp, vec3(std::sqrt(Real(3)), 1, 0)).x, 1, 4 * kUlps);
    for (Real odd : {Real(0), Real(-1), kNaN}) {
        sharp.sharpness = odd;
        EXPECT_EQ(evaluateGradientSky(sharp, vec3(0, 1, 0)), vec3(0, 1, 0));
    }
    EXPECT_EQ(evaluateGradientSky(sky, vec3(kNaN)), vec3(0, 1, 0));
}

RC_GTEST_PROP(ShaderCubemap, ThereAndBack, ())
{
    const vec3 dir = drawUnitVector<vec3>();
    const CubePosition at = cubePositionFromDirection(dir * Real(1e20));
    RC_ASSERT(at.valid);
    RC_ASSERT(length(directionFromCubePosition(at.face, at.uv) - dir) < 4 * kUlps);
    // The face's axis carries the largest component, with its sign.
    const Real major = dir[at.face / 2] * (at.face % 2 == 0 ? 1 : -1);
    RC_ASSERT(major > 0 && major >= maxComponent(abs(dir)) - kUlps);
}

// The specifications' table, row by row: what lies right and down of each face's middle.
TEST(ShaderCubemap, FollowsTheTable)
{
    const vec3 middle[6] = {vec3(1, 0, 0),  vec3(-1, 0, 0), vec3(0, 1, 0),
                            vec3(0, -1, 0), vec3(0, 0, 1),  vec3(0, 0, -1)};
    const vec3 right[6] = {vec3(0, 0, -1), vec3(0, 0, 1), vec3(1, 0, 0), vec3(1, 0, 0), vec3(1, 0, 0), vec3(-1, 0, 0)};
    const vec3 down[6] = {vec3(0, -1, 0), vec3(0, -1, 0), vec3(0, 0, 1),
                          vec3(0, 0, -1), vec3(0, -1, 0), vec3(0, -1, 0)};
    for (int face = 0; face < 6; ++face) {
        const CubePosition at =
            cubePositionFromDirection(middle[face] + right[face] * Real(0.5) - down[face] * Real(0.25));
        EXPECT_EQ(at.face, face);
        EXPECT_NEAR(at.uv.x, Real(0.75), 2 * kUlps);
        EXPECT_NEAR(at.uv.y, Real(0.375), 2 * kUlps);
    }
}

TEST(ShaderCubemap, OnEdgesAndCornersZWinsThenY)
{
    EXPECT_EQ(cubePositionFromDirection(vec3(1, 1, 1)).face, 4);
    EXPECT_EQ(cubePositionFromDirection(vec3(-1, -1, -1)).face, 5);
    EXPECT_EQ(cubePositionFromDirection(vec3(1, -1, 0)).face, 3);
    EXPECT_EQ(cubePositionFromDirection(vec3(1, 0, -1)).face, 5);
    EXPECT_EQ(cubePositionFromDirection(vec3(0, 1, 1)).face, 4);
    const CubePosition corner = cubePositionFromDirection(vec3(1, 1, 1));
    EXPECT_NEAR(corner.uv.x, 1, kUlps);
    EXPECT_NEAR(corner.uv.y, 0, kUlps);
    for (vec3 none : {vec3(0), vec3(kNaN, 1, 1), vec3(kInfinity, 0, 0)}) {
        const CubePosition at = cubePositionFromDirection(none);
        EXPECT_FALSE(at.valid);
        EXPECT_EQ(at.face, 0);
        EXPECT_EQ(at.uv, vec2(Real(0.5)));
    }
}

// Texels beside each other across an edge: a centre half a texel out folds onto a centre half a texel in, whose
// direction is the mirror image about the edge's plane; and both are the same distance from the edge.
TEST(ShaderCubemap, FoldsOverEdgesFromTexelToTexel)
{
    constexpr int kSize = 4;
    const Real half = Real(0.5) / kSize;
    for (int face = 0; face < 6; ++face) {
        for (int i = 0; i < kSize; ++i) {
            const Real along = (Real(i) + Real(0.5)) / kSize;
            const std::pair<vec2, vec2> edges[4] = {{vec2(-half, along), vec2(half, along)},
                                                    {vec2(1 + half, along), vec2(1 - half, along)},
                                                    {vec2(along, -half), vec2(along, half)},
                                                    {vec2(along, 1 + half), vec2(along, 1 - half)}};
            for (auto [outside, inside] : edges) {
                const CubePosition at = foldCubePosition(face, outside);
                EXPECT_TRUE(at.valid);
                EXPECT_NE(at.face, face);
                EXPECT_NE(at.face / 2, face / 2); // a neighbour, not the opposite
                // On a texel's centre.
                for (Real c : {at.uv.x * kSize, at.uv.y * kSize})
                    EXPECT_NEAR(c - std::floor(c), Real(0.5), 20 * kUlps);
                // Swapping the two faces' axes in the inner neighbour's direction gives the outer one's.
                vec3 mirrored = directionFromCubePosition(face, inside);
                const int a = face / 2;
                const int b = at.face / 2;
                const Real sign = (face % 2 == at.face % 2) ? Real(1) : Real(-1);
                const Real swap = mirrored[a] * sign;
                mirrored[a] = mirrored[b] * sign;
                mirrored[b] = swap;
                EXPECT_LT(length(directionFromCubePosition(at.face, at.uv) - mirrored), 8 * kUlps);
            }
        }
    }
}

TEST(ShaderCubemap, FoldingAnswersAnything)
{
    EXPECT_EQ(foldCubePosition(2, vec2(Real(0.25), Real(0.75))).face, 2);
    EXPECT_EQ(foldCubePosition(2, vec2(Real(0.25), Real(0.75))).uv, vec2(Real(0.25), Real(0.75)));
    for (int face = -1; face < 8; ++face) {
        for (Real u : {Real(-0.1), Real(1.1), Real(90), Real(-1e30), kNaN, kInfinity}) {
            for (Real v : {Real(-0.1), Real(1.2), Real(0), kNaN}) {
                const CubePosition at = foldCubePosition(face, vec2(u, v));
                EXPECT_TRUE(at.face >= 0 && at.face < 6);
                EXPECT_TRUE(at.uv.x >= 0 && at.uv.x <= 1 && at.uv.y >= 0 && at.uv.y <= 1);
                EXPECT_EQ(at.valid, isFinite(vec2(u, v)));
            }
        }
    }
}
