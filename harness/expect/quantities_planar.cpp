// The closed forms of planar probes.
#include "harness/expect/quantities.h"

#include <algorithm>

namespace crossray {

namespace {

PixelAnswer answerLookUp(const QuantityInput& input, size_t pixel)
{
    const SurfacePoint& surface = (*input.surfaces)[pixel];
    PixelAnswer answer;
    answer.ray = computeEffectRay(input.testCase, surface);
    if (answer.ray.status != HitReason::kNone) return answer;
    answer.planar = sharePlanarProbes(input.testCase, surface, answer.ray).first;
    return answer;
}

PixelAnswer answerTiers(const QuantityInput& input, size_t pixel)
{
    const Case& testCase = input.testCase;
    const SurfacePoint& surface = (*input.surfaces)[pixel];
    PixelAnswer answer;
    answer.ray = computeEffectRay(testCase, surface);
    answer.hitWeight = 1.0; // the radiance is weighted here
    if (answer.ray.status != HitReason::kNone) return answer;
    const PlanarShare share = sharePlanarProbes(testCase, surface, answer.ray);
    answer.share.tiers.z = share.weight;
    answer.radiance = share.multiplied * input.truth->pixels[pixel].radiance;
    if ((testCase.hierarchy & kTierSky) == 0 || testCase.sky.model == SkyModel::kNone) return answer;
    answer.share.tiers.w = 1.0 - share.weight;
    Scene sky;
    sky.sky = testCase.sky.gradient;
    sky.upWS = testCase.scene.upWS;
    answer.radiance += answer.share.tiers.w * computeSkyRadiance(sky, answer.ray.dirWS);
    return answer;
}

std::string refuseOtherProbes(const Case& testCase, Output)
{
    const bool onlyPlanar = std::all_of(testCase.probes.begin(), testCase.probes.end(),
                                        [](const Probe& probe) { return probe.kind == ProbeKind::kPlanar; });
    const bool asksProbes = (testCase.hierarchy & kTierProbes) != 0 && !testCase.probes.empty();
    if (onlyPlanar && asksProbes && testCase.effect == TraceEffect::kReflection) return {};
    return "a reflection whose hierarchy asks probes, planar ones alone, is allowed";
}

std::string refuseTiers(const Case& testCase, Output output)
{
    const bool hasScreen = (testCase.hierarchy & kTierScreen) != 0;
    const bool hasCubemapSky = (testCase.hierarchy & kTierSky) != 0 && testCase.sky.model == SkyModel::kCubemap;
    if (hasScreen || hasCubemapSky) return "a hierarchy without the screen and without a cubemap sky is allowed";
    return refuseOtherProbes(testCase, output);
}

} // namespace

std::vector<Quantity> planarQuantities()
{
    using enum Output;
    return {
        makeQuantity(
            "planar_look_up",
            "Where the first planar probe that reaches the pixel shows the end of its ray, or why it does not.",
            {kPlanarUV, kPlanarStatus}, nullptr, refuseOtherProbes, answerLookUp),
        makeQuantity("planar_tiers",
                     "What planar probes and the sky get; Color: the truth's radiance along the ray, times the planar "
                     "weights, and the sky's.",
                     {kTierWeights, kColor}, always, refuseTiers, answerTiers),
    };
}

} // namespace crossray
