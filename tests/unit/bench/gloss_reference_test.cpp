#include "harness/bench/gloss_reference.h"

#include "harness/scene/scene.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace crossray;

namespace {

const glm::dvec3 kUp(0, 0, 1);

// Of which every rotationally symmetric lobe makes a multiple: 1 + cosine to an axis.
RadianceByDirection slopeAlong(const glm::dvec3& axis)
{
    return [axis](const glm::dvec3& dir) { return glm::dvec3(1 + glm::dot(dir, axis)); };
}

double meanCosine(const glm::dvec3& value)
{
    return value.x - 1;
}

} // namespace

// The mean cosine of a Phong lobe is (k + 1) / (k + 2), in closed form.
TEST(GlossReference, APhongLobeShrinksASlopeAsItsClosedFormSays)
{
    const glm::dvec3 axis = glm::normalize(glm::dvec3(0.3, -0.5, 0.8));
    for (const double power : {0.0, 1.0, 6.0, 30.0, 2590.0}) {
        for (const glm::dvec3& dir : {kUp, axis, glm::normalize(glm::dvec3(1, 1, -1))}) {
            const double found = meanCosine(integratePhong(slopeAlong(axis), dir, power, 4096));
            EXPECT_NEAR(found, glm::dot(dir, axis) * (power + 1) / (power + 2), 1e-3) << power;
        }
    }
}

// Seen along the normal both lobes are symmetric around it. Blinn-Phong with weight n.l: with c = cosine of the half
// vector the light's is 2c^2 - 1, and the mean of it is a quotient of powers' integrals.
TEST(GlossReference, BlinnPhongAlongTheNormalHasAClosedForm)
{
    for (const double roughness : {0.2, 0.5, 0.8, 1.0}) {
        const double power = 2 / std::pow(roughness, 4) - 2;
        // Integral over c from 1/sqrt(2) to 1 of c^p (2c^2 - 1)^m c dc, times what the density of the light leaves: c.
        const auto integral = [&](int m) {
            double sum = 0;
            constexpr int kSteps = 200000;
            const double low = std::sqrt(0.5);
            for (int i = 0; i < kSteps; ++i) {
                const double c = low + (1 - low) * (i + 0.5) / kSteps;
                sum += std::pow(c, power) * std::pow(2 * c * c - 1, m) * c;
            }
            return sum;
        };
        const double found =
            meanCosine(integrateGloss(slopeAlong(kUp), kUp, kUp, roughness, GlossLobe::kBlinnPhong, 16384));
        EXPECT_NEAR(found, integral(2) / integral(1), 1e-3) << roughness;
    }
}

// The same by another way: a fine grid over the half space, with the lobe's own formula.
TEST(GlossReference, GgxAgreesWithAGridOverTheHalfSpace)
{
    const glm::dvec3 axis = glm::normalize(glm::dvec3(0.6, 0.2, 0.5));
    const glm::dvec3 toEye = glm::normalize(glm::dvec3(0.7, 0, 0.7));
    const auto radiance = slopeAlong(axis);
    for (const double roughness : {0.4, 0.7, 1.0}) {
        const double a2 = std::pow(roughness, 4), nv = toEye.z;
        glm::dvec3 sum(0.0);
        double total = 0;
        constexpr int kRows = 600, kColumns = 600;
        for (int i = 0; i < kRows; ++i) {
            for (int j = 0; j < kColumns; ++j) {
                const double nl = (i + 0.5) / kRows, sine = std::sqrt(1 - nl * nl),
                             turn = 2 * M_PI * (j + 0.5) / kColumns;
                const glm::dvec3 light(sine * std::cos(turn), sine * std::sin(turn), nl);
                const double nh = glm::normalize(light + toEye).z;
                const double d = 1 / std::pow(1 + (a2 - 1) * nh * nh, 2);
                const double shadow =
                    1 / (nl * std::sqrt(a2 + (1 - a2) * nv * nv) + nv * std::sqrt(a2 + (1 - a2) * nl * nl));
                sum += d * shadow * nl * radiance(light);
                total += d * shadow * nl;
            }
        }
        const double found = integrateGloss(radiance, kUp, toEye, roughness, GlossLobe::kGgx, 16384).x;
        EXPECT_NEAR(found, sum.x / total, 2e-3) << roughness;
    }
}

TEST(GlossReference, MoreSamplesChangeLittleOnAScene)
{
    Scene scene;
    Primitive box;
    box.shape = PrimitiveShape::kBox;
    box.halfExtents = {3, 2, 4};
    box.radiance.pattern = RadiancePattern::kChecker;
    scene.primitives = {box};
    const RadianceByDirection radiance = [&](const glm::dvec3& dir) {
        const auto hit = castRay(scene, {glm::dvec3(0.1), dir});
        return hit ? computeRadiance(scene, *hit) : glm::dvec3(0.0);
    };
    const glm::dvec3 toEye = glm::normalize(glm::dvec3(0.5, 0.1, 0.8));
    for (const GlossLobe lobe : {GlossLobe::kGgx, GlossLobe::kBlinnPhong}) {
        for (const double roughness : {0.1, 0.4, 0.9}) {
            const glm::dvec3 few = integrateGloss(radiance, kUp, toEye, roughness, lobe, 8192);
            const glm::dvec3 many = integrateGloss(radiance, kUp, toEye, roughness, lobe, 131072);
            EXPECT_LT(glm::length(few - many), 0.012) << roughness;
        }
    }
    EXPECT_EQ(integrateGloss(radiance, kUp, kUp, 0.0, GlossLobe::kGgx, 16), radiance(kUp));
    EXPECT_NEAR(
        integrateGloss([](const glm::dvec3&) { return glm::dvec3(0.3); }, kUp, toEye, 0.7, GlossLobe::kGgx, 64).x, 0.3,
        1e-15);
}

TEST(GlossReference, AChainsLevelsAreItsLobes)
{
    const glm::dvec3 axis = glm::normalize(glm::dvec3(0.2, 0.4, 0.9));
    const FilteredChain chain = filterByLobes(slopeAlong(axis), 64);
    ASSERT_EQ(chain.cubemap.levelCount(), 7);
    const glm::dvec3 dir = computeCubeDirection(4, {0.5, 0.5});
    for (int level = 0; level < 6; ++level) {
        const int side = chain.cubemap.sizeOf(level);
        const glm::dvec3 texel = computeCubeDirection(4, (glm::dvec2(side / 2) + 0.5) / static_cast<double>(side));
        const double power = 2 / std::pow(level / 6.0, 4) - 2;
        const double shrink = level == 0 ? 1 : (power + 1) / (power + 2);
        EXPECT_NEAR(chain.cubemap.at(level, 4, side / 2, side / 2).x - 1, shrink * glm::dot(texel, axis), 4e-3)
            << level;
    }
    EXPECT_NEAR(chain.cubemap.at(6, 4, 0, 0).x - 1, 0.5 * glm::dot(dir, axis), 4e-3) << "half of all directions";
    EXPECT_GT(chain.samplesTaken, 6.0 * 64 * 64);
}
