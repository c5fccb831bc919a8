#include "harness/expect/expect.h"

#include "harness/base/error.h"
#include "harness/base/work_watch.h"
#include "harness/expect/quantities.h"
#include "harness/scene/exr.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

namespace crossray {

namespace {

std::vector<ClosedForm> infosOf(const std::vector<Quantity>& table)
{
    std::vector<ClosedForm> infos;
    for (const Quantity& quantity : table)
        infos.push_back(quantity.info);
    return infos;
}

const Quantity& findQuantity(const std::vector<Quantity>& table, std::string_view key, const std::string& name,
                             const Expectation& expectation)
{
    std::vector<std::string> names;
    for (const Quantity& quantity : table) {
        if (quantity.info.name == name) return quantity;
        names.push_back(quantity.info.name);
    }
    throw InputError(expectation.position,
                     fmt::format("unknown {} \"{}\"; allowed are {}", key, name, fmt::join(names, ", ")));
}

void checkOutput(const Case& testCase, const Quantity& quantity, std::string_view key, const Expectation& expectation)
{
    const auto output = static_cast<Output>(expectation.output.id);
    if (std::find(quantity.outputs.begin(), quantity.outputs.end(), output) == quantity.outputs.end()) {
        throw InputError(expectation.position,
                         fmt::format("{} \"{}\" says nothing about {}; allowed are {}", key, quantity.info.name,
                                     expectation.output.name, fmt::join(quantity.info.outputs, ", ")));
    }
    const std::string refusal = quantity.refuse ? quantity.refuse(testCase, output) : std::string();
    if (!refusal.empty()) {
        throw InputError(expectation.position, fmt::format("{} \"{}\": {}", key, quantity.info.name, refusal));
    }
}

void storeVector(double* target, const glm::dvec3& value)
{
    target[0] = value.x;
    target[1] = value.y;
    target[2] = value.z;
}

void storePair(double* target, const glm::dvec2& value)
{
    target[0] = value.x;
    target[1] = value.y;
}

void storeFour(double* target, const glm::dvec4& value)
{
    for (int i = 0; i < 4; ++i)
        target[i] = value[i];
}

void storeAnswer(double* target, Output output, const PixelAnswer& answer)
{
    switch (output) {
    case Output::kColor:
        return storeVector(target, answer.radiance * answer.hitWeight * answer.composite);
    case Output::kSampledColor:
        return storeVector(target, answer.radiance);
    case Output::kRayDirWS:
        return storeVector(target, answer.ray.dirWS);
    case Output::kRayOriginWS:
        return storeVector(target, answer.ray.originWS);
    case Output::kHitDepth:
        target[0] = answer.hitDepth;
        return;
    case Output::kHitSuccess:
        target[0] = static_cast<double>(answer.hitClass);
        return;
    case Output::kHitReason:
        target[0] = static_cast<double>(answer.reason);
        return;
    case Output::kHitWeight:
        target[0] = answer.hitWeight;
        return;
    case Output::kIterationCount:
        target[0] = static_cast<double>(answer.iterations);
        return;
    case Output::kFetchCount:
        target[0] = static_cast<double>(answer.fetches);
        return;
    case Output::kTransmittance:
        return storeVector(target, answer.transmittance);
    case Output::kColorMipLevel:
        target[0] = answer.mipLevel;
        return;
    case Output::kHistoryUV:
        return storePair(target, answer.historyUV);
    case Output::kPathLength:
        target[0] = answer.ray.pathLength;
        return;
    case Output::kHitPositionSS:
        return storePair(target, answer.hitPositionSS);
    case Output::kPositionNDC:
        return storePair(target, answer.positionNDC);
    case Output::kTierWeights:
        return storeFour(target, answer.share.tiers);
    case Output::kProbeWeights:
        return storeFour(target, answer.share.probes);
    case Output::kProbeDirWS:
        return storeVector(target, answer.share.probeDirWS);
    case Output::kProbeMipLevel:
        target[0] = answer.share.probeMipLevel;
        return;
    case Output::kRayDirNDC:
        return storeVector(target, answer.rayDirNDC);
    case Output::kPlanarUV:
        return storePair(target, answer.planar.uv);
    case Output::kPlanarStatus:
        target[0] = static_cast<double>(answer.planar.status);
        return;
    }
}

Plane makePlane(const CaseData& data, const OutputInfo& output)
{
    const Camera& camera = data.testCase().camera;
    return Plane(std::string(output.name), camera.width, camera.height, output.channels);
}

Plane computePlane(const CaseData& data, const Quantity& quantity, std::string_view key, const Expectation& expectation)
{
    checkOutput(data.testCase(), quantity, key, expectation);
    QuantityInput input{data, data.testCase(), CameraFrame(data.testCase().camera), &data.surfaces(), nullptr};
    if (quantity.needsTruth && quantity.needsTruth(data.testCase())) input.truth = &data.truth();
    Plane plane = makePlane(data, expectation.output);
    const std::vector<bool>& traced = data.tracedPixels();
    const auto channels = static_cast<size_t>(plane.channels);
    const auto width = static_cast<size_t>(plane.width);
    for (size_t pixel = 0; pixel < traced.size(); ++pixel) {
        if (pixel % width == 0) noteWork(pixel / width, static_cast<size_t>(plane.height));
        if (!traced[pixel]) continue;
        storeAnswer(&plane.values[pixel * channels], static_cast<Output>(expectation.output.id),
                    quantity.answer(input, pixel));
    }
    return plane;
}

Plane makeConstant(const CaseData& data, const ConstantSource& source, const Expectation& expectation)
{
    Plane plane = makePlane(data, expectation.output);
    const size_t count = source.value.size();
    if (count != 1 && count != static_cast<size_t>(plane.channels)) {
        throw InputError(expectation.position,
                         fmt::format("the constant has {} values, allowed for {} are {}1", count, plane.name,
                                     plane.channels == 1 ? "" : fmt::format("{} or ", plane.channels)));
    }
    for (size_t i = 0; i < plane.values.size(); ++i)
        plane.values[i] = source.value[i % count];
    return plane;
}

std::optional<Plane> readGolden(const CaseData& data, const GoldenSource& source, const Expectation& expectation)
{
    if (!std::filesystem::exists(source.file)) return std::nullopt;
    std::vector<std::string> names;
    for (Plane& plane : readExr(source.file)) {
        names.push_back(plane.name);
        if (plane.name != expectation.output.name) continue;
        const Plane wanted = makePlane(data, expectation.output);
        if (plane.sameShape(wanted)) return std::move(plane);
        throw InputError(expectation.position,
                         fmt::format("golden \"{}\": {} is {}x{} with {} channels, allowed is {}x{} with {}",
                                     source.file.string(), plane.name, plane.width, plane.height, plane.channels,
                                     wanted.width, wanted.height, wanted.channels));
    }
    throw InputError(expectation.position, fmt::format("golden \"{}\" has no plane {}; it has {}", source.file.string(),
                                                       expectation.output.name, fmt::join(names, ", ")));
}

} // namespace

Quantity makeQuantity(std::string name, std::string summary, std::vector<Output> outputs,
                      bool (*needsTruth)(const Case&), std::string (*refuse)(const Case&, Output),
                      PixelAnswer (*answer)(const QuantityInput&, size_t))
{
    Quantity quantity{{std::move(name), {}, std::move(summary)}, std::move(outputs), needsTruth, refuse, answer};
    for (const Output output : quantity.outputs) {
        quantity.info.outputs.emplace_back(allOutputs()[static_cast<size_t>(output)].name);
    }
    return quantity;
}

glm::dvec3 compositeOf(const Case& testCase, const SurfacePoint& surface, double pathLength)
{
    if (testCase.effect == TraceEffect::kReflection) return glm::dvec3(1.0);
    return transmittanceAfter(testCase.material, pathLength) * (1.0 - reflectedShare(testCase.material, surface));
}

bool isBeforeSurface(const QuantityInput& input, size_t pixel, double linearDepth)
{
    if (input.testCase.effect == TraceEffect::kReflection) return false;
    return linearDepth < input.frame.linearDepth((*input.surfaces)[pixel].positionWS);
}

glm::dvec3 ownColor(const CaseData& data, size_t pixel)
{
    const double* color = &data.screen().plane(GBufferChannel::kColor).values[pixel * 3];
    return {color[0], color[1], color[2]};
}

std::span<const ClosedForm> closedForms()
{
    static const std::vector<ClosedForm> infos = infosOf(analyticQuantities());
    return infos;
}

std::span<const ClosedForm> truthQuantities()
{
    static const std::vector<ClosedForm> infos = infosOf(truthTable());
    return infos;
}

void checkSources(const Case& testCase)
{
    for (const Expectation& expectation : testCase.expectations) {
        if (const auto* analytic = std::get_if<AnalyticSource>(&expectation.source)) {
            const std::string_view key = "closed form";
            checkOutput(testCase, findQuantity(analyticQuantities(), key, analytic->function, expectation), key,
                        expectation);
        } else if (const auto* truth = std::get_if<TruthSource>(&expectation.source)) {
            const std::string_view key = "truth";
            checkOutput(testCase, findQuantity(truthTable(), key, truth->quantity, expectation), key, expectation);
        }
    }
}

std::optional<Plane> makeExpected(const CaseData& data, const Expectation& expectation)
{
    if (const auto* analytic = std::get_if<AnalyticSource>(&expectation.source)) {
        const Quantity& quantity = findQuantity(analyticQuantities(), "closed form", analytic->function, expectation);
        return computePlane(data, quantity, "closed form", expectation);
    }
    if (const auto* truth = std::get_if<TruthSource>(&expectation.source)) {
        const Quantity& quantity = findQuantity(truthTable(), "truth", truth->quantity, expectation);
        return computePlane(data, quantity, "truth", expectation);
    }
    if (const auto* constant = std::get_if<ConstantSource>(&expectation.source)) {
        return makeConstant(data, *constant, expectation);
    }
    if (const auto* golden = std::get_if<GoldenSource>(&expectation.source))
        return readGolden(data, *golden, expectation);
    if (const auto* bound = std::get_if<BoundSource>(&expectation.source)) {
        constexpr double kLargest = std::numeric_limits<float>::max(); // doubles beyond it are no numbers of the shader
        return makeConstant(data, {{bound->atMost.value_or(kLargest)}}, expectation);
    }
    throw InputError(expectation.position, "agreement has no plane of its own: it is judged against another backend's");
}

} // namespace crossray
