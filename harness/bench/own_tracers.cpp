#include "harness/bench/own_tracers.h"

#include "harness/pass/bindings.h"
#include "harness/pass/pass.h"
#include "harness/run/case_flight.h"
#include "harness/run/worker_explain.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <memory>

namespace crossray {

namespace {

constexpr double kIterationCap = 1; // kHitReasonIterationCap of crossray/shared/outputs.glsl
constexpr std::array kOutputs{"HitDepth",      "HitSuccess", "HitReason", "IterationCount",
                              "HitPositionSS", "Confidence", "FetchCount"};

// Scalars of one storage buffer that any device has room for: 128 MiB.
constexpr size_t kMostScalars = 32 << 20;

// Cases that differ in their outputs alone: large images do not get all of them in one go.
std::vector<Case> prepareCases(Case testCase, const BenchMethod& method, const DeviceForTracers& device)
{
    testCase.projection.hiz.depthBias = device.thickness;
    method.apply(testCase);
    testCase.expectations.clear();
    testCase.outputs.clear();
    const size_t scalars = static_cast<size_t>(testCase.camera.width) * static_cast<size_t>(testCase.camera.height) * 4;
    const size_t atOnce = std::max<size_t>(1, kMostScalars / scalars);
    std::vector<Case> cases;
    for (const OutputInfo& output : allOutputs()) {
        if (std::find(kOutputs.begin(), kOutputs.end(), output.name) == kOutputs.end()) continue;
        if (cases.empty() || cases.back().outputs.size() == atOnce) cases.push_back(testCase);
        cases.back().outputs.push_back(output);
    }
    return cases;
}

// Only the scene's rays are traced: it may take one pixel of many.
void maskRays(const YardstickScene& scene, Job& job)
{
    for (const Binding& binding : job.dispatches.back().bindings) {
        if (binding.what != Binding::What::kImage || binding.binding != kMaskBinding) continue;
        ImageDesc& mask = job.images[binding.index];
        std::fill(mask.texels.begin(), mask.texels.end(), 0.0);
        for (const YardstickRay& ray : scene.rays)
            mask.texels[static_cast<size_t>(ray.y) * static_cast<size_t>(mask.width) + static_cast<size_t>(ray.x)] = 1;
    }
}

std::vector<Plane> traceAll(const Case& testCase, const YardstickScene& scene, const DeviceForTracers& device)
{
    const CaseData data(testCase);
    Job job = buildJob(data, device.compiler, device.folders.shaders, Precision::kFloat);
    maskRays(scene, job);
    const JobReport report = runExplained(device.pool, device.compiler, device.folders.shaders, device.backend, 0, job,
                                          std::chrono::seconds(600));
    if (report.outcome == JobOutcome::kShaderError) throw ShaderError(report.text);
    if (report.outcome != JobOutcome::kDone)
        throw EnvironmentError(fmt::format("{} on {}: {}", testCase.name, device.backend, report.text));
    return readPlanes(testCase, report.result);
}

TracerAnswer readAnswer(const std::vector<Plane>& planes, const YardstickRay& ray)
{
    const auto at = [&](std::string_view name, int channel = 0) {
        const auto plane = std::find_if(planes.begin(), planes.end(), [&](const Plane& p) { return p.name == name; });
        return plane->at(ray.x, ray.y, channel);
    };
    TracerAnswer answer;
    answer.isHit = at("HitSuccess") == static_cast<double>(HitClass::kHit);
    answer.isCapped = at("HitReason") == kIterationCap;
    answer.positionSS = {at("HitPositionSS", 0), at("HitPositionSS", 1)};
    answer.linearDepth = at("HitDepth");
    answer.confidence = at("Confidence");
    answer.fetches = static_cast<int>(at("FetchCount"));
    answer.iterations = static_cast<int>(at("IterationCount"));
    return answer;
}

} // namespace

TracerMethod makeDeviceTracer(const BenchMethod& method, std::function<Case(const YardstickScene&)> caseOf,
                              const DeviceForTracers& device)
{
    Case probe;
    method.apply(probe);
    if (const std::string why = whyNotOn(probe, device.backend); !why.empty())
        throw InputError(fmt::format("--method {}: it cannot run on {}: {}", method.name, device.backend, why));
    return {method.name, [method, caseOf = std::move(caseOf), device](const YardstickScene& scene) -> Tracer {
                const auto planes = std::make_shared<std::vector<Plane>>();
                for (const Case& testCase : prepareCases(caseOf(scene), method, device)) {
                    std::vector<Plane> some = traceAll(testCase, scene, device);
                    std::move(some.begin(), some.end(), std::back_inserter(*planes));
                }
                return [planes](const YardstickRay& ray) { return readAnswer(*planes, ray); };
            }};
}

Case makeFamilyCase(SceneFamily family, const YardstickScene& scene)
{
    Case made;
    made.name = fmt::format("{} {}", nameOf(family), scene.seed);
    made.scene = makeRandomScene(family, scene.seed);
    made.camera = scene.gbuffer.camera;
    return made;
}

} // namespace crossray
