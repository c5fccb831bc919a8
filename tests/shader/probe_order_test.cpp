#include "tests/shader/generators.h"

#include <algorithm>
#include <numeric>

#include "harness/backend/cpu/glsl.h"

#include "crossray/probe/hdrp_order.glsl"
#include "crossray/probe/urp.glsl"

#include "harness/backend/cpu/glsl_end.h"

using namespace CROSSRAY_SHADER_NAMESPACE;

namespace {

const int kProfiles[] = {kUrpDoc, kUrpUnity, kUrpUnityHalf};

// A box around the origin with those sides.
UrpProbe makeProbe(vec3 side, Real importance = 1, Real blend = 0, int index = 0, Real area = 0)
{
    return {side * Real(-0.5), side * Real(0.5), blend, importance, area, index};
}

Real sum(const UrpWeights& w)
{
    return w.first + w.second + w.sky;
}

} // namespace

// Claim 16: nothing on a face, all deeper than the blend distance from every face.
TEST(ShaderUrp, WeightByDepthBelowTheFaces)
{
    const UrpProbe probe = makeProbe(vec3(4, 6, 8), 1, Real(0.5));
    EXPECT_EQ(computeUrpWeight(probe, vec3(2, 0, 0)), 0);
    EXPECT_EQ(computeUrpWeight(probe, vec3(0, -3, 0)), 0);
    EXPECT_EQ(computeUrpWeight(probe, vec3(0, 0, 5)), 0);
    EXPECT_EQ(computeUrpWeight(probe, vec3(Real(1.5), Real(-2.5), Real(3.5))), 1);
    EXPECT_EQ(computeUrpWeight(probe, vec3(Real(1.75), 0, 0)), Real(0.5));
    EXPECT_EQ(computeUrpWeight(probe, vec3(Real(1.75), Real(-2.875), 0)), Real(0.25)); // the nearer face
    // Beyond half the extent: never all. 2 m to the nearest face over 4.
    EXPECT_EQ(computeUrpWeight(makeProbe(vec3(4, 6, 8), 1, 4), vec3(0)), Real(0.5));
}

TEST(ShaderUrp, ABlendDistanceOfZeroIsAStep)
{
    for (Real blend : {Real(0), Real(-1), kNaN}) {
        const UrpProbe probe = makeProbe(vec3(2), 1, blend);
        EXPECT_EQ(computeUrpWeight(probe, vec3(1, 0, 0)), 0); // where the code divides 0 by 0
        EXPECT_EQ(computeUrpWeight(probe, vec3(Real(0.999), 0, 0)), 1);
        EXPECT_EQ(computeUrpWeight(probe, vec3(Real(1.001), 0, 0)), 0);
    }
    EXPECT_EQ(computeUrpWeight(makeProbe(vec3(-2), 1, 1), vec3(0)), 0);
    EXPECT_EQ(computeUrpWeight(makeProbe(vec3(2), 1, 1), vec3(0, kNaN, 0)), 0);
}

// The document's volume and the code's squared diagonal disagree about a long box and a cube: 10 against 125 cubic
// metres, 102 against 75 square metres.
TEST(ShaderUrp, ALongBoxAgainstACube)
{
    const UrpProbe rod = makeProbe(vec3(10, 1, 1), 1, 0, 1);
    const UrpProbe cube = makeProbe(vec3(5), 1, 0, 0);
    EXPECT_NEAR(computeUrpSize(rod, kUrpDoc), 10, 10 * kUlps);
    EXPECT_NEAR(computeUrpSize(cube, kUrpDoc), 125, 125 * kUlps);
    EXPECT_NEAR(computeUrpSize(rod, kUrpUnity), 102, 102 * kUlps);
    EXPECT_NEAR(computeUrpSize(cube, kUrpUnity), 75, 75 * kUlps);
    EXPECT_TRUE(urpProbeComesFirst(rod, cube, kUrpDoc));
    EXPECT_FALSE(urpProbeComesFirst(rod, cube, kUrpUnity));
    EXPECT_TRUE(urpProbeComesFirst(cube, rod, kUrpUnity));
}

TEST(ShaderUrp, HalfPrecisionLosesDiagonalsBeyond256Metres)
{
    const UrpProbe larger = makeProbe(vec3(173, 173, 173), 1, 0, 0); // a diagonal of 300 m
    const UrpProbe smaller = makeProbe(vec3(150, 150, 150), 1, 0, 1);
    const UrpProbe small = makeProbe(vec3(147, 147, 147), 1, 0, 2); // 254.6 m
    EXPECT_TRUE(urpProbeComesFirst(smaller, larger, kUrpUnity));
    EXPECT_FALSE(urpProbeComesFirst(smaller, larger, kUrpUnityHalf)); // equal now: the index decides
    EXPECT_TRUE(urpProbeComesFirst(small, larger, kUrpUnityHalf));
    EXPECT_EQ(computeUrpDominance(larger, smaller, kUrpUnity), -1);
    EXPECT_EQ(computeUrpDominance(larger, smaller, kUrpUnityHalf), 0);
    EXPECT_EQ(computeUrpDominance(larger, small, kUrpUnityHalf), -1);
}

// Claim 17, order: the more important, then the smaller, then the one that covers more of the surface.
TEST(ShaderUrp, OrderByImportanceThenSizeThenArea)
{
    const UrpProbe important = makeProbe(vec3(9), 2, 0, 5);
    const UrpProbe small = makeProbe(vec3(1), 1, 0, 4);
    const UrpProbe covers = makeProbe(vec3(3), 1, 0, 3, 8);
    const UrpProbe grazes = makeProbe(vec3(3), 1, 0, 2, 1);
    for (int profile : kProfiles) {
        EXPECT_TRUE(urpProbeComesFirst(important, small, profile));
        EXPECT_TRUE(urpProbeComesFirst(small, covers, profile));
        EXPECT_FALSE(urpProbeComesFirst(small, small, profile));
    }
    EXPECT_TRUE(urpProbeComesFirst(covers, grazes, kUrpDoc));
    EXPECT_TRUE(urpProbeComesFirst(grazes, covers, kUrpUnity)); // the code asks nothing about area: the index
}

// Offered in any order, the pair is that of a full sort; never more than two.
RC_GTEST_PROP(ShaderUrp, ThePairIsTheHeadOfTheSortedList, ())
{
    const int profile = kProfiles[*rc::gen::inRange(0, 3)];
    const int count = *rc::gen::inRange(0, 9);
    std::vector<UrpProbe> probes;
    for (int i = 0; i < count; ++i) {
        const vec3 side(Real(*rc::gen::inRange(1, 4)), Real(*rc::gen::inRange(1, 4)), Real(*rc::gen::inRange(1, 4)));
        probes.push_back(makeProbe(side, Real(*rc::gen::inRange(0, 3)), 1, i, Real(*rc::gen::inRange(0, 3))));
    }
    UrpPair pair = makeUrpPair();
    for (int i = count - 1; i >= 0; --i)
        pair = offerUrpProbe(pair, probes[static_cast<size_t>(i)], i, profile);
    std::sort(probes.begin(), probes.end(), [profile](const UrpProbe& a, const UrpProbe& b) {
        const auto size = [profile](const UrpProbe& p) {
            const vec3 s = p.boxMaxWS - p.boxMinWS;
            return profile == kUrpDoc ? s.x * s.y * s.z : s.x * s.x + s.y * s.y + s.z * s.z;
        };
        const auto key = [&](const UrpProbe& p) {
            return std::make_tuple(-p.importance, size(p), profile == kUrpDoc ? -p.coveredArea : Real(0), p.index);
        };
        return key(a) < key(b);
    });
    RC_ASSERT(pair.first == (count > 0 ? probes[0].index : kUrpNoProbe));
    RC_ASSERT(pair.second == (count > 1 ? probes[1].index : kUrpNoProbe));
}

// Claim 17, shares: both full, equal importance blends equally, else the more important alone.
TEST(ShaderUrp, BothFull)
{
    const vec3 p(0);
    for (int profile : kProfiles) {
        UrpPair equal = offerUrpProbe(makeUrpPair(), makeProbe(vec3(4), 1, 1, 0), 0, profile);
        equal = offerUrpProbe(equal, makeProbe(vec3(4), 1, 1, 1), 1, profile);
        UrpWeights shares = computeUrpPairShares(equal, p, profile);
        EXPECT_EQ(shares.first, Real(0.5));
        EXPECT_EQ(shares.second, Real(0.5));
        EXPECT_EQ(shares.sky, 0);
        UrpPair ranked = offerUrpProbe(makeUrpPair(), makeProbe(vec3(4), 1, 1, 0), 0, profile);
        ranked = offerUrpProbe(ranked, makeProbe(vec3(4), 2, 1, 1), 1, profile);
        EXPECT_EQ(ranked.first, 1);
        shares = computeUrpPairShares(ranked, p, profile);
        EXPECT_EQ(shares.first, 1);
        EXPECT_EQ(shares.second, 0);
    }
    // Equal importance, sizes apart: equally by the manual, the smaller alone by the code.
    const UrpProbe small = makeProbe(vec3(4), 1, 1, 0);
    const UrpProbe large = makeProbe(vec3(8), 1, 1, 1);
    EXPECT_EQ(computeUrpDominance(small, large, kUrpDoc), 0);
    EXPECT_EQ(computeUrpDominance(small, large, kUrpUnity), 1);
    EXPECT_EQ(computeUrpDominance(large, small, kUrpUnity), -1);
}

TEST(ShaderUrp, PartialWeightsLeaveTheRestToTheSky)
{
    UrpWeights w = computeUrpShares(Real(0.75), Real(0.5), 1, kUrpDoc);
    EXPECT_EQ(w.first, Real(0.75));
    EXPECT_EQ(w.second, Real(0.25));
    w = computeUrpShares(Real(0.75), Real(0.5), -1, kUrpDoc);
    EXPECT_EQ(w.first, Real(0.5));
    EXPECT_EQ(w.second, Real(0.5));
    w = computeUrpShares(Real(0.75), Real(0.5), 0, kUrpDoc);
    EXPECT_NEAR(w.first, Real(0.6), kUlps);
    EXPECT_NEAR(w.second, Real(0.4), kUlps);
    w = computeUrpShares(Real(0.25), Real(0.5), 0, kUrpDoc);
    EXPECT_EQ(w.sky, Real(0.25));
    EXPECT_EQ(computeUrpPairShares(makeUrpPair(), vec3(0), kUrpDoc).sky, 1);
    // Between 0.99 and 1 the code loses the rest.
    EXPECT_NEAR(computeUrpShares(Real(0.992), 0, 0, kUrpDoc).sky, Real(0.008), 4 * kUlps);
    EXPECT_EQ(computeUrpShares(Real(0.992), 0, 0, kUrpUnity).sky, 0);
    EXPECT_NEAR(computeUrpShares(Real(0.98), 0, 0, kUrpUnity).sky, Real(0.02), 4 * kUlps);
}

RC_GTEST_PROP(ShaderUrp, SharesSumToOne, ())
{
    const Real a = *rc::gen::inRange(0, 2) == 0 ? drawHostile() : drawReal(0, 1);
    const Real b = drawReal(0, 1);
    const int dominance = *rc::gen::inRange(-1, 2);
    const UrpWeights doc = computeUrpShares(a, b, dominance, kUrpDoc);
    RC_ASSERT(std::fabs(sum(doc) - 1) <= std::numeric_limits<Real>::epsilon());
    RC_ASSERT(doc.first >= 0 && doc.second >= 0 && doc.sky >= 0);
    const UrpWeights unity = computeUrpShares(a, b, dominance, kUrpUnity);
    RC_ASSERT(sum(unity) >= Real(0.99) - kUlps && sum(unity) <= 1 + kUlps);
    RC_ASSERT(unity.first == doc.first && unity.second == doc.second);
}

// Forward+ asks as many as it takes: three here, the fourth not.
TEST(ShaderUrp, ForwardPlusStopsAtTheSumOf099)
{
    Real total = 0;
    const std::vector<Real> asked{Real(0.5), Real(0.25), Real(0.245), Real(0.5)};
    const std::vector<Real> given{Real(0.5), Real(0.25), Real(0.245), 0};
    for (size_t i = 0; i < asked.size(); ++i) {
        const UrpStep step = stepUrpForwardPlus(total, asked[i]);
        EXPECT_NEAR(step.weight, given[i], kUlps);
        EXPECT_EQ(step.done, i >= 2);
        total = step.total;
    }
    EXPECT_NEAR(total, Real(0.995), 2 * kUlps);
    EXPECT_EQ(computeUrpSkyWeight(total, kUrpUnity), 0);
    // Not more than is left, and at most 1.
    EXPECT_NEAR(stepUrpForwardPlus(Real(0.75), 1).weight, Real(0.25), kUlps);
    EXPECT_EQ(stepUrpForwardPlus(Real(0.75), 1).total, 1);
    EXPECT_EQ(stepUrpForwardPlus(kNaN, kNaN).total, 0);
    EXPECT_TRUE(stepUrpForwardPlus(kInfinity, 1).done);
}

RC_GTEST_PROP(ShaderUrp, AnswersAnything, ())
{
    const UrpProbe a{
        drawHostileVector<vec3>(), drawHostileVector<vec3>(), drawHostile(), drawHostile(), drawHostile(), 0};
    const UrpProbe b{
        drawHostileVector<vec3>(), drawHostileVector<vec3>(), drawHostile(), drawHostile(), drawHostile(), 1};
    const vec3 p = drawHostileVector<vec3>();
    for (int profile : kProfiles) {
        const Real weight = computeUrpWeight(a, p);
        RC_ASSERT(weight >= 0 && weight <= 1);
        RC_ASSERT(isFinite(computeUrpSize(a, profile)) && computeUrpSize(a, profile) >= 0);
        RC_ASSERT(urpProbeComesFirst(a, b, profile) != urpProbeComesFirst(b, a, profile)); // always decided
        const UrpPair pair = offerUrpProbe(offerUrpProbe(makeUrpPair(), a, 0, profile), b, 1, profile);
        const UrpWeights w = computeUrpPairShares(pair, p, profile);
        RC_ASSERT(w.first >= 0 && w.second >= 0 && w.sky >= 0 && sum(w) <= 1 + kUlps);
    }
}

TEST(ShaderHdrpOrder, SmallerFirstThenIndex)
{
    // 1000 log(1 + 1) / log 1.05 = 14206.7; half extents 0.5 are a cubic metre.
    EXPECT_EQ(computeHdrpProbeKey(vec3(Real(0.5))), 14206);
    EXPECT_EQ(computeHdrpProbeKey(vec3(0)), 0);
    EXPECT_EQ(computeHdrpProbeKey(vec3(1, -1, 1)), 0);
    // By volume, not by diagonal: the rod before the cube.
    EXPECT_LT(computeHdrpProbeKey(vec3(5, Real(0.5), Real(0.5))), computeHdrpProbeKey(vec3(Real(2.5))));
    // Closer than a key's step: equal, and the index decides.
    const int a = computeHdrpProbeKey(vec3(Real(0.5)));
    EXPECT_EQ(a, computeHdrpProbeKey(vec3(Real(0.5), Real(0.5), Real(0.500002))));
    EXPECT_TRUE(hdrpProbeComesFirst(a, 0, a, 1));
    EXPECT_FALSE(hdrpProbeComesFirst(a, 1, a, 0));
    EXPECT_TRUE(hdrpProbeComesFirst(a - 1, 9, a, 1));
    EXPECT_FALSE(hdrpProbeComesFirst(a, 1, a - 1, 9));
    for (vec3 odd : {vec3(kNaN, 1, 1), vec3(1, kInfinity, 1), vec3(Real(1e12))})
        EXPECT_GE(computeHdrpProbeKey(odd), computeHdrpProbeKey(vec3(Real(1e4))));
    EXPECT_EQ(computeHdrpProbeKey(vec3(kNaN, 1, 1)), 1048575);
    EXPECT_EQ(computeHdrpProbeKey(vec3(kInfinity)), 1048575);
}

RC_GTEST_PROP(ShaderHdrpOrder, GrowsWithTheVolume, ())
{
    const vec3 e(drawReal(Real(0.1), 50), drawReal(Real(0.1), 50), drawReal(Real(0.1), 50));
    const int key = computeHdrpProbeKey(e);
    RC_ASSERT(computeHdrpProbeKey(e * Real(1.01)) > key);
    // Back from the key: 1.05^(key/1000) is 1 + V to a step.
    const double volume = 8.0 * static_cast<double>(e.x) * static_cast<double>(e.y) * static_cast<double>(e.z);
    RC_ASSERT(std::fabs(std::pow(double{21} / 20, double(key) / 1000) / (1 + volume) - 1) < 1e-4);
}
