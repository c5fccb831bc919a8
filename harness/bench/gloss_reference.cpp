#include "harness/bench/gloss_reference.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace crossray {

namespace {

constexpr double kLevelsOfRoughness = 6; // the Built-in pipeline's level of roughness 1
constexpr int kLeastSamples = 64, kMostSamples = 1024;

// Point i of n, both coordinates in (0, 1): in even steps, and by the bits of i turned round.
glm::dvec2 hammersley(int i, int n)
{
    uint32_t bits = static_cast<uint32_t>(i), turned = 0;
    for (int k = 0; k < 32; ++k) {
        turned = (turned << 1) | (bits & 1u);
        bits >>= 1;
    }
    return {(i + 0.5) / n, (static_cast<double>(turned) + 0.5) / 4294967296.0};
}

// A right-handed frame around a unit vector, its third axis.
glm::dmat3 frameAround(const glm::dvec3& axis)
{
    const glm::dvec3 other = std::abs(axis.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
    const glm::dvec3 x = glm::normalize(glm::cross(other, axis));
    return glm::dmat3(x, glm::cross(axis, x), axis);
}

glm::dvec3 directionAt(double cosine, double turn)
{
    const double sine = std::sqrt(std::max(0.0, (1 - cosine) * (1 + cosine)));
    const double angle = 2 * std::numbers::pi * turn;
    return {sine * std::cos(angle), sine * std::sin(angle), cosine};
}

// Cosine of a half vector whose density over the sphere is D(h) n.h: both lobes have it in closed form.
double sampleCosine(GlossLobe lobe, double alphaSquared, double share)
{
    if (lobe == GlossLobe::kGgx) return std::sqrt((1 - share) / (1 + (alphaSquared - 1) * share));
    const double power = 2 / alphaSquared - 2;
    return std::pow(1 - share, 1 / (power + 2));
}

// Smith's shadowing and masking by Heitz over n.l n.v, up to a factor of 4.
double visibilityOf(GlossLobe lobe, double alphaSquared, double nl, double nv)
{
    if (lobe == GlossLobe::kBlinnPhong) return 1;
    const auto reach = [&](double cosine) { return std::sqrt(alphaSquared + (1 - alphaSquared) * cosine * cosine); };
    return 1 / (nl * reach(nv) + nv * reach(nl));
}

} // namespace

glm::dvec3 integrateGloss(const RadianceByDirection& radiance, const glm::dvec3& normal, const glm::dvec3& toEye,
                          double roughness, GlossLobe lobe, int samples)
{
    const glm::dvec3 mirrored = 2 * glm::dot(normal, toEye) * normal - toEye;
    const double alphaSquared = std::pow(std::clamp(roughness, 0.0, 1.0), 4);
    if (!(alphaSquared > 0)) return radiance(mirrored);
    const glm::dmat3 frame = frameAround(normal);
    const double nv = glm::dot(normal, toEye);
    glm::dvec3 sum(0.0);
    double total = 0;
    for (int i = 0; i < samples; ++i) {
        const glm::dvec2 point = hammersley(i, samples);
        const glm::dvec3 half = frame * directionAt(sampleCosine(lobe, alphaSquared, point.x), point.y);
        const double vh = glm::dot(toEye, half);
        const glm::dvec3 light = 2 * vh * half - toEye;
        const double nl = glm::dot(normal, light);
        if (!(nl > 0) || !(vh > 0)) continue;
        // D V n.l over the density of l, which is D n.h / (4 v.h).
        const double weight = visibilityOf(lobe, alphaSquared, nl, nv) * nl * vh / glm::dot(normal, half);
        sum += weight * radiance(light);
        total += weight;
    }
    return total > 0 ? sum / total : radiance(mirrored);
}

glm::dvec3 integratePhong(const RadianceByDirection& radiance, const glm::dvec3& dir, double power, int samples)
{
    const glm::dmat3 frame = frameAround(dir);
    glm::dvec3 sum(0.0);
    for (int i = 0; i < samples; ++i) {
        const glm::dvec2 point = hammersley(i, samples);
        sum += radiance(frame * directionAt(std::pow(1 - point.x, 1 / (power + 1)), point.y));
    }
    return sum / static_cast<double>(samples);
}

FilteredChain filterByLobes(const RadianceByDirection& radiance, int size)
{
    FilteredChain chain{Cubemap(size, std::bit_width(static_cast<unsigned>(size))), 0};
    for (int level = 0; level < chain.cubemap.levelCount(); ++level) {
        const int side = chain.cubemap.sizeOf(level);
        const double roughness = std::min(1.0, level / kLevelsOfRoughness);
        // A wider lobe needs more of them, and has fewer texels.
        const int samples = level == 0 ? 1 : std::min(kMostSamples, kLeastSamples << (level - 1));
        for (int face = 0; face < kCubeFaces; ++face) {
            for (int y = 0; y < side; ++y) {
                for (int x = 0; x < side; ++x) {
                    const glm::dvec3 dir =
                        computeCubeDirection(face, (glm::dvec2(x, y) + 0.5) / static_cast<double>(side));
                    chain.samplesTaken += samples;
                    chain.cubemap.at(level, face, x, y) =
                        level == 0 ? radiance(dir)
                                   : integratePhong(radiance, dir, 2 / std::pow(roughness, 4) - 2, samples);
                }
            }
        }
    }
    return chain;
}

} // namespace crossray
