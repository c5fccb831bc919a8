#include "harness/expect/quantities.h"

namespace crossray {

namespace {

const SurfacePoint& surfaceOf(const QuantityInput& input, size_t pixel)
{
    return (*input.surfaces)[pixel];
}

PixelAnswer answerRay(const EffectRay& ray)
{
    PixelAnswer answer;
    answer.ray = ray;
    answer.reason = ray.status;
    return answer;
}

double thicknessOf(const Material& material)
{
    return material.thickness * material.thicknessMultiplier;
}

PixelAnswer answerReflection(const QuantityInput& input, size_t pixel)
{
    return answerRay(reflectAtSurface(surfaceOf(input, pixel)));
}

PixelAnswer answerRayOnScreen(const QuantityInput& input, size_t pixel)
{
    PixelAnswer answer = answerRay(computeEffectRay(input.testCase, surfaceOf(input, pixel)));
    if (answer.ray.status != HitReason::kNone) return answer;
    answer.rayDirNDC = rayDirectionNDC(input.testCase.camera, answer.ray.originWS, answer.ray.dirWS);
    return answer;
}

PixelAnswer answerSphere(const QuantityInput& input, size_t pixel)
{
    const Material& material = input.testCase.material;
    return answerRay(refractThroughSphere(surfaceOf(input, pixel), material.ior, thicknessOf(material)));
}

PixelAnswer answerBox(const QuantityInput& input, size_t pixel)
{
    const Material& material = input.testCase.material;
    return answerRay(refractThroughBox(surfaceOf(input, pixel), material.ior, thicknessOf(material)));
}

PixelAnswer answerThin(const QuantityInput& input, size_t pixel)
{
    return answerRay(refractThroughThin(surfaceOf(input, pixel), input.testCase.material.ior));
}

PixelAnswer answerStraight(const QuantityInput& input, size_t pixel)
{
    return answerRay(passStraight(surfaceOf(input, pixel)));
}

PixelAnswer answerProxy(const QuantityInput& input, size_t pixel, ProjectionModel model)
{
    const Camera& camera = input.testCase.camera;
    PixelAnswer answer = answerRay(computeEffectRay(input.testCase, surfaceOf(input, pixel)));
    ChosenProxy proxy{model, input.testCase.projection.proxy};
    if (model == ProjectionModel::kProxyProbe)
        proxy = chooseProxy(input.testCase, surfaceOf(input, pixel), answer.ray.dirWS);
    const RayEnd end = projectOnProxy(input.frame, proxy.model, proxy.volume, answer.ray);
    answer.hitClass = end.hitClass;
    answer.reason = end.reason;
    if (end.hitClass != HitClass::kHit) return answer;
    answer.hitDepth = end.screen.linearDepth;
    answer.hitPositionSS = end.screen.positionSS;
    const glm::dvec2 uv = end.screen.positionSS / glm::dvec2(camera.width, camera.height);
    answer.positionNDC = {2.0 * uv.x - 1.0, 1.0 - 2.0 * uv.y};
    answer.hitWeight =
        screenWeightAt(uv, input.testCase.projection.screenWeightDistance, input.testCase.projection.screenWeightForm);
    return answer;
}

PixelAnswer answerBoxProxy(const QuantityInput& input, size_t pixel)
{
    return answerProxy(input, pixel, ProjectionModel::kProxyBox);
}

PixelAnswer answerSphereProxy(const QuantityInput& input, size_t pixel)
{
    return answerProxy(input, pixel, ProjectionModel::kProxySphere);
}

PixelAnswer answerInfiniteProxy(const QuantityInput& input, size_t pixel)
{
    return answerProxy(input, pixel, ProjectionModel::kProxyInfinite);
}

PixelAnswer answerProbeProxy(const QuantityInput& input, size_t pixel)
{
    return answerProxy(input, pixel, ProjectionModel::kProxyProbe);
}

bool isMarch(const Case& testCase)
{
    const ProjectionModel model = testCase.projection.model;
    return model == ProjectionModel::kHiz || model == ProjectionModel::kLinear || model == ProjectionModel::kPatches;
}

// Where the case's projection should end: a proxy by its closed form; a march on the nearest surface that its ray meets
// in the scene, when the screen shows it.
PixelAnswer answerWeight(const QuantityInput& input, size_t pixel)
{
    const Projection& projection = input.testCase.projection;
    if (!isMarch(input.testCase)) return answerProxy(input, pixel, projection.model);
    PixelAnswer answer;
    const TruthPixel& truth = input.truth->pixels[pixel];
    if (truth.screen != ScreenKnowledge::kVisible) return answer;
    const glm::dvec2 size(input.testCase.camera.width, input.testCase.camera.height);
    answer.hitWeight =
        screenWeightAt(truth.hitPositionSS / size, projection.screenWeightDistance, projection.screenWeightForm);
    return answer;
}

// Where the screen shows what the ray meets; the case's surfaces there must face the camera.
PixelAnswer answerLinear(const QuantityInput& input, size_t pixel)
{
    PixelAnswer answer;
    const TruthPixel& truth = input.truth->pixels[pixel];
    if (truth.screen != ScreenKnowledge::kVisible) return answer;
    const Camera& camera = input.testCase.camera;
    const auto width = static_cast<size_t>(camera.width);
    const glm::dvec2 startSS(static_cast<double>(pixel % width) + 0.5, static_cast<double>(pixel / width) + 0.5);
    const double startDepth = input.frame.linearDepth(surfaceOf(input, pixel).positionWS);
    const LinearMarch march = marchOnFacingSurface(camera, input.testCase.projection.linear, startSS, startDepth,
                                                   truth.hitPositionSS, truth.hitLinearDepth);
    answer.iterations = march.iterations;
    answer.hitPositionSS = march.positionSS;
    answer.hitDepth = march.linearDepth;
    return answer;
}

// The scene's radiance along the closed form's ray: the sky's where it meets nothing.
PixelAnswer answerRadiance(const QuantityInput& input, size_t pixel)
{
    const Case& testCase = input.testCase;
    PixelAnswer answer = answerRay(computeEffectRay(testCase, surfaceOf(input, pixel)));
    if (answer.ray.status != HitReason::kNone) return answer;
    const glm::dvec2 size(testCase.camera.width, testCase.camera.height);
    // The ray starts on the surface that sends it out, or inside its model: it must not meet that one again.
    const auto hit = castRay(testCase.scene, {answer.ray.originWS, answer.ray.dirWS}, 1e-9, kNoLimit,
                             surfaceOf(input, pixel).primitive);
    if (!hit) {
        answer.radiance = computeSkyRadiance(testCase.scene, answer.ray.dirWS);
        return answer;
    }
    answer.radiance = computeRadiance(testCase.scene, *hit);
    const ScreenPoint screen = input.frame.project(hit->positionWS);
    if (screen.inFront) {
        answer.hitWeight = screenWeightAt(screen.positionSS / size, testCase.projection.screenWeightDistance,
                                          testCase.projection.screenWeightForm);
    }
    return answer;
}

std::string refuseReasonOfCast(const Case& testCase, Output output)
{
    if (output != Output::kHitReason || testCase.projection.model == ProjectionModel::kNone) return {};
    return "HitReason is the projection's where there is one; a refraction's form answers for it with projection none";
}

std::string refuseNoProjection(const Case& testCase, Output)
{
    if (testCase.projection.model != ProjectionModel::kNone) return {};
    return "the case projects nothing; a proxy or a march is needed";
}

bool always(const Case&)
{
    return true;
}

std::string refuseOtherThanLinear(const Case& testCase, Output)
{
    if (testCase.projection.model == ProjectionModel::kLinear) return {};
    return "the case does not march linearly; projection linear is needed";
}

std::string refuseOtherThanProbes(const Case& testCase, Output)
{
    if (testCase.projection.model == ProjectionModel::kProxyProbe) return {};
    return "the case does not project on its probes' proxies; projection proxy_probe is needed";
}

std::string refuseRecorded(const Case& testCase, Output)
{
    if (!testCase.recorded) return {};
    return "a recorded G-buffer has no scene in closed form; the truth quantity hit_radiance reads it from the "
           "G-buffer";
}

} // namespace

const std::vector<Quantity>& analyticQuantities()
{
    using enum Output;
    const std::vector<Output> ray{kRayDirWS, kRayOriginWS};
    const std::vector<Output> refracted{kRayDirWS, kRayOriginWS, kPathLength, kHitReason};
    const std::vector<Output> projected{kHitDepth, kHitSuccess, kHitReason, kHitPositionSS, kPositionNDC};
    static const std::vector<Quantity> table{
        makeQuantity("reflection_direction", "Mirror image of the view at the surface.", ray, nullptr, nullptr,
                     answerReflection),
        makeQuantity("refraction_sphere", "Through a sphere of diameter thickness behind the surface.", refracted,
                     nullptr, refuseReasonOfCast, answerSphere),
        makeQuantity("refraction_box", "Through a slab of that thickness behind the surface.", refracted, nullptr,
                     refuseReasonOfCast, answerBox),
        makeQuantity("refraction_thin", "Through a slab of 5 mm, whatever the thickness is.", refracted, nullptr,
                     refuseReasonOfCast, answerThin),
        makeQuantity("refraction_none", "Straight on along the view.", refracted, nullptr, refuseReasonOfCast,
                     answerStraight),
        makeQuantity("proxy_box", "Where the case's ray leaves the proxy box.", projected, nullptr, nullptr,
                     answerBoxProxy),
        makeQuantity("proxy_sphere", "Where the case's ray leaves the proxy sphere.", projected, nullptr, nullptr,
                     answerSphereProxy),
        makeQuantity("proxy_infinite", "65504 m along the case's ray.", projected, nullptr, nullptr,
                     answerInfiniteProxy),
        makeQuantity("ray_direction_ndc", "Direction of the case's ray on screen, and the change of 1/depth along it.",
                     {kRayDirNDC}, nullptr, nullptr, answerRayOnScreen),
        makeQuantity(
            "proxy_probe",
            "Where the case's ray leaves the proxy of the first probe that counts at the pixel, else 65504 m on.",
            projected, nullptr, refuseOtherThanProbes, answerProbeProxy),
        makeQuantity(
            "screen_weight",
            "Weight of the proxy's hit; for a march, of the true hit where the screen shows it. 0 without a hit.",
            {kHitWeight}, isMarch, refuseNoProjection, answerWeight),
        makeQuantity("linear_march",
                     "First sample of the linear march beyond the true hit, on surfaces that face the camera.",
                     {kHitPositionSS, kHitDepth, kIterationCount}, always, refuseOtherThanLinear, answerLinear),
        makeQuantity(
            "surface_radiance",
            "Radiance of what the case's ray meets in the scene, the sky included; Color: times its screen weight.",
            {kColor, kSampledColor}, nullptr, refuseRecorded, answerRadiance),
    };
    static const std::vector<Quantity> all = [] {
        std::vector<Quantity> joined = table;
        for (Quantity& quantity : hierarchyQuantities())
            joined.push_back(std::move(quantity));
        for (Quantity& quantity : profileQuantities())
            joined.push_back(std::move(quantity));
        for (Quantity& quantity : planarQuantities())
            joined.push_back(std::move(quantity));
        return joined;
    }();
    return all;
}

} // namespace crossray
