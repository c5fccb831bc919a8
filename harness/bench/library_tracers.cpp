#include "harness/bench/tracer_kernels.h"
#include "harness/bench/tracer_yardstick.h"

#include "harness/scene/camera_frame.h"

#include <fmt/format.h>

namespace crossray {

namespace {

constexpr int kMaxIterations = 512;

TracerImage makeTracerImage(const GBuffer& gbuffer)
{
    const Camera& camera = gbuffer.camera;
    TracerImage image;
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

} // namespace

std::vector<TracerMethod> libraryTracers(double thickness)
{
    std::vector<TracerMethod> methods;
    for (const double caution : {0.25, 0.4, 0.5, 1.0}) {
        methods.push_back(
            {fmt::format("planes, caution {}", caution), [caution](const YardstickScene& scene) -> Tracer {
                 loadPatchTracer(makeTracerImage(scene.gbuffer), 0);
                 return [caution](const YardstickRay& ray) {
                     return makeAnswer(tracePatchRay(ray.x, ray.y, toFloats(ray.dirWS), kMaxIterations,
                                                     static_cast<float>(caution), 0));
                 };
             }});
    }
    methods.push_back({"HiZ, levels 0 to 6", [thickness](const YardstickScene& scene) -> Tracer {
                           loadHizTracer(makeTracerImage(scene.gbuffer));
                           return [thickness](const YardstickRay& ray) {
                               return makeAnswer(traceHizRay(ray.x, ray.y, toFloats(ray.dirWS), 6, kMaxIterations,
                                                             static_cast<float>(thickness)));
                           };
                       }});
    return methods;
}

} // namespace crossray
