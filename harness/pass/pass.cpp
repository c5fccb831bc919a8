#include "harness/pass/pass.h"

#include "harness/compile/confine.h"
#include "harness/compile/source.h"
#include "harness/compile/spirv_module.h"
#include "harness/pass/bindings.h"
#include "harness/pass/pass_params.h"
#include "harness/pass/pixel_record.h"
#include "harness/pass/planar_params.h"
#include "harness/pass/probe_params.h"
#include "harness/pass/trace_variant.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace crossray {

namespace {

constexpr uint32_t kGroupSize = 8;          // local size of the entry shaders, both ways
constexpr size_t kSurfaceLevelsPerPass = 4; // docs/tracer.md has what other numbers cost

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

ProgramSource compileEntry(ShaderCompiler& compiler, const std::filesystem::path& shaderRoot, const std::string& entry,
                           std::map<std::string, double> specialization, const std::filesystem::path& ownTracer = {})
{
    CompileOptions options;
    options.ownTracer = ownTracer;
    options.includeRoot = shaderRoot;
    options.specialization = std::move(specialization);
    CompiledShader compiled = compiler.compile(shaderRoot / entry, options);
    return {entry,        options.specialization,     std::move(compiled.spirv), std::move(compiled.glsl),
            compiled.key, std::move(compiled.closure)};
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

    void addDepthPyramid(ShaderCompiler& compiler, const std::filesystem::path& shaderRoot, const Binding& depth)
    {
        pyramid_ = addPyramid(
            kPyramidBinding, 2, depth,
            compileEntry(compiler, shaderRoot, "entry/depth_pyramid.comp",
                         {{"kOrthographic", isOrthographic() ? 1 : 0}, {"kReversedDepth", isReversed() ? 1 : 0}}));
    }

    // The previous frame's colour, level by level, and the motion since.
    void addHistory(ShaderCompiler& compiler, const std::filesystem::path& shaderRoot)
    {
        const FrameHistory& history = *data_.history();
        const Binding color = addImage(kHistoryColorBinding, imageFromPlane(history.color));
        traceBindings_.push_back(addPyramid(kColorPyramidBinding, 4, color,
                                            compileEntry(compiler, shaderRoot, "entry/color_pyramid.comp", {})));
        if (data_.testCase().history->reprojection == Reprojection::kMotionVectors)
            traceBindings_.push_back(addImage(kMotionBinding, imageFromPlane(history.motion)));
    }

    // The pyramid of planes: the same levels, from depth and normal.
    void addSurfacePyramid(ShaderCompiler& compiler, const std::filesystem::path& shaderRoot, const Binding& depth,
                           const Binding& normal)
    {
        const size_t cells = static_cast<size_t>(levels_.back().firstCell) + 1;
        pyramid_ = addBuffer(kSurfaceBinding, storageBuffer(cells * 4));
        // Level 0 asks what kind of view it is; the others only ask where their cells lie.
        job_.programs.push_back(
            compileEntry(compiler, shaderRoot, "entry/surface_pyramid.comp",
                         {{"kOrthographic", isOrthographic() ? 1 : 0}, {"kReversedDepth", isReversed() ? 1 : 0}}));
        for (size_t first = 0; first < levels_.size(); first += kSurfaceLevelsPerPass) {
            const size_t last = std::min(first + kSurfaceLevelsPerPass, levels_.size()) - 1;
            const Binding params = addBuffer(
                kParamsBinding, uniformBuffer(makeSurfaceParams(data_.testCase(), levels_, first, last, precision_)));
            job_.dispatches.push_back({job_.programs.size() - 1,
                                       {params, depth, normal, *pyramid_},
                                       groupsFor(levels_[last].width),
                                       groupsFor(levels_[last].height),
                                       1});
        }
    }

    // The program of the trace, which addTrace() adds. Returns whether it reads the depth pyramid: a person's own
    // tracer that does not has none built.
    bool compileTrace(ShaderCompiler& compiler, const std::filesystem::path& shaderRoot, bool isRecord)
    {
        const Case& testCase = data_.testCase();
        std::map<std::string, double> variant = makeTraceVariant(testCase);
        if (isRecord) variant["kRecordPixel"] = 1;
        trace_.isOwn = testCase.projection.model == ProjectionModel::kOwn;
        const char* const entry = trace_.isOwn ? "entry/own_trace.comp" : "entry/screen_trace.comp";
        trace_.program = compileEntry(compiler, shaderRoot, entry, std::move(variant), testCase.projection.own.tracer);
        return testCase.projection.model == ProjectionModel::kHiz ||
               (trace_.isOwn && findBindings(trace_.program.spirv).contains(kPyramidBinding));
    }

    // With a query the trace records that pixel, and writes no plane.
    void addTrace(const Binding& depth, const Binding& normal, const std::optional<PixelQuery>& query)
    {
        const Case& testCase = data_.testCase();
        std::vector<Binding> bindings = traceBindings_;
        bindings.push_back(depth);
        bindings.push_back(normal);
        if (const Plane* thickness = data_.thicknessMap())
            bindings.push_back(addImage(kThicknessBinding, imageFromPlane(*thickness)));
        bindings.push_back(
            addBuffer(kParamsBinding, uniformBuffer(makePassParams(testCase, levels_, precision_, query))));
        if (data_.screen().planes.contains(GBufferChannel::kColor)) {
            bindings.push_back(addImage(kColorBinding, imageFromPlane(data_.screen().plane(GBufferChannel::kColor))));
        }
        bindings.push_back(addImage(kMaskBinding, makeTraceMask()));
        if (pyramid_) bindings.push_back(*pyramid_);
        if (usesProbes(testCase)) {
            bindings.push_back(addBuffer(kProbeParamsBinding, uniformBuffer(makeProbeParams(data_, precision_))));
            bindings.push_back(addImage(kProbeAtlasBinding, makeProbeAtlas(data_)));
        }
        if (usesPlanarProbes(testCase)) {
            bindings.push_back(addBuffer(kPlanarParamsBinding, uniformBuffer(makePlanarParams(data_, precision_))));
            bindings.push_back(addImage(kPlanarAtlasBinding, makePlanarAtlas(data_)));
        }
        const size_t planeScalars = static_cast<size_t>(camera().width) * static_cast<size_t>(camera().height) * 4;
        bindings.push_back(query ? addBuffer(kRecordBinding, storageBuffer(countRecordScalars(query->stepCapacity)))
                                 : addBuffer(kOutputBinding, storageBuffer(planeScalars * testCase.outputs.size())));
        job_.readbacks.push_back(bindings.back().index);
        if (trace_.isOwn) {
            bindings.push_back(addBuffer(kOwnStatusBinding, storageBuffer(4)));
            if (!query) job_.readbacks.push_back(bindings.back().index);
        }
        job_.programs.push_back(std::move(trace_.program));
        job_.dispatches.push_back({job_.programs.size() - 1, std::move(bindings), query ? 1 : groupsFor(camera().width),
                                   query ? 1 : groupsFor(camera().height), 1});
    }

    Job take() { return std::move(job_); }

  private:
    // A buffer of cells and a dispatch a level, the finest from the image.
    Binding addPyramid(uint32_t binding, size_t scalarsPerCell, const Binding& image, ProgramSource program)
    {
        const size_t cells = static_cast<size_t>(levels_.back().firstCell) + 1;
        const Binding buffer = addBuffer(binding, storageBuffer(cells * scalarsPerCell));
        job_.programs.push_back(std::move(program));
        for (size_t level = 0; level < levels_.size(); ++level) {
            const Binding params = addBuffer(
                kParamsBinding, uniformBuffer(makePyramidParams(data_.testCase(), levels_, level, precision_)));
            job_.dispatches.push_back({job_.programs.size() - 1,
                                       {params, image, buffer},
                                       groupsFor(levels_[level].width),
                                       groupsFor(levels_[level].height),
                                       1});
        }
        return buffer;
    }

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
    struct {
        ProgramSource program;
        bool isOwn = false;
    } trace_;
    std::vector<Binding> traceBindings_; // what the trace reads beside the images of every case
    Job job_;
};

Job buildTraceJob(const CaseData& data, ShaderCompiler& compiler, const std::filesystem::path& shaderRoot,
                  Precision precision, const std::optional<PixelQuery>& query)
{
    JobBuilder builder(data, precision);
    const Binding depth =
        builder.addImage(kDepthBinding, imageFromPlane(data.gbuffer().plane(GBufferChannel::kDeviceDepth)));
    const Binding normal =
        builder.addImage(kNormalBinding, imageFromPlane(data.gbuffer().plane(GBufferChannel::kNormalWS)));
    // The pyramids are of what the screen shows, which may be less than the pixels' own surfaces.
    const auto imageOf = [&](uint32_t binding, GBufferChannel channel, const Binding& own) {
        const bool isSame = &data.screen() == &data.gbuffer();
        return isSame ? own : builder.addImage(binding, imageFromPlane(data.screen().plane(channel)));
    };
    const ProjectionModel model = data.testCase().projection.model;
    if (builder.compileTrace(compiler, shaderRoot, query.has_value())) {
        builder.addDepthPyramid(compiler, shaderRoot, imageOf(kDepthBinding, GBufferChannel::kDeviceDepth, depth));
    }
    if (model == ProjectionModel::kPatches) {
        const Binding shown = imageOf(kDepthBinding, GBufferChannel::kDeviceDepth, depth);
        builder.addSurfacePyramid(compiler, shaderRoot, shown,
                                  imageOf(kNormalBinding, GBufferChannel::kNormalWS, normal));
    }
    if (data.testCase().history) builder.addHistory(compiler, shaderRoot);
    builder.addTrace(depth, normal, query);
    return builder.take();
}

} // namespace

Job buildJob(const CaseData& data, ShaderCompiler& compiler, const std::filesystem::path& shaderRoot,
             Precision precision)
{
    return buildTraceJob(data, compiler, shaderRoot, precision, {});
}

Job buildRecordJob(const CaseData& data, ShaderCompiler& compiler, const std::filesystem::path& shaderRoot,
                   Precision precision, glm::ivec2 pixel, int stepCapacity)
{
    checkPixel(data.testCase().camera, pixel);
    return buildTraceJob(data, compiler, shaderRoot, precision, PixelQuery{pixel.x, pixel.y, stepCapacity});
}

void checkPixel(const Camera& camera, glm::ivec2 pixel)
{
    if (pixel.x < 0 || pixel.y < 0 || pixel.x >= camera.width || pixel.y >= camera.height) {
        throw InputError(fmt::format("pixel {},{} is outside the image of {} x {}; allowed are 0,0 to {},{}", pixel.x,
                                     pixel.y, camera.width, camera.height, camera.width - 1, camera.height - 1));
    }
}

namespace {

// A tracer's loop that did not end, as shaders/pass/own_tracer.glsl leaves word of it.
void refuseEndlessLoop(const Case& testCase, const std::vector<double>& status)
{
    if (status.size() != 4 || status[3] < 0.5) return;
    const SourcePosition place{displayPath(testCase.projection.own.tracer), static_cast<int>(status[0])};
    throw ShaderError(fmt::format("{}: error: the loop goes on and on: cut after {} rounds, at pixel {:.0f},{:.0f}",
                                  place.format(), kMostOwnRounds, status[1], status[2]));
}

} // namespace

std::vector<Plane> readPlanes(const Case& testCase, const JobResult& result)
{
    const size_t pixels = static_cast<size_t>(testCase.camera.width) * static_cast<size_t>(testCase.camera.height);
    const bool isOwn = testCase.projection.model == ProjectionModel::kOwn;
    if (isOwn && result.readbacks.size() == 2) refuseEndlessLoop(testCase, result.readbacks[1]);
    if (result.readbacks.size() != (isOwn ? 2 : 1) ||
        result.readbacks[0].size() != pixels * 4 * testCase.outputs.size()) {
        throw EnvironmentError(fmt::format("{}: the device returned {} values, expected {}", testCase.name,
                                           result.readbacks.empty() ? 0 : result.readbacks[0].size(),
                                           pixels * 4 * testCase.outputs.size()));
    }
    const uint32_t mask = makeOutputMask(testCase);
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
