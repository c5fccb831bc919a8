#include "harness/scene/curved_shapes.h"

#include "harness/base/error.h"
#include "harness/scene/random_scene.h"
#include "harness/scene/refraction.h"
#include "harness/scene/truth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace crossray;

namespace {

Primitive makeLens(double radius, double thickness)
{
    Primitive lens;
    lens.shape = PrimitiveShape::kLens;
    lens.radius = radius;
    lens.thickness = thickness;
    lens.material = "glass";
    return lens;
}

Primitive makeTorus(double radius, double tubeRadius)
{
    Primitive torus;
    torus.shape = PrimitiveShape::kTorus;
    torus.radius = radius;
    torus.tubeRadius = tubeRadius;
    torus.material = "glass";
    return torus;
}

Primitive makeBubble(double radius, double wall)
{
    Primitive bubble;
    bubble.shape = PrimitiveShape::kSphere;
    bubble.radius = radius;
    bubble.wall = wall;
    bubble.material = "glass";
    return bubble;
}

glm::dvec3 randomDirection(RandomStream& random)
{
    const double z = random.next(-1, 1), angle = random.next(0, 2 * std::numbers::pi);
    const double across = std::sqrt(1 - z * z);
    return {across * std::cos(angle), across * std::sin(angle), z};
}

Ray randomRay(RandomStream& random, double reach)
{
    const glm::dvec3 from = 3.0 * reach * randomDirection(random);
    const glm::dvec3 to = random.next(0, reach) * randomDirection(random);
    return {from, glm::normalize(to - from)};
}

double torusDistance(const Primitive& torus, const glm::dvec3& p)
{
    return std::hypot(std::hypot(p.x, p.y) - torus.radius, p.z) - torus.tubeRadius;
}

double lensDistance(const Primitive& lens, const glm::dvec3& p)
{
    const double away = lens.radius - 0.5 * lens.thickness;
    return std::max(glm::length(p + glm::dvec3(0, 0, away)), glm::length(p - glm::dvec3(0, 0, away))) - lens.radius;
}

// Changes of inside and outside along a ray, by steps of the whole.
template <typename Distance>
int countChanges(const Ray& ray, double end, const Distance& distance)
{
    constexpr int kSteps = 20000;
    int changes = 0;
    bool wasInside = false;
    for (int i = 0; i <= kSteps; ++i) {
        const bool isInside = distance(ray.originWS + (end * i / kSteps) * ray.dirWS) < 0;
        changes += isInside != wasInside;
        wasInside = isInside;
    }
    return changes;
}

double angleBetween(const glm::dvec3& a, const glm::dvec3& b)
{
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

} // namespace

TEST(Torus, RaysAlongItsAxesHaveClosedForms)
{
    const Primitive torus = makeTorus(1.0, 0.25);
    const auto across = intersectPrimitive(torus, {{-5, 0, 0}, {1, 0, 0}});
    ASSERT_EQ(across.size(), 4U);
    const double expected[] = {3.75, 4.25, 5.75, 6.25};
    for (size_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(across[i].distance, expected[i], 1e-14);
        EXPECT_EQ(across[i].backFace, i % 2 == 1);
        EXPECT_NEAR(across[i].normalWS.x, i % 2 == 0 ? -1.0 : 1.0, 1e-14);
    }
    EXPECT_TRUE(intersectPrimitive(torus, {{0, 0, 5}, {0, 0, -1}}).empty()) << "through the hole";
    const auto down = intersectPrimitive(torus, {{0, 1.15, 5}, {0, 0, -1}});
    ASSERT_EQ(down.size(), 2U);
    const double half = std::sqrt(0.25 * 0.25 - 0.15 * 0.15);
    EXPECT_NEAR(down[0].distance, 5 - half, 1e-14);
    EXPECT_NEAR(down[1].distance, 5 + half, 1e-14);
    EXPECT_NEAR(down[0].normalWS.y, 0.15 / 0.25, 1e-13);
    EXPECT_EQ(intersectPrimitive(torus, {{-5, 0.9, 0}, {1, 0, 0}}).size(), 2U) << "beside the hole";
}

TEST(Torus, EveryCrossingIsOnItAndNoneIsLost)
{
    RandomStream random(7);
    for (int i = 0; i < 400; ++i) {
        const double radius = random.next(0.2, 3), tube = radius * random.next(0.02, 0.98);
        const Primitive torus = makeTorus(radius, tube);
        const Ray ray = randomRay(random, radius + tube);
        const auto hits = intersectPrimitive(torus, ray);
        double last = -kNoLimit;
        bool isGrazing = false;
        for (const SurfaceHit& hit : hits) {
            EXPECT_LT(std::abs(torusDistance(torus, hit.positionWS)), 1e-14 * (4 * radius + 4 * tube));
            EXPECT_GE(hit.distance, last);
            isGrazing =
                isGrazing || hit.distance - last < 1e-2 * radius || std::abs(glm::dot(hit.normalWS, ray.dirWS)) < 0.02;
            EXPECT_EQ(hit.backFace, glm::dot(hit.normalWS, ray.dirWS) > 0) << "entry and exit in turn";
            last = hit.distance;
        }
        if (isGrazing) continue; // steps may miss what is so short
        EXPECT_EQ(static_cast<int>(hits.size()),
                  countChanges(ray, 6 * (radius + tube), [&](const glm::dvec3& p) { return torusDistance(torus, p); }))
            << i;
    }
}

TEST(Torus, StandsWhereItIsPut)
{
    Primitive torus = makeTorus(1.0, 0.25);
    torus.center = {10, 20, 30};
    torus.worldFromLocal = glm::dmat3(glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0)); // axis along x
    EXPECT_TRUE(intersectPrimitive(torus, {{0, 20, 30}, {1, 0, 0}}).empty());
    const auto hits = intersectPrimitive(torus, {{10, 20, 0}, {0, 0, 1}});
    ASSERT_EQ(hits.size(), 4U);
    EXPECT_NEAR(hits[0].distance, 28.75, 1e-12);
    EXPECT_NEAR(hits[0].normalWS.z, -1.0, 1e-12);
}

TEST(Lens, IsWhatTwoSpheresShare)
{
    const Primitive lens = makeLens(2.0, 0.6);
    const auto through = intersectPrimitive(lens, {{0, 0, 5}, {0, 0, -1}});
    ASSERT_EQ(through.size(), 2U);
    EXPECT_NEAR(through[0].distance, 4.7, 1e-14);
    EXPECT_NEAR(through[1].distance, 5.3, 1e-14);
    EXPECT_NEAR(through[0].normalWS.z, 1.0, 1e-14);
    EXPECT_NEAR(through[1].normalWS.z, -1.0, 1e-14);
    // The rim: 1.7 m from each centre, on spheres of 2 m.
    EXPECT_NEAR(lensRimRadius(lens), std::sqrt(4 - 1.7 * 1.7), 1e-15);
    const double rim = lensRimRadius(lens);
    EXPECT_EQ(intersectPrimitive(lens, {{0, 0.999 * rim, 5}, {0, 0, -1}}).size(), 2U);
    EXPECT_TRUE(intersectPrimitive(lens, {{0, 1.001 * rim, 5}, {0, 0, -1}}).empty());
    // As thick as the sphere it is the sphere.
    const auto ball = intersectPrimitive(makeLens(2.0, 4.0), {{1, 0, 5}, {0, 0, -1}});
    ASSERT_EQ(ball.size(), 2U);
    EXPECT_NEAR(ball[0].distance, 5 - std::sqrt(3.0), 1e-14);
}

TEST(Lens, EveryCrossingIsOnItAndNoneIsLost)
{
    RandomStream random(11);
    for (int i = 0; i < 400; ++i) {
        const double radius = random.next(0.2, 3);
        const Primitive lens = makeLens(radius, radius * random.next(0.1, 1.9));
        const Ray ray = randomRay(random, lensRimRadius(lens));
        const auto hits = intersectPrimitive(lens, ray);
        for (const SurfaceHit& hit : hits) {
            EXPECT_LT(std::abs(lensDistance(lens, hit.positionWS)), 1e-13 * radius);
            EXPECT_EQ(hit.backFace, glm::dot(hit.normalWS, ray.dirWS) > 0);
        }
        if (!hits.empty() && hits[1].distance - hits[0].distance < 1e-2 * radius) continue;
        EXPECT_EQ(static_cast<int>(hits.size()),
                  countChanges(ray, 6 * radius, [&](const glm::dvec3& p) { return lensDistance(lens, p); }));
    }
}

// The focal length of a thick lens, by the lensmaker's equation for rays near the axis.
TEST(Refraction, ALensBringsRaysToItsFocus)
{
    const double radius = 2.0, thickness = 0.3, n = 1.5;
    const Primitive lens = makeLens(radius, thickness);
    const double power = (n - 1) * (2 / radius - (n - 1) * thickness / (n * radius * radius));
    const double behindMiddle = 0.5 * thickness + (1 / power) * (1 - (n - 1) * thickness / (n * radius));
    for (const double height : {1e-4, 1e-3}) {
        const auto hit = intersectPrimitive(lens, {{height, 0, 5}, {0, 0, -1}}).front();
        const auto path = refractThrough(lens, hit.positionWS, hit.normalWS, {0, 0, -1});
        ASSERT_TRUE(path);
        const double run = -path->exitWS.x / path->exitDirWS.x;
        EXPECT_NEAR(-(path->exitWS.z + run * path->exitDirWS.z), behindMiddle, 3 * height * height);
        EXPECT_NEAR(path->length, thickness, height * height);
    }
}

// Through both walls the angles follow from Snell's law and from the law of sines: the impact parameter n r sin(angle)
// is the same on every sphere around the middle.
TEST(Refraction, ABubbleFollowsTheInvariantOfSpheres)
{
    const double outer = 1.0, wall = 0.1, n = 1.5, inner = outer - wall;
    const Primitive bubble = makeBubble(outer, wall);
    for (double impact = 0.0; impact < 0.995; impact += 0.02) {
        const double z = std::sqrt(1 - impact * impact);
        const glm::dvec3 entry(impact, 0, z), dir(0, 0, -1);
        const auto path = refractThrough(bubble, entry, entry, dir);
        const double inGlass = std::asin(impact / n);
        if (impact > inner) { // beyond the critical angle at the air; past n times that it would stay in the wall
            EXPECT_FALSE(path) << impact;
            continue;
        }
        ASSERT_TRUE(path) << impact;
        const double atInner = std::asin(impact / (n * inner)), inAir = std::asin(impact / inner);
        // Each interface turns the ray: towards the middle into glass, away from it into air, and the same on the way
        // out.
        const double turn = 2 * ((std::asin(impact) - inGlass) - (inAir - atInner));
        EXPECT_NEAR(angleBetween(path->exitDirWS, dir), std::abs(turn), 1e-12) << impact;
        EXPECT_NEAR(path->length, 2 * (outer * std::cos(inGlass) - inner * std::cos(atInner)), 1e-12) << impact;
        EXPECT_NEAR(glm::length(path->exitWS), outer, 1e-14);
    }
}

TEST(Refraction, AVeryThickWallIsASolidSphere)
{
    const Primitive solid = makeBubble(1.0, 0.0), shell = makeBubble(1.0, 0.999);
    for (const double impact : {0.1, 0.5, 0.9}) {
        const glm::dvec3 entry(impact, 0, std::sqrt(1 - impact * impact));
        const auto a = refractThrough(solid, entry, entry, {0, 0, -1});
        const auto b = refractThrough(shell, entry, entry, {0, 0, -1});
        ASSERT_TRUE(a && b);
        EXPECT_LT(glm::length(a->exitDirWS - b->exitDirWS), 1e-14) << "the ray passes beside the air";
        EXPECT_NEAR(a->length, b->length, 1e-14);
    }
}

TEST(Refraction, ATorusIsEnteredAsOftenAsItIsMet)
{
    // Along the line through both tubes' middles nothing is bent, and both tubes count.
    const Primitive torus = makeTorus(1.0, 0.25);
    const auto both = refractThrough(torus, {-1.25, 0, 0}, {-1, 0, 0}, {1, 0, 0});
    ASSERT_TRUE(both);
    EXPECT_NEAR(both->length, 1.0, 1e-13);
    EXPECT_NEAR(both->exitWS.x, 1.25, 1e-13);
    EXPECT_NEAR(both->exitDirWS.x, 1.0, 1e-14);
    // Down through one tube, in the plane of its axis: the tube's section is a circle there.
    const double impact = 0.1, n = 1.5;
    const glm::dvec3 normal(impact / 0.25, 0, std::sqrt(1 - impact * impact / 0.0625));
    const auto one = refractThrough(torus, glm::dvec3(1, 0, 0) + 0.25 * normal, normal, {0, 0, -1});
    ASSERT_TRUE(one);
    const double outside = std::asin(impact / 0.25), inside = std::asin(impact / (0.25 * n));
    EXPECT_NEAR(one->length, 2 * 0.25 * std::cos(inside), 1e-12);
    EXPECT_NEAR(angleBetween(one->exitDirWS, {0, 0, -1}), 2 * (outside - inside), 1e-12);
}

TEST(Truth, ATorusMirrorsItself)
{
    Scene scene;
    Primitive torus = makeTorus(1.0, 0.45);
    torus.material = "mirror";
    torus.radiance.colorA = glm::dvec3(0.25);
    scene.primitives = {torus};
    Camera camera;
    camera.width = camera.height = 48;
    camera.worldFromView = makeLookAt({0, -2.2, 2.2}, {0, 0, 0}, {0, 1, 0});
    const Truth truth = computeTruth(scene, camera, TraceEffect::kReflection);
    int itself = 0, sky = 0;
    for (const TruthPixel& pixel : truth.pixels) {
        if (pixel.screen == ScreenKnowledge::kNoRay) continue;
        if (pixel.screen == ScreenKnowledge::kSky) {
            ++sky;
            continue;
        }
        ++itself;
        EXPECT_LT(std::abs(torusDistance(torus, pixel.hitPositionWS)), 1e-13);
        EXPECT_GT(glm::length(pixel.hitPositionWS - pixel.rayOriginWS), 1e-3);
    }
    EXPECT_GT(itself, 10);
    EXPECT_GT(sky, 100);
}

TEST(Scene, RoundShapesAreHeldToTheirSizes)
{
    const auto reject = [](const Primitive& primitive) {
        Scene scene;
        scene.primitives = {primitive};
        EXPECT_THROW(validateScene(scene), InputError);
    };
    reject(makeLens(1.0, 0.0));
    reject(makeLens(1.0, 2.1));
    reject(makeTorus(1.0, 1.0));
    reject(makeTorus(1.0, 0.0));
    reject(makeBubble(1.0, 1.0));
    reject(makeBubble(1.0, -0.1));
    Scene good;
    good.primitives = {makeLens(1.0, 2.0), makeTorus(1.0, 0.99), makeBubble(1.0, 0.01)};
    EXPECT_NO_THROW(validateScene(good));
    EXPECT_EQ(localHalfExtents(makeTorus(1.0, 0.25)), glm::dvec3(1.25, 1.25, 0.25));
    EXPECT_EQ(localHalfExtents(makeLens(2.0, 4.0)), glm::dvec3(2.0));
}
