#include "harness/pass/pass.h"

#include "harness/pass/params.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace crossray {

namespace {

// Binding numbers; shaders/bindings/*.glsl.
constexpr uint32_t kParamsBinding = 0, kDepthBinding = 1, kNormalBinding = 2, kColorBinding = 3, kMaskBinding = 4;
constexpr uint32_t kPyramidBinding = 8, kOutputBinding = 9;
constexpr uint32_t kGroupSize = 8; // local size of the entry shaders, both ways

struct PyramidLevel {
    int firstCell = 0, width = 0, height = 0;
};

// Level l+1 has half the cells of level l, rounded down but never below 1; the last cell of an odd side covers three.
std::vector<PyramidLevel> layOutPyramid(int width, int height)
{
    std::vector<PyramidLevel> levels{{0, width, height}};
    while (levels.back().width > 1 || levels.back().height > 1) {
        const PyramidLevel& finer = levels.back();
        levels.push_back({finer.firstCell + finer.width * finer.height, std::max(1, finer.width / 2),
                          std::max(1, finer.height / 2)});
    }
    return levels;
}

// deviceDepth = x + y / linearDepth (perspective) or x + y * linearDepth (orthographic); always [0,1] storage.
glm::dvec4 computeDepthTerms(const Camera& camera)
{
    const double nearZ = camera.nearDistance;
    const double farZ = camera.farDistance;
    const double range = farZ - nearZ;
    // Far enough for any scene, small enough for half floats: HDRP's stand-in for infinity.
    constexpr double kInfiniteFar = 65504.0;
    if (camera.projection == ProjectionKind::kOrthographic) {
        if (camera.depthConvention == DepthConvention::kStandard) return {-nearZ / range, 1.0 / range, nearZ, farZ};
        return {farZ / range, -1.0 / range, nearZ, farZ};
    }
    switch (camera.depthConvention) {
    case DepthConvention::kStandard:
        return {farZ / range, -farZ * nearZ / range, nearZ, farZ};
    case DepthConvention::kReversed:
        return {-nearZ / range, farZ * nearZ / range, nearZ, farZ};
    case DepthConvention::kInfiniteReversed:
        return {0.0, nearZ, nearZ, kInfiniteFar};
    }
    return {};
}

glm::dvec2 computeSlope(const Camera& camera)
{
    const double aspect = static_cast<double>(camera.width) / camera.height;
    const double vertical = camera.projection == ProjectionKind::kPerspective
                                ? std::tan(glm::radians(camera.fovYDegrees) * 0.5)
                                : camera.orthographicHeight * 0.5;
    return {vertical * aspect, vertical};
}

template <class Params>
Params fillPassParams(const Case& testCase, const std::vector<PyramidLevel>& levels)
{
    using Vec4 = decltype(Params::material);
    using Mat4 = decltype(Params::viewFromWorld);
    const Camera& camera = testCase.camera;
    const Material& material = testCase.material;
    const Projection& projection = testCase.projection;
    const glm::dvec2 slope = computeSlope(camera);

    Params params{};
    params.viewFromWorld = Mat4(computeViewFromWorld(camera));
    params.worldFromView = Mat4(camera.worldFromView);
    params.clipFromView = Mat4(computeClipFromView(camera));
    params.worldFromProxy = Mat4(glm::dmat4(projection.proxy.worldFromProxy));
    params.imageSizeAndSlope = Vec4(glm::dvec4(camera.width, camera.height, slope.x, slope.y));
    params.depthTerms = Vec4(computeDepthTerms(camera));
    params.material =
        Vec4(glm::dvec4(material.ior, material.thickness * material.thicknessMultiplier, material.roughness, 0.0));
    params.proxyCenterWS = Vec4(glm::dvec4(projection.proxy.center, 0.0));
    params.proxyExtents = Vec4(glm::dvec4(projection.proxy.halfExtents, projection.proxy.radius));
    params.tracing = Vec4(glm::dvec4(projection.hiz.depthBias, projection.screenWeightDistance, 0.0, 0.0));
    params.hizLimits = glm::ivec4(projection.hiz.minLevel, projection.hiz.maxLevel, projection.hiz.maxIterations,
                                  static_cast<int>(levels.size()));
    for (size_t level = 0; level < levels.size(); ++level) {
        params.pyramidLevels[level] = {levels[level].firstCell, levels[level].width, levels[level].height, 0};
    }
    return params;
}

template <class Params>
Params fillPyramidParams(const Case& testCase, const std::vector<PyramidLevel>& levels, size_t target)
{
    using Vec4 = decltype(Params::depthTerms);
    const PyramidLevel& source = levels[target == 0 ? 0 : target - 1];
    Params params{};
    params.depthTerms = Vec4(computeDepthTerms(testCase.camera));
    params.sourceLevel = {source.firstCell, source.width, source.height, static_cast<int>(target) - 1};
    params.targetLevel = {levels[target].firstCell, levels[target].width, levels[target].height,
                          static_cast<int>(target)};
    return params;
}

BufferDesc uniformBuffer(std::vector<std::byte> bytes)
{
    return {BufferKind::kUniform, std::move(bytes), 0};
}

BufferDesc storageBuffer(size_t scalarCount)
{
    return {BufferKind::kStorage, {}, scalarCount};
}

ImageDesc imageFromPlane(const Plane& plane)
{
    ImageDesc image{plane.width, plane.height, plane.channels == 1 ? 1 : 4, 1, ImageFilter::kNearest, {}};
    if (plane.channels == 1) {
        image.texels = plane.values;
        return image;
    }
    image.texels.assign(plane.pixelCount() * 4, 1.0);
    for (size_t pixel = 0; pixel < plane.pixelCount(); ++pixel) {
        for (int channel = 0; channel < std::min(plane.channels, 4); ++channel) {
            image.texels[pixel * 4 + static_cast<size_t>(channel)] =
                plane.values[pixel * static_cast<size_t>(plane.channels) + static_cast<size_t>(channel)];
        }
    }
    return image;
}

uint32_t groupsFor(int size)
{
    return (static_cast<uint32_t>(size) + kGroupSize - 1) / kGroupSize;
}

uint32_t outputMask(const Case& testCase)
{
    uint32_t mask = 0;
    for (const OutputInfo& output : testCase.outputs)
        mask |= 1u << output.id;
    return mask;
}

ProgramSource compileEntry(ShaderCompiler& compiler, const std::filesystem::path& shaderRoot, const std::string& entry,
                           std::map<std::string, double> specialization)
{
    CompileOptions options;
    options.includeRoot = shaderRoot;
    options.specialization = std::move(specialization);
    CompiledShader compiled = compiler.compile(shaderRoot / entry, options);
    return {entry, options.specialization, std::move(compiled.spirv), std::move(compiled.glsl), compiled.key};
}

std::map<std::string, double> traceVariant(const Case& testCase)
{
    const Camera& camera = testCase.camera;
    return {
        {"kEffect", testCase.effect == TraceEffect::kRefraction ? 1 : 0},
        {"kRefractionModel", static_cast<int>(testCase.material.refractionModel)},
        {"kProjectionModel", static_cast<int>(testCase.projection.model)},
        {"kOutputMask", outputMask(testCase)},
        {"kOrthographic", camera.projection == ProjectionKind::kOrthographic ? 1 : 0},
        {"kReversedDepth", camera.depthConvention == DepthConvention::kStandard ? 0 : 1},
        {"kScreenWeightForm", static_cast<int>(testCase.projection.screenWeightForm)},
    };
}

// Collects the pieces of a job; resources are numbered in the order in which they are added.
class JobBuilder {
  public:
    JobBuilder(const CaseData& data, Precision precision) : data_(data), precision_(precision)
    {
        job_.label = data.testCase().name;
        levels_ = layOutPyramid(camera().width, camera().height);
    }

    Binding addImage(uint32_t binding, ImageDesc image)
    {
        job_.images.push_back(std::move(image));
        return {binding, Binding::What::kImage, job_.images.size() - 1};
    }

    Binding addBuffer(uint32_t binding, BufferDesc buffer)
    {
        job_.buffers.push_back(std::move(buffer));
        return {binding, Binding::What::kBuffer, job_.buffers.size() - 1};
    }

    void addPyramid(ShaderCompiler& compiler, const std::filesystem::path& shaderRoot, const Binding& depth)
    {
        const size_t cells = static_cast<size_t>(levels_.back().firstCell) + 1;
        pyramid_ = addBuffer(kPyramidBinding, storageBuffer(cells * 2));
        job_.programs.push_back(
            compileEntry(compiler, shaderRoot, "entry/depth_pyramid.comp",
                         {{"kOrthographic", isOrthographic() ? 1 : 0}, {"kReversedDepth", isReversed() ? 1 : 0}}));
        for (size_t level = 0; level < levels_.size(); ++level) {
            const Binding params = addBuffer(
                kParamsBinding,
                uniformBuffer(
                    precision_ == Precision::kFloat
                        ? bytesOf(fillPyramidParams<layout32::PyramidParams>(data_.testCase(), levels_, level))
                        : bytesOf(fillPyramidParams<layout64::PyramidParams>(data_.testCase(), levels_, level))));
            job_.dispatches.push_back({job_.programs.size() - 1,
                                       {params, depth, *pyramid_},
                                       groupsFor(levels_[level].width),
                                       groupsFor(levels_[level].height),
                                       1});
        }
    }

    void addTrace(ShaderCompiler& compiler, const std::filesystem::path& shaderRoot, const Binding& depth)
    {
        const Case& testCase = data_.testCase();
        std::vector<Binding> bindings{depth};
        bindings.push_back(addBuffer(
            kParamsBinding, uniformBuffer(precision_ == Precision::kFloat
                                              ? bytesOf(fillPassParams<layout32::PassParams>(testCase, levels_))
                                              : bytesOf(fillPassParams<layout64::PassParams>(testCase, levels_)))));
        bindings.push_back(addImage(kNormalBinding, imageFromPlane(data_.gbuffer().plane(GBufferChannel::kNormalWS))));
        if (data_.gbuffer().planes.contains(GBufferChannel::kColor)) {
            bindings.push_back(addImage(kColorBinding, imageFromPlane(data_.gbuffer().plane(GBufferChannel::kColor))));
        }
        bindings.push_back(addImage(kMaskBinding, makeTraceMask()));
        if (pyramid_) bindings.push_back(*pyramid_);
        const size_t planeScalars = static_cast<size_t>(camera().width) * static_cast<size_t>(camera().height) * 4;
        bindings.push_back(addBuffer(kOutputBinding, storageBuffer(planeScalars * testCase.outputs.size())));
        job_.readbacks.push_back(bindings.back().index);
        job_.programs.push_back(compileEntry(compiler, shaderRoot, "entry/screen_trace.comp", traceVariant(testCase)));
        job_.dispatches.push_back(
            {job_.programs.size() - 1, std::move(bindings), groupsFor(camera().width), groupsFor(camera().height), 1});
    }

    Job take() { return std::move(job_); }

  private:
    const Camera& camera() const { return data_.testCase().camera; }
    bool isOrthographic() const { return camera().projection == ProjectionKind::kOrthographic; }
    bool isReversed() const { return camera().depthConvention != DepthConvention::kStandard; }

    ImageDesc makeTraceMask() const
    {
        ImageDesc image{camera().width, camera().height, 1, 1, ImageFilter::kNearest, {}};
        image.texels.assign(data_.tracedPixels().begin(), data_.tracedPixels().end());
        return image;
    }

    const CaseData& data_;
    Precision precision_;
    std::vector<PyramidLevel> levels_;
    std::optional<Binding> pyramid_;
    Job job_;
};

} // namespace

Job buildJob(const CaseData& data, ShaderCompiler& compiler, const std::filesystem::path& shaderRoot,
             Precision precision)
{
    JobBuilder builder(data, precision);
    const Binding depth =
        builder.addImage(kDepthBinding, imageFromPlane(data.gbuffer().plane(GBufferChannel::kDeviceDepth)));
    if (data.testCase().projection.model == ProjectionModel::kHiz) builder.addPyramid(compiler, shaderRoot, depth);
    builder.addTrace(compiler, shaderRoot, depth);
    return builder.take();
}

std::vector<Plane> readPlanes(const Case& testCase, const JobResult& result)
{
    const size_t pixels = static_cast<size_t>(testCase.camera.width) * static_cast<size_t>(testCase.camera.height);
    if (result.readbacks.size() != 1 || result.readbacks[0].size() != pixels * 4 * testCase.outputs.size()) {
        throw EnvironmentError(fmt::format("{}: the device returned {} values, expected {}", testCase.name,
                                           result.readbacks.empty() ? 0 : result.readbacks[0].size(),
                                           pixels * 4 * testCase.outputs.size()));
    }
    const uint32_t mask = outputMask(testCase);
    std::vector<Plane> planes;
    for (const OutputInfo& output : testCase.outputs) {
        const auto slot = static_cast<size_t>(std::popcount(mask & ((1u << output.id) - 1u)));
        const double* values = result.readbacks[0].data() + slot * pixels * 4;
        Plane plane(std::string(output.name), testCase.camera.width, testCase.camera.height, output.channels);
        for (size_t pixel = 0; pixel < pixels; ++pixel) {
            std::copy_n(values + pixel * 4, output.channels,
                        plane.values.data() + pixel * static_cast<size_t>(output.channels));
        }
        planes.push_back(std::move(plane));
    }
    return planes;
}

} // namespace crossray
