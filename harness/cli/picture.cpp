#include "harness/cli/picture.h"

#include "harness/base/outputs.h"
#include "harness/compile/compile.h"
#include "harness/pass/pass.h"
#include "harness/run/execute.h"
#include "harness/run/plane_files.h"
#include "harness/run/steps.h"
#include "harness/run/worker_pool.h"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace crossray {

double encodeSrgb(double linear)
{
    const double value = std::clamp(linear, 0.0, 1.0);
    return value <= 0.0031308 ? value * 12.92 : 1.055 * std::pow(value, 1.0 / 2.4) - 0.055;
}

namespace {

using Rgb = glm::dvec3;

Rgb colorOfClass(int hitClass)
{
    switch (static_cast<HitClass>(hitClass)) {
    case HitClass::kHit:
        return {0.5, 1.0, 0.5};
    case HitClass::kMiss:
        return {0.5, 0.5, 1.0};
    case HitClass::kUnknown:
        return {0.9, 0.6, 0.3};
    case HitClass::kNoRaycast:
        break;
    }
    return Rgb(0.08);
}

Rgb encodePixel(OutputType type, const Plane& plane, int x, int y, double largest)
{
    Rgb value(plane.at(x, y, 0));
    for (int channel = 1; channel < std::min(plane.channels, 3); ++channel)
        value[channel] = plane.at(x, y, channel);
    if (plane.channels == 2) value.z = 0.0;
    switch (type) {
    case OutputType::kDirection:
        return glm::dot(value, value) > 0.0 ? value * 0.5 + 0.5 : Rgb(0.0);
    case OutputType::kDepth:
        return glm::fract(value * 0.1);
    case OutputType::kHitClass:
        return colorOfClass(static_cast<int>(value.x));
    case OutputType::kCount:
        return largest > 0.0 ? value / largest : value;
    case OutputType::kColor:
        return {encodeSrgb(value.x), encodeSrgb(value.y), encodeSrgb(value.z)};
    case OutputType::kScalar:
        break;
    }
    return glm::clamp(value, 0.0, 1.0);
}

} // namespace

Panel encodePanel(const Plane& plane)
{
    const auto info = findOutput(plane.name);
    const OutputType type = info ? info->type : OutputType::kColor;
    double largest = 0.0;
    for (const double value : plane.values)
        largest = std::isfinite(value) ? std::max(largest, value) : largest;

    Panel panel{plane.name, plane.width, plane.height, {}};
    panel.rgb.reserve(plane.pixelCount() * 3);
    for (int y = 0; y < plane.height; ++y) {
        for (int x = 0; x < plane.width; ++x) {
            bool isNan = false, isInfinite = false;
            for (int channel = 0; channel < plane.channels; ++channel) {
                isNan = isNan || std::isnan(plane.at(x, y, channel));
                isInfinite = isInfinite || std::isinf(plane.at(x, y, channel));
            }
            Rgb color = isNan || isInfinite ? Rgb(1.0, isNan ? 0.0 : 1.0, isNan ? 1.0 : 0.0)
                                            : encodePixel(type, plane, x, y, largest);
            for (int channel = 0; channel < 3; ++channel) {
                panel.rgb.push_back(
                    static_cast<unsigned char>(std::lround(std::clamp(color[channel], 0.0, 1.0) * 255)));
            }
        }
    }
    return panel;
}

Picture composePicture(std::span<const Panel> panels, int columns, int panelWidth)
{
    constexpr int kGap = 6;
    constexpr unsigned char kBackground = 40;
    if (panels.empty()) throw InputError("a picture needs at least one panel");
    const int scale = std::max(1, (panelWidth + panels[0].width - 1) / panels[0].width);
    const int cellWidth = panels[0].width * scale + kGap;
    const int cellHeight = panels[0].height * scale + kGap;
    const int rows = (static_cast<int>(panels.size()) + columns - 1) / columns;
    Picture picture;
    picture.columns = std::min(columns, static_cast<int>(panels.size()));
    picture.width = cellWidth * picture.columns + kGap;
    picture.height = cellHeight * rows + kGap;
    picture.rgb.assign(static_cast<size_t>(picture.width) * static_cast<size_t>(picture.height) * 3, kBackground);
    for (size_t index = 0; index < panels.size(); ++index) {
        const Panel& panel = panels[index];
        picture.names.push_back(panel.name);
        const int left = kGap + cellWidth * (static_cast<int>(index) % columns);
        const int top = kGap + cellHeight * (static_cast<int>(index) / columns);
        for (int y = 0; y < panel.height * scale; ++y) {
            for (int x = 0; x < panel.width * scale; ++x) {
                const auto source = static_cast<size_t>((y / scale) * panel.width + x / scale) * 3;
                const auto target = (static_cast<size_t>(top + y) * static_cast<size_t>(picture.width) +
                                     static_cast<size_t>(left + x)) *
                                    3;
                std::copy_n(panel.rgb.begin() + static_cast<std::ptrdiff_t>(source), 3,
                            picture.rgb.begin() + static_cast<std::ptrdiff_t>(target));
            }
        }
    }
    return picture;
}

std::string encodePng(const Picture& picture)
{
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(picture.width);
    image.height = static_cast<png_uint_32>(picture.height);
    image.format = PNG_FORMAT_RGB;
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
    std::string bytes(size, '\0');
    if (!png_image_write_to_memory(&image, bytes.data(), &size, 0, picture.rgb.data(), 0, nullptr)) {
        throw InputError(
            fmt::format("a picture of {}x{} cannot be written: {}", picture.width, picture.height, image.message));
    }
    bytes.resize(size);
    return bytes;
}

void writePng(const std::filesystem::path& file, const Picture& picture)
{
    writeFileWhole(file, encodePng(picture));
}

namespace {

// What the camera shows: the scene, and on the pixels that trace what their rays found.
Panel drawFrame(const CaseData& data, const Plane& color)
{
    Plane frame = data.gbuffer().plane(GBufferChannel::kColor);
    frame.name = "Color";
    for (size_t pixel = 0; pixel < frame.pixelCount(); ++pixel) {
        if (!data.tracedPixels()[pixel]) continue;
        for (size_t channel = 0; channel < 3; ++channel)
            frame.values[pixel * static_cast<size_t>(frame.channels) + channel] = color.values[pixel * 3 + channel];
    }
    Panel panel = encodePanel(frame);
    panel.name = "frame";
    return panel;
}

// Those panels that are named, in the order of the names; all where none is. Throws InputError.
std::vector<Panel> choosePanels(std::vector<Panel> panels, std::span<const std::string> names)
{
    if (names.empty()) return panels;
    std::vector<Panel> chosen;
    for (const std::string& name : names) {
        const auto found =
            std::find_if(panels.begin(), panels.end(), [&](const Panel& panel) { return panel.name == name; });
        if (found == panels.end()) {
            std::string allowed;
            for (const Panel& panel : panels)
                allowed += (allowed.empty() ? "" : ", ") + panel.name;
            throw InputError(fmt::format("no panel \"{}\" in the picture of this case, allowed are {}", name, allowed));
        }
        chosen.push_back(*found);
    }
    return chosen;
}

constexpr int kPanelWidth = 320;

// What one backend answers, and the data that it was asked with.
struct DrawnAnswer {
    std::shared_ptr<const CaseData> data;
    std::vector<Plane> planes;
};

DrawnAnswer askBackend(const Case& drawn, const std::string& backend, const Folders& folders)
{
    WorkerOptions options;
    options.mesaCacheFolder = folders.cache / "mesa";
    WorkerPool pool(options);
    ShaderCompiler compiler(folders.cache / "spirv");
    const std::string backends[] = {backend};
    const ExecuteSteps steps = makeSteps(pool, compiler, folders.shaders, backends);
    const bool doubles = usesDoubles(backend);
    const PreparedCase prepared = steps.prepare(drawn, !doubles, doubles);
    const JobReport report = steps.run(backend, 0, doubles ? *prepared.doubleJob : *prepared.floatJob,
                                       std::chrono::duration<double>(drawn.timeoutSeconds));
    if (report.outcome != JobOutcome::kDone) throw EnvironmentError(fmt::format("{}: {}", backend, report.text));
    return {prepared.data, steps.readPlanes(prepared.data->testCase(), report.result)};
}

} // namespace

Picture drawCase(const Case& testCase, const std::string& backend, const Folders& folders,
                 std::span<const std::string> names)
{
    Case drawn = testCase;
    drawn.outputs.clear();
    const bool casts = drawn.projection.model != ProjectionModel::kNone;
    const bool lights = drawn.hierarchy != 0;
    for (const char* name :
         {"Color", "RayDirWS", "HitSuccess", "HitDepth", "SampledColor", "HitWeight", "TierWeights"}) {
        const std::string_view output = name;
        const bool ofHierarchy = output == "Color" || output == "TierWeights";
        if (output == "RayDirWS" || (ofHierarchy ? lights : casts)) drawn.outputs.push_back(*findOutput(name));
    }

    const DrawnAnswer answer = askBackend(drawn, backend, folders);
    std::vector<Panel> panels;
    if (answer.data->gbuffer().planes.contains(GBufferChannel::kColor)) {
        panels.push_back(encodePanel(answer.data->gbuffer().plane(GBufferChannel::kColor)));
        panels.back().name = "scene";
    }
    for (const Plane& plane : answer.planes) {
        panels.push_back(encodePanel(plane));
        if (plane.name != "Color") continue;
        const Panel frame = drawFrame(*answer.data, plane);
        panels.insert(panels.begin(), frame);
    }
    panels = choosePanels(std::move(panels), names);
    constexpr int kColumns = 3;
    return composePicture(panels, kColumns, kPanelWidth);
}

Picture drawDebugMode(const Case& testCase, const DebugMode& mode, const std::string& backend, const Folders& folders)
{
    requireRecorded(mode, testCase);
    Case drawn = testCase;
    drawn.outputs = {*findOutput(mode.output.empty() ? "SampledColor" : mode.output)};
    const DrawnAnswer answer = askBackend(drawn, backend, folders);
    const bool isScene = mode.output.empty();
    if (isScene && !answer.data->gbuffer().planes.contains(GBufferChannel::kColor)) {
        throw InputError(fmt::format("{}: its G-buffer has no colour to draw", testCase.name));
    }
    const Plane& plane = isScene ? answer.data->gbuffer().plane(GBufferChannel::kColor) : answer.planes.front();
    // Radiance is linear, a picture is sRGB; the other encodings are colours already.
    const bool isRadiance = mode.encoding == Encoding::kColor;
    Panel panel{std::string(mode.name), plane.width, plane.height, {}};
    for (const EncodedColor& color : encodePlane(mode, plane, testCase)) {
        for (const double value : {color.r, color.g, color.b}) {
            const double shown = isRadiance ? encodeSrgb(value) : std::clamp(value, 0.0, 1.0);
            panel.rgb.push_back(static_cast<unsigned char>(std::lround(shown * 255)));
        }
    }
    const Panel panels[] = {panel};
    return composePicture(panels, 1, kPanelWidth);
}

} // namespace crossray
