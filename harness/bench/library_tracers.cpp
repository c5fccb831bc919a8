#include "harness/bench/tracer_kernels.h"
#include "harness/bench/tracer_yardstick.h"

#include "harness/scene/camera_frame.h"

#include <fmt/format.h>

#include <array>
#include <utility>

namespace crossray {

namespace {

constexpr int kMaxIterations = 512;

TracerImage makeTracerImage(const YardstickScene& scene)
{
    const GBuffer& gbuffer = scene.gbuffer;
    const Camera& camera = gbuffer.camera;
    TracerImage image;
    image.serial = scene.serial;
    if (isTracerImageLoaded(scene.serial)) return image;
    image.width = camera.width;
    image.height = camera.height;
    for (int i = 0; i < 16; ++i)
        image.worldFromView[static_cast<size_t>(i)] = static_cast<float>(camera.worldFromView[i / 4][i % 4]);
    const glm::dvec2 slope = computeHalfSize(camera);
    image.slopeX = static_cast<float>(slope.x);
    image.slopeY = static_cast<float>(slope.y);
    // deviceDepth = A + B/linearDepth, or A + B*linearDepth: from two of its values.
    image.orthographic = camera.projection == ProjectionKind::kOrthographic;
    const double first = camera.nearDistance, second = 2 * camera.nearDistance;
    const double atFirst = computeDeviceDepth(camera, first), atSecond = computeDeviceDepth(camera, second);
    const double u = image.orthographic ? first : 1 / first;
    const double v = image.orthographic ? second : 1 / second;
    const double b = (atFirst - atSecond) / (u - v);
    image.depthA = static_cast<float>(atFirst - b * u);
    image.depthB = static_cast<float>(b);
    image.nearDistance = static_cast<float>(camera.nearDistance);
    image.farDistance = camera.depthConvention == DepthConvention::kInfiniteReversed
                            ? 65504.0f
                            : static_cast<float>(camera.farDistance);
    image.reversedDepth = camera.depthConvention != DepthConvention::kStandard;
    for (double depth : gbuffer.plane(GBufferChannel::kDeviceDepth).values)
        image.deviceDepths.push_back(static_cast<float>(depth));
    for (double normal : gbuffer.plane(GBufferChannel::kNormalWS).values)
        image.normalsWS.push_back(static_cast<float>(normal));
    return image;
}

TracerAnswer makeAnswer(const KernelAnswer& answer)
{
    TracerAnswer made;
    made.isHit = answer.isHit;
    made.isCapped = answer.isCapped;
    made.positionSS = {static_cast<double>(answer.positionX), static_cast<double>(answer.positionY)};
    made.linearDepth = static_cast<double>(answer.linearDepth);
    made.confidence = static_cast<double>(answer.confidence);
    made.fetches = answer.fetches;
    made.iterations = answer.iterations;
    return made;
}

std::array<float, 3> toFloats(const glm::dvec3& v)
{
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

KernelRay makeKernelRay(const YardstickRay& ray)
{
    KernelRay made{ray.x, ray.y, toFloats(ray.dirWS), ray.originWS.has_value(), {}};
    if (ray.originWS) made.originWS = toFloats(*ray.originWS);
    return made;
}

struct PatchKernelSettings {
    int maxIterations = kMaxIterations;
    float caution = 0;
};

Tracer preparePatches(const YardstickScene& scene, const PatchKernelSettings& settings)
{
    const auto depthError = static_cast<float>(scene.depthError);
    loadPatchTracer(makeTracerImage(scene), depthError);
    return [settings, depthError](const YardstickRay& ray) {
        return makeAnswer(tracePatchRay(makeKernelRay(ray), settings.maxIterations, settings.caution, depthError));
    };
}

Tracer prepareHiz(const YardstickScene& scene, const HizKernelSettings& settings)
{
    loadHizTracer(makeTracerImage(scene));
    return [settings](const YardstickRay& ray) { return makeAnswer(traceHizRay(makeKernelRay(ray), settings)); };
}

} // namespace

std::vector<TracerMethod> libraryTracers(double thickness)
{
    std::vector<TracerMethod> methods;
    for (const double caution : {0.0, 0.25, 0.4, 0.5, 0.7, 1.0, 2.0}) {
        methods.push_back({fmt::format("patches, caution {}", caution), [caution](const YardstickScene& scene) {
                               return preparePatches(scene, {kMaxIterations, static_cast<float>(caution)});
                           }});
    }
    const auto bias = static_cast<float>(thickness);
    const std::array<std::pair<std::string, HizKernelSettings>, 4> settings{
        {{"HiZ, levels 0 to 6, 512 steps", {0, 6, kMaxIterations, bias}},
         {"HiZ, levels 0 to 6, 64 steps", {0, 6, 64, bias}},
         {"HiZ, levels 2 to 6, 256 steps", {2, 6, 256, bias}},
         {"HiZ, levels 2 to 6, 32 steps, 1 m", {2, 6, 32, 1}}}}; // Unity 2018's settings
    for (const auto& [name, setting] : settings) {
        methods.push_back({name, [setting](const YardstickScene& scene) { return prepareHiz(scene, setting); }});
    }
    return methods;
}

std::optional<Tracer> caseTracer(const Projection& projection, const YardstickScene& scene)
{
    if (projection.model == ProjectionModel::kHiz) {
        const HizSettings& hiz = projection.hiz;
        return prepareHiz(scene, {hiz.minLevel, hiz.maxLevel, hiz.maxIterations, static_cast<float>(hiz.depthBias)});
    }
    if (projection.model == ProjectionModel::kPatches) {
        const PatchSettings& patches = projection.patches;
        return preparePatches(scene, {patches.maxIterations, static_cast<float>(patches.caution)});
    }
    return std::nullopt;
}

} // namespace crossray
