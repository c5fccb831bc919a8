#include "tests/shader/generators.h"
#include "tests/shader/scene.h"

#include "harness/backend/cpu/glsl.h"

#define CROSSRAY_REDUCE_DEPTH_PYRAMID
#include "crossray/project/hiz.glsl"
#include "crossray/project/linear.glsl"
#include "tests/shader/views.h"
#include "tests/shader/hiz_fixture.h"

static std::vector<LinearStep> gLinearSteps;

float fetchLinearDepth(ivec2 pixel)
{
    return fetchDepthPyramid(pixel, 0).x;
}
void recordLinearStep(LinearStep step)
{
    gLinearSteps.push_back(step);
}

#include "harness/backend/cpu/glsl_end.h"

using namespace CROSSRAY_SHADER_NAMESPACE;
using shaderTest::box;
using shaderTest::plane;
using shaderTest::sphere;

#include "tests/shader/room.h"

namespace {

LinearSettings byStride(Real stride, Real bias = Real(0.2), int bisections = 0)
{
    return LinearSettings(stride, 0, 4096, bias, bisections);
}

View straightView(int width, int height)
{
    return makeView(vec2(ivec2(width, height)), kHalfFov, Real(0.1), 100, 1);
}

struct Census {
    int answerable = 0, found = 0, hits = 0, right = 0, unanswerable = 0, falseHits = 0;
    double iterations = 0;
    double recall() const { return static_cast<double>(found) / answerable; }
    double precision() const { return static_cast<double>(right) / hits; }
    double falseShare() const { return static_cast<double>(falseHits) / unanswerable; }
};
Census traceAll(const View& view, const Shapes& scene, const LinearSettings& settings, Real tolerancePixels)
{
    const auto image = renderScene(view, scene);
    const int width = static_cast<int>(view.imageSize.x), height = static_cast<int>(view.imageSize.y);
    Census census;
    int rays = 0;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const auto& seen = image[static_cast<size_t>(y * width + x)];
            if (!seen) continue;
            const MirrorRay ray = makeMirrorRay(view, scene, *seen, x, y);
            const LinearResult r = traceLinear(view, ray.origin, ray.dir, settings);
            ++rays;
            census.iterations += r.iterations;
            const bool isHit = r.hitClass == kHitClassHit;
            const bool isRight = isHit && ray.answerable && length(r.positionSS - ray.truthSS) <= tolerancePixels;
            census.answerable += ray.answerable;
            census.unanswerable += !ray.answerable;
            census.hits += isHit;
            census.right += isRight;
            census.found += isRight;
            census.falseHits += isHit && !ray.answerable;
        }
    }
    census.iterations /= rays;
    return census;
}

} // namespace

TEST(ShaderLinear, FindsWhatTheScreenShowsWithinAStride)
{
    const View view = roomView(227, 128);
    for (const bool orthographic : {false, true}) {
        const View seen = orthographic ? roomView(227, 128, 1, true) : view;
        const Census flat = traceAll(seen, floorAndWall(), byStride(1), 3);
        // The rest meets the floor before the eye, where a pixel of it is as deep as it is far, or within its own
        // pixel.
        EXPECT_GT(flat.recall(), orthographic ? 0.98 : 0.93) << orthographic;
        EXPECT_GT(flat.precision(), 0.98) << orthographic;
        const Census full = traceAll(seen, room(), byStride(1), 3);
        EXPECT_GT(full.recall(), 0.93) << orthographic;
        EXPECT_GT(full.precision(), 0.85) << orthographic;
        EXPECT_LT(full.falseShare(), 0.15) << orthographic;
    }
}

TEST(ShaderLinear, BisectionsGiveBackWhatTheStrideLoses)
{
    const View view = roomView(227, 128);
    const Census coarse = traceAll(view, floorAndWall(), byStride(8), 2);
    const Census halved = traceAll(view, floorAndWall(), byStride(8, Real(0.2), 5), 2);
    EXPECT_GT(halved.recall(), coarse.recall() + 0.3);
    EXPECT_GT(halved.recall(), 0.93);
    EXPECT_LT(halved.iterations, coarse.iterations + 5.01);
}

// A wall that faces the camera: the first sample beyond the true crossing, and no other.
RC_GTEST_PROP(ShaderLinear, StopsAtTheFirstSampleBeyond, ())
{
    const View view = straightView(160, 90);
    const Real wallDepth = drawReal(4, 9);
    renderScene(view, {plane({0, 0, -static_cast<double>(wallDepth)}, {0, 0, 1})});
    const vec2 startSS(drawReal(20, 140), drawReal(20, 70));
    const vec2 hitSS(drawReal(1, 159), drawReal(1, 89));
    const Real startDepth = drawReal(2, Real(3.8));
    const vec2 way = hitSS - startSS;
    const Real length = std::max(std::fabs(way.x), std::fabs(way.y));
    RC_PRE(length > 2);
    const vec3 origin = positionWSFromSS(view, startSS, startDepth);
    const vec3 dir = positionWSFromSS(view, hitSS, wallDepth) - origin;
    const Real stride = drawReal(Real(0.5), 12);
    const int bisections = *rc::gen::inRange(0, 6);
    const LinearResult r = traceLinear(view, origin, dir, byStride(stride, 1000, bisections));

    const Real share = length / stride, before = std::floor(share);
    // Rounding decides where a sample falls on the crossing; where the image ends before the next sample, that comes
    // nearer.
    const Real parts = (share - before) * static_cast<Real>(1 << bisections);
    RC_PRE(std::fabs(parts - std::round(parts)) > Real(1e-2));
    const vec2 nextSS = startSS + way * ((before + 1) / share);
    RC_PRE(nextSS.x > Real(0.1) && nextSS.x < Real(159.9) && nextSS.y > Real(0.1) && nextSS.y < Real(89.9));
    const Real found = (before + (std::floor(parts) + 1) / static_cast<Real>(1 << bisections)) / share;
    const Real depth = 1 / ((1 - found) / startDepth + found / wallDepth);
    const Real next = (before + 1) / share, nextInverse = (1 - next) / startDepth + next / wallDepth;
    RC_PRE(nextInverse > 1 / Real(90)); // before the far plane
    RC_PRE(depth < 30);                 // where floats tell depths
    RC_ASSERT(r.hitClass == kHitClassHit);
    RC_ASSERT(r.iterations == static_cast<int>(before) + 1 + bisections);
    const vec2 expected = startSS + way * found;
    RC_ASSERT(std::fabs(r.positionSS.x - expected.x) < 200 * kUlps * 160);
    RC_ASSERT(std::fabs(r.positionSS.y - expected.y) < 200 * kUlps * 160);
    RC_ASSERT(std::fabs(r.linearDepth / depth - 1) < 200 * kUlps);
}

TEST(ShaderLinear, StepsCutTheWayIntoEqualParts)
{
    const View view = straightView(160, 90);
    renderScene(view, {plane({0, 0, -8}, {0, 0, 1})});
    // Along the row of the eye to the right: parallel to the wall, over the border.
    const vec3 origin = positionWSFromSS(view, vec2(Real(20.5), Real(45.5)), 4);
    for (int steps : {1, 7, 64}) {
        gLinearSteps.clear();
        const LinearResult r = traceLinear(view, origin, vec3(1, 0, 0), LinearSettings(3, steps, 999, 1, 0));
        EXPECT_EQ(r.iterations, steps);
        EXPECT_EQ(r.hitClass, kHitClassUnknown);
        EXPECT_EQ(r.reason, kHitReasonOffScreen);
        ASSERT_EQ(gLinearSteps.size(), static_cast<size_t>(steps));
        for (int i = 0; i < steps; ++i) {
            const LinearStep& step = gLinearSteps[static_cast<size_t>(i)];
            EXPECT_EQ(step.iteration, i);
            EXPECT_NEAR(step.positionSS.x,
                        Real(20.5) + Real(139.5) * static_cast<Real>(i + 1) / static_cast<Real>(steps), kUlps * 160);
            EXPECT_EQ(step.intersectionKind, kIntersectionNone);
        }
    }
}

TEST(ShaderLinear, SaysWhyItEnded)
{
    const View view = straightView(160, 90);
    const auto trace = [&](vec3 dir, LinearSettings settings) {
        return traceLinear(view, positionWSFromSS(view, vec2(Real(80.5), Real(45.5)), 4), dir, settings);
    };
    renderScene(view, {});
    EXPECT_EQ(trace(vec3(Real(0.1), 0, -1), byStride(1)).reason, kHitReasonSky);
    EXPECT_EQ(trace(vec3(Real(0.1), 0, -1), byStride(1)).hitClass, kHitClassMiss);
    EXPECT_EQ(trace(vec3(Real(0.01), 0, 1), byStride(1)).reason, kHitReasonNearPlane);
    EXPECT_EQ(trace(vec3(0, 1, 0), byStride(1)).reason, kHitReasonOffScreen);
    const LinearResult capped = trace(vec3(0, 1, 0), LinearSettings(1, 0, 5, 1, 0));
    EXPECT_EQ(capped.reason, kHitReasonIterationCap);
    EXPECT_EQ(capped.hitClass, kHitClassUnknown);
    EXPECT_EQ(capped.iterations, 5);
    EXPECT_EQ(trace(vec3(0, 1, 0), LinearSettings(1, 0, 0, 1, 0)).reason, kHitReasonIterationCap);
    EXPECT_EQ(trace(vec3(0), byStride(1)).hitClass, kHitClassNoRaycast);
    EXPECT_EQ(traceLinear(view, vec3(0, 0, 5), vec3(0, 1, 0), byStride(1)).reason, kHitReasonNearPlane);
    EXPECT_EQ(traceLinear(view, vec3(500, 0, -5), vec3(0, 1, 0), byStride(1)).reason, kHitReasonOffScreen);
    // Behind a panel of no given thickness: farther than the bias it passes, and the end in hiding is unknown.
    renderScene(view, {box({2, 0, -3}, {0.8, 4, 0.01})});
    const LinearResult passed = trace(vec3(1, 0, 0), byStride(1, Real(0.5)));
    EXPECT_EQ(passed.hitClass, kHitClassUnknown);
    EXPECT_EQ(trace(vec3(1, 0, 0), byStride(1, 2)).hitClass, kHitClassHit);
    // As deep as the bias reaches.
    EXPECT_EQ(trace(vec3(1, 0, 0), byStride(1, Real(0.9))).hitClass, kHitClassUnknown);
}

// The cap ends a refinement, too.
TEST(ShaderLinear, HalvingsCountAsIterations)
{
    const View view = straightView(160, 90);
    renderScene(view, {plane({0, 0, -8}, {0, 0, 1})});
    const vec3 origin = positionWSFromSS(view, vec2(Real(20.5), Real(45.5)), 4);
    const vec3 dir = positionWSFromSS(view, vec2(Real(101.25), Real(45.5)), 8) - origin;
    const LinearResult whole = traceLinear(view, origin, dir, LinearSettings(10, 0, 99, 1, 4));
    EXPECT_EQ(whole.hitClass, kHitClassHit);
    EXPECT_EQ(whole.iterations, 9 + 4);
    for (int cap = 9; cap < 13; ++cap) {
        const LinearResult r = traceLinear(view, origin, dir, LinearSettings(10, 0, cap, 1, 4));
        EXPECT_EQ(r.reason, kHitReasonIterationCap) << cap;
        EXPECT_EQ(r.hitClass, kHitClassUnknown) << cap;
    }
}

RC_GTEST_PROP(ShaderLinear, AnswersAnything, ())
{
    const ivec2 size(*rc::gen::inRange(1, 40), *rc::gen::inRange(1, 40));
    const View view = makeView(vec2(size), kHalfFov, Real(0.1), 100, *rc::gen::inRange(0, 3));
    std::vector<vec2> texels;
    for (int i = 0; i < size.x * size.y; ++i)
        texels.push_back(*rc::gen::inRange(0, 5) == 0 ? vec2(kSkyLinearDepth) : vec2(drawReal(Real(0.2), 9)));
    buildPyramid(size, texels);
    const LinearSettings settings(drawHostile(), *rc::gen::inRange(-1, 9), *rc::gen::inRange(-1, 300), drawHostile(),
                                  *rc::gen::inRange(-1, 7));
    const bool isHostile = *rc::gen::inRange(0, 2) == 0;
    const vec3 origin = isHostile ? drawHostileVector<vec3>() : positionWSFromSS(view, vec2(size) * Real(0.4), 2);
    const LinearResult r =
        traceLinear(view, origin, isHostile ? drawHostileVector<vec3>() : drawUnitVector<vec3>(), settings);
    RC_ASSERT(gBadReads == 0);
    RC_ASSERT(isFinite(r.positionSS) && isFinite(r.linearDepth));
    RC_ASSERT(r.iterations >= 0 && r.iterations <= std::max(settings.maxIterations, 0));
    RC_ASSERT(r.reason >= 0 && r.reason < kHitReasonCount);
    RC_ASSERT((r.hitClass == kHitClassHit) == (r.reason == kHitReasonNone));
    RC_ASSERT((r.hitClass == kHitClassNoRaycast) == (r.reason == kHitReasonDegenerateRay));
}
