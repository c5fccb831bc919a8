#include "harness/expect/quantities.h"
#include "harness/expect/truth_class.h"

namespace crossray {

namespace {

PixelAnswer answerTruth(const QuantityInput& input, size_t pixel)
{
    const TruthPixel& truth = input.truth->pixels[pixel];
    const Projection& projection = input.testCase.projection;
    PixelAnswer answer;
    answer.ray = {HitReason::kNone, truth.rayOriginWS, truth.rayDirWS, truth.pathLength};
    answer.hitClass = classOf(truth.screen);
    answer.hitDepth = truth.hitLinearDepth;
    answer.hitPositionSS = truth.hitPositionSS;
    answer.radiance = truth.radiance;
    const glm::dvec2 uv = truth.hitPositionSS / glm::dvec2(input.testCase.camera.width, input.testCase.camera.height);
    answer.positionNDC = {2.0 * uv.x - 1.0, 1.0 - 2.0 * uv.y};
    const bool isHit = truth.screen == ScreenKnowledge::kVisible || truth.screen == ScreenKnowledge::kHidden;
    const bool hasColor = input.data.gbuffer().planes.contains(GBufferChannel::kColor);
    if (isHit && hasColor && isBeforeSurface(input, pixel, truth.hitLinearDepth))
        answer.radiance = ownColor(input.data, pixel);
    answer.composite = compositeOf(input.testCase, (*input.surfaces)[pixel], truth.pathLength);
    if (isHit) {
        const glm::dvec2 size(input.testCase.camera.width, input.testCase.camera.height);
        answer.hitWeight =
            screenWeightAt(truth.hitPositionSS / size, projection.screenWeightDistance, projection.screenWeightForm);
    }
    return answer;
}

// Whatever the screen shows of it, and however it weighs that.
PixelAnswer answerUnweighted(const QuantityInput& input, size_t pixel)
{
    PixelAnswer answer = answerTruth(input, pixel);
    answer.hitWeight = 1.0;
    return answer;
}

std::string refuseReflection(const Case& testCase, Output)
{
    if (testCase.effect == TraceEffect::kRefraction) return {};
    return "the case traces reflections, ray_direction is theirs";
}

} // namespace

const std::vector<Quantity>& truthTable()
{
    using enum Output;
    static const std::vector<Quantity> table{
        makeQuantity("ray_direction", "The reflected ray, or the refracted one after both interfaces.", {kRayDirWS},
                     always, nullptr, answerTruth),
        makeQuantity("ray_origin", "Where that ray starts: the surface, or where it leaves the solid.", {kRayOriginWS},
                     always, nullptr, answerTruth),
        makeQuantity("refracted_exit_direction", "The refracted ray after both interfaces.", {kRayDirWS}, always,
                     refuseReflection, answerTruth),
        makeQuantity("hit",
                     "hit: the screen shows it; unknown: hidden or off screen; miss: the sky; no raycast: no ray.",
                     {kHitSuccess}, always, nullptr, answerTruth),
        makeQuantity("hit_depth",
                     "Linear depth of what the ray meets, also where the screen does not show it; 0 for the sky.",
                     {kHitDepth}, always, nullptr, answerTruth),
        makeQuantity("hit_position_ss", "Where that is on screen; 0 for the sky and behind the camera.",
                     {kHitPositionSS}, always, nullptr, answerTruth),
        makeQuantity("hit_position_ndc", "The same in normalised device coordinates, y up.", {kPositionNDC}, always,
                     nullptr, answerTruth),
        makeQuantity(
            "hit_radiance",
            "Radiance of what the ray meets, the sky included; Color: times its screen weight and what the refracting "
            "surface lets through.",
            {kColor, kSampledColor}, always, nullptr, answerTruth),
        makeQuantity("ray_radiance", "The same without a weight: all that a mirror could show.", {kColor}, always,
                     nullptr, answerUnweighted),
        makeQuantity("path_length", "Way inside the solid.", {kPathLength}, always, refuseReflection, answerTruth),
    };
    return table;
}

} // namespace crossray
