#include "harness/expect/quantities.h"

#include <algorithm>
#include <cmath>

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
    const SurfacePoint& surface = surfaceOf(input, pixel);
    return answerRay(refractThroughSphere(surface, material.ior, thicknessAt(material, surface)));
}

PixelAnswer answerBox(const QuantityInput& input, size_t pixel)
{
    const Material& material = input.testCase.material;
    const SurfacePoint& surface = surfaceOf(input, pixel);
    return answerRay(refractThroughBox(surface, material.ior, thicknessAt(material, surface)));
}

PixelAnswer answerThin(const QuantityInput& input, size_t pixel)
{
    return answerRay(refractThroughThin(surfaceOf(input, pixel), input.testCase.material.ior));
}

PixelAnswer answerEffect(const QuantityInput& input, size_t pixel)
{
    return answerRay(computeEffectRay(input.testCase, surfaceOf(input, pixel)));
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
    return model == ProjectionModel::kHiz || model == ProjectionModel::kLinear || model == ProjectionModel::kPatches ||
           model == ProjectionModel::kOwn;
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

// A walk over every pixel between the ray's own and that of the true hit, on surfaces that face the camera: a round for
// each of the two and those between, and a read for each but the first, which has one of its normal.
PixelAnswer answerPixelWalk(const QuantityInput& input, size_t pixel)
{
    PixelAnswer answer;
    const TruthPixel& truth = input.truth->pixels[pixel];
    if (truth.screen != ScreenKnowledge::kVisible) return answer;
    const auto width = static_cast<size_t>(input.testCase.camera.width);
    const glm::dvec2 start(static_cast<double>(pixel % width), static_cast<double>(pixel / width));
    const glm::dvec2 borders = glm::abs(glm::floor(truth.hitPositionSS) - start);
    answer.iterations = static_cast<int>(borders.x + borders.y) + 1;
    answer.fetches = answer.iterations;
    answer.hitPositionSS = truth.hitPositionSS;
    answer.hitDepth = truth.hitLinearDepth;
    return answer;
}

// The scene's radiance along the closed form's ray: the sky's where it meets nothing. What lies before a refracting
// surface is not seen through it: there the pixel's own.
PixelAnswer answerRadiance(const QuantityInput& input, size_t pixel)
{
    const Case& testCase = input.testCase;
    PixelAnswer answer = answerRay(computeEffectRay(testCase, surfaceOf(input, pixel)));
    if (answer.ray.status != HitReason::kNone) return answer;
    answer.composite = compositeOf(testCase, surfaceOf(input, pixel), answer.ray.pathLength);
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
    if (isBeforeSurface(input, pixel, screen.linearDepth)) answer.radiance = ownColor(input.data, pixel);
    if (screen.inFront) {
        answer.hitWeight = screenWeightAt(screen.positionSS / size, testCase.projection.screenWeightDistance,
                                          testCase.projection.screenWeightForm);
    }
    return answer;
}

// Where the case's projection ends, as far as a closed form or the truth knows.
PixelAnswer answerHit(const QuantityInput& input, size_t pixel)
{
    if (!isMarch(input.testCase)) return answerProxy(input, pixel, input.testCase.projection.model);
    PixelAnswer answer = answerWeight(input, pixel);
    const TruthPixel& truth = input.truth->pixels[pixel];
    answer.ray = computeEffectRay(input.testCase, surfaceOf(input, pixel));
    if (truth.screen != ScreenKnowledge::kVisible) return answer;
    answer.hitClass = HitClass::kHit;
    answer.hitPositionSS = truth.hitPositionSS;
    answer.hitDepth = truth.hitLinearDepth;
    return answer;
}

// UV in the previous frame of what a place on this one's screen shows at a depth; nothing where it had no place.
std::optional<glm::dvec2> previousUVOf(const QuantityInput& input, const glm::dvec2& positionSS, double linearDepth)
{
    const Case& testCase = input.testCase;
    const glm::dvec2 size(testCase.camera.width, testCase.camera.height);
    const CameraFrame previous(testCase.history->camera);
    if (testCase.history->reprojection == Reprojection::kPreviousViewProjection) {
        return findPreviousUV(testCase, previous, input.frame.unproject(positionSS, linearDepth), -1);
    }
    const glm::dvec2 uv = positionSS / size;
    if (!(uv.x >= 0.0 && uv.x <= 1.0 && uv.y >= 0.0 && uv.y <= 1.0)) return std::nullopt;
    // The motion vector is that of the pixel's centre.
    const glm::dvec2 pixel = glm::min(glm::floor(positionSS), size - 1.0);
    const Plane& motion = input.data.history()->motion;
    const auto x = static_cast<int>(pixel.x), y = static_cast<int>(pixel.y);
    const glm::dvec2 moved(motion.at(x, y, 0), motion.at(x, y, 1));
    if (!std::isfinite(moved.x) || !std::isfinite(moved.y)) return std::nullopt;
    return uv - moved;
}

PixelAnswer answerHistory(const QuantityInput& input, size_t pixel)
{
    const Case& testCase = input.testCase;
    PixelAnswer answer = answerHit(input, pixel);
    if (answer.hitClass != HitClass::kHit) return answer;
    const auto levels = static_cast<int>(input.data.colorLevels().size());
    const int asked = testCase.history->levels;
    answer.mipLevel =
        colorLevelOf(testCase.material.roughness, testCase.effect, asked > 0 ? std::min(asked, levels) : levels);
    const auto width = static_cast<size_t>(testCase.camera.width);
    glm::dvec2 place = answer.hitPositionSS;
    double depth = answer.hitDepth;
    if (isBeforeSurface(input, pixel, depth)) {
        place = {static_cast<double>(pixel % width) + 0.5, static_cast<double>(pixel / width) + 0.5};
        depth = input.frame.linearDepth(surfaceOf(input, pixel).positionWS);
    }
    const std::optional<glm::dvec2> uv = previousUVOf(input, place, depth);
    std::optional<glm::dvec3> color;
    if (uv) {
        answer.historyUV = *uv;
        if (uv->x >= 0.0 && uv->x <= 1.0 && uv->y >= 0.0 && uv->y <= 1.0)
            color = colorAt(input.data.colorLevels(), *uv, answer.mipLevel);
    }
    answer.radiance = color.value_or(glm::dvec3(0.0));
    answer.hitWeight = color ? answer.hitWeight : 0.0;
    answer.composite = compositeOf(testCase, surfaceOf(input, pixel), answer.ray.pathLength);
    return answer;
}

PixelAnswer answerAbsorption(const QuantityInput& input, size_t pixel)
{
    const Case& testCase = input.testCase;
    PixelAnswer answer = answerRay(computeEffectRay(testCase, surfaceOf(input, pixel)));
    answer.transmittance = testCase.effect == TraceEffect::kRefraction
                               ? transmittanceAfter(testCase.material, answer.ray.pathLength)
                               : glm::dvec3(1.0);
    return answer;
}

std::string refuseNoHistory(const Case& testCase, Output)
{
    if (testCase.history) return {};
    return "the case has no previous frame; [history] is needed";
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

std::string refuseOtherThanLinear(const Case& testCase, Output)
{
    if (testCase.projection.model == ProjectionModel::kLinear) return {};
    return "the case does not march linearly; projection linear is needed";
}

std::string refuseOtherThanOwn(const Case& testCase, Output)
{
    if (testCase.projection.model == ProjectionModel::kOwn) return {};
    return "the case's tracer is none of the person's own; projection own is needed";
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
        makeQuantity("case_ray", "The ray of the case's own effect and refraction model.", refracted, nullptr,
                     refuseReasonOfCast, answerEffect),
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
        makeQuantity("absorption", "Share of white light that is left after the way inside the material.",
                     {kTransmittance}, nullptr, nullptr, answerAbsorption),
        makeQuantity(
            "history",
            "Where the hit was in the previous frame, and the colour there at the roughness' level. 0 without a "
            "hit or a place.",
            {kColor, kSampledColor, kHitWeight, kColorMipLevel, kHistoryUV}, isMarch, refuseNoHistory, answerHistory),
        makeQuantity("linear_march",
                     "First sample of the linear march beyond the true hit, on surfaces that face the camera.",
                     {kHitPositionSS, kHitDepth, kIterationCount}, always, refuseOtherThanLinear, answerLinear),
        makeQuantity(
            "pixel_walk",
            "The true hit, reached pixel by pixel: a round and a read for each pixel from the ray's own on, on "
            "surfaces that face the camera.",
            {kHitPositionSS, kHitDepth, kIterationCount, kFetchCount}, always, refuseOtherThanOwn, answerPixelWalk),
        makeQuantity(
            "surface_radiance",
            "Radiance of what the case's ray meets in the scene, the sky included; Color: times its screen weight and "
            "what the refracting surface lets through.",
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
