// Refraction techniques: the same exact ray, and three ways to find what it shows.
#include "harness/bench/family.h"

#include "harness/base/temporary_folder.h"
#include "harness/bench/tracer_yardstick.h"
#include "harness/expect/captures.h"
#include "harness/expect/frame_history.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

namespace crossray {

namespace {

constexpr std::array kCaptureSizes{16, 32, 64, 128, 256};
constexpr double kSurfaceReads = 2; // depth and normal of the pixel itself
constexpr double kProbeReads = 8;   // texels of a look-up between two levels

// The probe whose capture the techniques vary: the case's first.
void requireProbe(const Case& testCase)
{
    const bool hasCapture =
        !testCase.probes.empty() && std::holds_alternative<SceneCapture>(testCase.probes.front().environment.content);
    if (testCase.effect == TraceEffect::kRefraction && hasCapture) return;
    throw InputError(testCase.position,
                     "bench = \"refraction_techniques\" asks for a refraction whose first [[probe]] has a "
                     "capture; that alone is allowed");
}

// What was baked: the scene as it stood then, which [history] says.
Cubemap bake(const Case& testCase, int size)
{
    Case then = testCase;
    if (testCase.history) then.scene = makePreviousScene(testCase);
    then.probes.front().environment.size = size;
    return captureProbe(then, then.probes.front());
}

// A method that reads a cubemap baked in this size. The file is written when it is first asked for.
struct BakedFile {
    TemporaryFolder folder{"baked"};
    bool isWritten = false;
    std::filesystem::path of(const Case& testCase, int size)
    {
        const std::filesystem::path file = folder.path() / "probe.exr";
        if (!isWritten) writeCubemap(file, bake(testCase, size));
        isWritten = true;
        return file;
    }
};

void useProbe(Case& varied)
{
    varied.history.reset(); // it has said what was baked
    varied.hierarchy = kTierProbes | kTierSky;
    varied.projection.model = ProjectionModel::kNone;
}

void useScreen(Case& varied, ProjectionModel model)
{
    varied.history.reset(); // the colour is this frame's
    varied.hierarchy = kTierScreen | kTierSky;
    varied.projection.model = model;
    varied.projection.hiz.minLevel = 0;
    varied.projection.hiz.maxLevel = 6;
    varied.projection.hiz.maxIterations = varied.projection.patches.maxIterations = 512;
}

std::vector<BenchMethod> makeMethods(const Case& testCase)
{
    requireProbe(testCase);
    std::vector<BenchMethod> methods;
    for (const int size : {64, 256}) {
        methods.push_back(
            {fmt::format("baked probe, {}", size), "baked", [size, file = std::make_shared<BakedFile>()](Case& varied) {
                 const std::filesystem::path baked = file->of(varied, size);
                 useProbe(varied);
                 varied.probes.front().environment = {CubemapFile{baked}, size};
             }});
    }
    methods.push_back({"screen, HiZ", "screen", [](Case& varied) { useScreen(varied, ProjectionModel::kHiz); }});
    methods.push_back(
        {"screen, patches", "screen", [](Case& varied) { useScreen(varied, ProjectionModel::kPatches); }});
    methods.push_back(
        {"screen, patches, then baked probe, 256", "screen", [file = std::make_shared<BakedFile>()](Case& varied) {
             const std::filesystem::path baked = file->of(varied, 256);
             useScreen(varied, ProjectionModel::kPatches);
             varied.hierarchy |= kTierProbes;
             varied.probes.front().environment = {CubemapFile{baked}, 256};
         }});
    for (const int size : kCaptureSizes) {
        BenchMethod method{fmt::format("real-time probe, {}", size), "realtime", [size](Case& varied) {
                               useProbe(varied);
                               Environment& environment = varied.probes.front().environment;
                               std::get<SceneCapture>(environment.content).mode = SceneCapture::Mode::kRealtime;
                               environment.size = size;
                           }};
        method.captureSize = size;
        methods.push_back(std::move(method));
    }
    return methods;
}

// Texels of all levels, each a quarter of the one before, down to one.
double countChain(double width, double height)
{
    double count = width * height;
    while (width > 1 || height > 1) {
        width = std::max(1.0, std::ceil(0.5 * width));
        height = std::max(1.0, std::ceil(0.5 * height));
        count += width * height;
    }
    return count;
}

void countCosts(const FamilyRun& run, double rays, BenchPoint& point)
{
    const double pixels = static_cast<double>(run.varied.camera.width) * run.varied.camera.height;
    double reads = kSurfaceReads, rendered = 0;
    if ((run.varied.hierarchy & kTierScreen) != 0) {
        // The same shaders on the CPU, from where the light leaves the solid.
        const YardstickScene scene = makeYardstickScene(CaseData(run.varied));
        const auto tracer = caseTracer(run.varied.projection, scene);
        double claimed = 0;
        for (const YardstickRay& ray : scene.rays) {
            const TracerAnswer answer = (*tracer)(ray);
            reads += answer.fetches / rays;
            claimed += answer.isHit;
        }
        reads += claimed / rays; // the colour
        rendered += countChain(run.varied.camera.width, run.varied.camera.height);
    }
    if ((run.varied.hierarchy & kTierProbes) != 0) {
        // Beside the screen it is read where that leaves something.
        const Plane& weights = run.plane("TierWeights");
        double asked = 0;
        for (int y = 0; y < weights.height; ++y)
            for (int x = 0; x < weights.width; ++x)
                asked += weights.at(x, y, 1) > 0;
        reads += kProbeReads * asked / rays;
    }
    const double size = run.method.captureSize;
    rendered += size > 0 ? kCubeFaces * countChain(size, size) : 0;
    point.counters["Reads"] = reads;
    point.counters["Rendered"] = rendered / rays;
    point.counters["Cost"] = reads + rendered / rays;
    point.counters["FrameShare"] = 1 + kCubeFaces * size * size / pixels;
}

void judge(const FamilyRun& run, BenchPoint& point)
{
    const Truth& truth = run.data.truth();
    const Plane& colors = run.plane("Color");
    std::vector<double> errors;
    for (int y = 0; y < truth.height; ++y) {
        for (int x = 0; x < truth.width; ++x) {
            const TruthPixel& pixel = truth.at(x, y);
            if (pixel.screen == ScreenKnowledge::kNoRay) continue;
            double sum = 0;
            for (int c = 0; c < 3; ++c)
                sum += std::abs(colors.at(x, y, c) - pixel.radiance[c]) / 3;
            errors.push_back(sum);
        }
    }
    const auto rays = static_cast<double>(errors.size());
    double mean = 0;
    for (const double error : errors)
        mean += error / rays;
    std::sort(errors.begin(), errors.end());
    point.errors["Color"] = mean;
    point.errors["ColorP95"] = errors.empty() ? 0 : errors[errors.size() * 95 / 100];
    countCosts(run, rays, point);
}

std::vector<Chart> makeCharts(std::span<const BenchScene* const> scenes, const std::string& device)
{
    struct Axis {
        const char* id;
        std::string label;
        double (*cost)(const BenchPoint&);
    };
    const std::array<Axis, 3> axes{
        {{"cost", "reads, and texels and cells rendered for it each frame, a ray",
          [](const BenchPoint& point) { return point.counters.at("Cost"); }},
         {"frame", "texels rendered each frame over those of the frame itself",
          [](const BenchPoint& point) { return point.counters.at("FrameShare"); }},
         {"time", "time over that of reading the G-buffer and writing the outputs (" + device + ")",
          [](const BenchPoint& point) { return point.time.ratio; }}}};
    std::vector<Chart> charts;
    for (const BenchScene* scene : scenes) {
        const std::string id = chartIdOf(shortNameOf(scene->name));
        for (const Axis& axis : axes) {
            Chart chart{"refraction_techniques_" + id + "_" + axis.id,
                        "Refraction technique: " + scene->name,
                        axis.label,
                        "mean error of the colour, linear radiance",
                        {}};
            for (const BenchPoint& point : scene->points)
                chart.points.push_back({point.method, axis.cost(point), point.errors.at("Color")});
            charts.push_back(std::move(chart));
        }
    }
    return charts;
}

} // namespace

const BenchFamily& refractionTechniques()
{
    static const BenchFamily family{.name = "refraction_techniques",
                                    .outputs = {"Color", "TierWeights"},
                                    .errors = {"Color", "ColorP95"},
                                    .counters = {"Reads", "Rendered", "Cost", "FrameShare"},
                                    .makeMethods = makeMethods,
                                    .judge = judge,
                                    .makeCharts = makeCharts,
                                    .costs = {"Cost"}};
    return family;
}

} // namespace crossray
