// What the tiers of a hierarchy answer: the screen by the closed form of its projection, the probes and the sky by
// theirs.
#include "harness/expect/quantities.h"

namespace crossray {

namespace {

struct ScreenPart {
    double weight = 0;
    glm::dvec3 color{0.0};
};

// The radiance that the image shows at the pixel which the hit falls into.
glm::dvec3 imageAt(const QuantityInput& input, const glm::dvec2& positionSS)
{
    const Camera& camera = input.testCase.camera;
    const glm::dvec2 last(camera.width - 1, camera.height - 1);
    const glm::dvec2 center = glm::clamp(glm::floor(positionSS), glm::dvec2(0.0), last) + 0.5;
    const Ray ray = input.frame.primaryRay(center);
    const auto hit = castPrimaryRay(input.testCase.scene, input.frame, ray);
    return hit ? computeRadiance(input.testCase.scene, *hit) : computeSkyRadiance(input.testCase.scene, ray.dirWS);
}

ScreenPart askScreen(const QuantityInput& input, const SurfacePoint& surface, const EffectRay& ray)
{
    const Case& testCase = input.testCase;
    const Projection& projection = testCase.projection;
    if (projection.model == ProjectionModel::kNone) return {};
    const ChosenProxy proxy = chooseProxy(testCase, surface, ray.dirWS);
    const RayEnd end = projectOnProxy(input.frame, proxy.model, proxy.volume, ray);
    if (end.hitClass != HitClass::kHit) return {};
    const glm::dvec2 uv = end.screen.positionSS / glm::dvec2(testCase.camera.width, testCase.camera.height);
    ScreenPart part;
    part.weight = screenWeightAt(uv, projection.screenWeightDistance, projection.screenWeightForm);
    if (part.weight > 0.0) part.color = imageAt(input, end.screen.positionSS);
    return part;
}

PixelAnswer answerHierarchy(const QuantityInput& input, size_t pixel)
{
    const SurfacePoint& surface = (*input.surfaces)[pixel];
    PixelAnswer answer;
    answer.ray = computeEffectRay(input.testCase, surface);
    const ScreenPart screen = askScreen(input, surface, answer.ray);
    answer.share = shareHierarchy(input.data, surface, answer.ray, screen.weight, screen.color);
    answer.radiance = answer.share.color;
    answer.hitWeight = 1.0; // the tiers' weights are in it
    return answer;
}

std::string refuseWhereItHasNoTiers(const Case& testCase, Output)
{
    if (testCase.hierarchy == 0) return "the case has no tiers; a hierarchy is needed";
    if (testCase.probeProfile != ProbeProfile::kHdrp)
        return "it is of the profile hdrp; probe_profile is of the others";
    const ProjectionModel model = testCase.projection.model;
    const bool isMarch = model == ProjectionModel::kHiz || model == ProjectionModel::kLinear ||
                         model == ProjectionModel::kPatches || model == ProjectionModel::kOwn;
    if (isMarch && (testCase.hierarchy & kTierScreen))
        return "a march has no closed form; a proxy is needed for the screen's tier, or none";
    for (const Probe& probe : testCase.probes)
        if (probe.kind == ProbeKind::kPlanar)
            return "planar probes have forms of their own: planar_look_up, planar_tiers";
    return {};
}

} // namespace

std::vector<Quantity> hierarchyQuantities()
{
    using enum Output;
    return {makeQuantity(
        "hierarchy", "What the tiers got of each pixel, how its first probe is read, and the colour of all of them.",
        {kColor, kTierWeights, kProbeWeights, kProbeDirWS, kProbeMipLevel}, nullptr, refuseWhereItHasNoTiers,
        answerHierarchy)};
}

} // namespace crossray
