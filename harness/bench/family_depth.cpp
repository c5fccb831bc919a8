// Depth formats: what 16, 24 and 32 bits leave of a position, and what tracers make of it, in both directions of depth.
#include "harness/bench/family.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace crossray {

namespace {

struct Format {
    DepthConvention convention;
    DepthFormat format;
    int bits;
    std::string name;
};

const std::vector<Format>& allFormats()
{
    static const std::vector<Format> formats = [] {
        std::vector<Format> all;
        for (const auto& [format, bits] : {std::pair{DepthFormat::kUnorm16, 16}, std::pair{DepthFormat::kUnorm24, 24},
                                           std::pair{DepthFormat::kFloat32, 32}}) {
            all.push_back({DepthConvention::kStandard, format, bits, fmt::format("standard {}", bits)});
            all.push_back({DepthConvention::kReversed, format, bits, fmt::format("reversed {}", bits)});
        }
        return all;
    }();
    return formats;
}

void applyFormat(Case& varied, const Format& format)
{
    varied.camera.depthConvention = format.convention;
    varied.camera.depthFormat = format.format;
    varied.projection.patches.depthError = computeAffineDepthError(varied.camera);
}

std::vector<BenchMethod> makeMethods(const Case& testCase)
{
    if (testCase.effect != TraceEffect::kReflection || testCase.recorded || testCase.history) {
        throw InputError(testCase.position,
                         "bench = \"depth_formats\" asks for reflections in an analytic scene without a "
                         "[history]; that alone is allowed");
    }
    std::vector<BenchMethod> methods;
    for (const Format& format : allFormats()) {
        methods.push_back({format.name + ", patches", fmt::format("depth{}", format.bits), [format](Case& varied) {
                               varied.projection.model = ProjectionModel::kPatches;
                               varied.projection.patches.maxIterations = 512;
                               applyFormat(varied, format);
                           }});
        methods.push_back({format.name + ", HiZ", fmt::format("depth{}", format.bits), [format](Case& varied) {
                               varied.projection.model = ProjectionModel::kHiz;
                               varied.projection.hiz = {0, 6, 512, varied.projection.hiz.depthBias};
                               applyFormat(varied, format);
                           }});
    }
    return methods;
}

double atShare(const std::vector<double>& sorted, double share)
{
    if (sorted.empty()) return 0;
    return sorted[std::min(sorted.size() - 1, static_cast<size_t>(share * static_cast<double>(sorted.size())))];
}

void judge(const FamilyRun& run, BenchPoint& point)
{
    const Truth& truth = run.data.truth();
    const Plane& origins = run.plane("RayOriginWS");
    std::vector<double> errors;
    const glm::dvec3 eye(run.data.testCase().camera.worldFromView[3]);
    for (int y = 0; y < truth.height; ++y) {
        for (int x = 0; x < truth.width; ++x) {
            const TruthPixel& pixel = truth.at(x, y);
            if (pixel.screen == ScreenKnowledge::kNoRay) continue;
            const glm::dvec3 found(origins.at(x, y, 0), origins.at(x, y, 1), origins.at(x, y, 2));
            errors.push_back(glm::length(found - pixel.rayOriginWS) / glm::length(pixel.rayOriginWS - eye));
        }
    }
    std::sort(errors.begin(), errors.end());
    point.errors["Position"] = atShare(errors, 0.5);
    point.errors["PositionP95"] = atShare(errors, 0.95);
    for (const Format& format : allFormats()) {
        if (point.method.starts_with(format.name)) point.counters["Bits"] = format.bits;
    }
}

std::vector<Chart> makeCharts(std::span<const BenchScene* const> scenes, const std::string& device)
{
    struct Axis {
        const char* id;
        const char* error;
        std::string label;
        std::string costLabel;
        double (*cost)(const BenchPoint&);
    };
    const auto bits = [](const BenchPoint& point) { return point.counters.at("Bits"); };
    const std::array<Axis, 4> axes{
        {{"position", "Position", "position read back, median error over its distance", "bits of a depth", bits},
         {"wrong", "Wrong", "share of all rays that are answered wrongly", "reads of the pyramid, a ray",
          [](const BenchPoint& point) { return point.counters.at("Fetches"); }},
         {"hit_depth", "HitDepth", "HitDepth, mean relative error, 1 where there is no answer", "bits of a depth",
          bits},
         {"time", "Wrong", "share of all rays that are answered wrongly",
          "time over that of reading the G-buffer and writing the outputs (" + device + ")",
          [](const BenchPoint& point) { return point.time.ratio; }}}};
    std::vector<Chart> charts;
    for (const BenchScene* scene : scenes) {
        const std::string id = chartIdOf(shortNameOf(scene->name));
        for (const Axis& axis : axes) {
            Chart chart{
                "depth_formats_" + id + "_" + axis.id, "Depth format: " + scene->name, axis.costLabel, axis.label, {}};
            const bool isOfFormats = std::string_view(axis.error) == "Position"; // the tracer has no part in it
            for (const BenchPoint& point : scene->points) {
                if (isOfFormats && !point.method.ends_with(", patches")) continue;
                const std::string name = isOfFormats ? point.method.substr(0, point.method.find(',')) : point.method;
                chart.points.push_back({name, axis.cost(point), point.errors.at(axis.error)});
            }
            charts.push_back(std::move(chart));
        }
    }
    return charts;
}

} // namespace

const BenchFamily& depthFormats()
{
    static const BenchFamily family{
        .name = "depth_formats",
        .outputs = {"RayDirWS", "HitDepth", "HitSuccess", "IterationCount", "HitPositionSS", "RayOriginWS"},
        .errors = {"Position", "PositionP95", "Wrong", "Missed", "False", "HitDepth", "HitPositionSS"},
        .counters = {"Bits", "Fetches", "FetchesOf32", "Iterations"},
        .judgesHits = true,
        .makeMethods = makeMethods,
        .judge = judge,
        .makeCharts = makeCharts,
        .costs = {"Bits", "Fetches"}};
    return family;
}

} // namespace crossray
