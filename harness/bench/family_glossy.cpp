// Glossy mapping: which mip level of a probe stands for a roughness, by the Built-in pipeline's parabola and by what
// that stands for, in chains of two kinds and of several capture sizes.
#include "harness/bench/family.h"

#include "harness/base/temporary_folder.h"
#include "harness/bench/gloss_reference.h"
#include "harness/compile/spirv_module.h"
#include "harness/expect/captures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>

namespace crossray {

namespace {

constexpr std::array kCaptureSizes{16, 32, 64, 128, 256};
constexpr int kFilteredSize = 128;
constexpr int kReferenceSamples = 8192;
constexpr double kReads = 10; // depth, normal, and 8 texels of the probe

// What is seen from the capture position, as if all were far away: the mapping is measured, and not the parallax.
RadianceByDirection surroundingsOf(const Case& testCase)
{
    const Scene scene = makeOpaqueScene(testCase.scene);
    const glm::dvec3 from = testCase.probes.front().capturePosition;
    // The mirror that looks is no part of what it sees.
    Scene around = scene;
    std::erase_if(around.primitives, [](const Primitive& primitive) { return primitive.material == "mirror"; });
    return [around, from](const glm::dvec3& dirWS) {
        const auto hit = castRay(around, {from, dirWS});
        return hit ? computeRadiance(around, *hit) : computeSkyRadiance(around, dirWS);
    };
}

void requireProbe(const Case& testCase)
{
    const bool isBuiltIn = testCase.probes.size() == 1 && testCase.probeProfile == ProbeProfile::kBuiltIn &&
                           !testCase.probes.front().boxProjection;
    const bool isAnalytic = testCase.effect == TraceEffect::kReflection && !testCase.recorded;
    if (isBuiltIn && isAnalytic) return;
    throw InputError(testCase.position,
                     "bench = \"glossy\" asks for a reflection with one [[probe]] of the profile builtin, "
                     "without box projection; that alone is allowed");
}

// A cubemap as a file, made when it is first asked for.
struct ChainFile {
    TemporaryFolder folder{"glossy"};
    bool isWritten = false;
    std::filesystem::path path() const { return folder.path() / "probe.exr"; }
    void write(const Cubemap& cubemap)
    {
        writeCubemap(path(), cubemap);
        isWritten = true;
    }
};

// Rendered by one ray a texel, its levels means of four texels.
Cubemap captureMeans(const RadianceByDirection& radiance, int size)
{
    Cubemap cubemap(size, 1);
    for (int face = 0; face < kCubeFaces; ++face)
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x)
                cubemap.at(0, face, x, y) =
                    radiance(computeCubeDirection(face, (glm::dvec2(x, y) + 0.5) / static_cast<double>(size)));
    buildMipLevels(cubemap);
    return cubemap;
}

struct Chain {
    std::string name;
    int size = 0;
    bool isFiltered = false;
};

std::vector<Chain> allChains()
{
    std::vector<Chain> chains;
    for (const int size : kCaptureSizes)
        chains.push_back({fmt::format("means, {}", size), size, false});
    chains.push_back({fmt::format("lobes, {}", kFilteredSize), kFilteredSize, true});
    return chains;
}

std::vector<BenchMethod> makeMethods(const Case& testCase)
{
    requireProbe(testCase);
    std::vector<BenchMethod> methods;
    for (const Chain& chain : allChains()) {
        const auto file = std::make_shared<ChainFile>();
        for (const bool isExact : {false, true}) {
            const std::string kind = isExact ? "exact" : "approximate";
            BenchMethod method{kind + ", " + chain.name, kind, [=](Case& varied) {
                                   if (!file->isWritten) {
                                       const RadianceByDirection around = surroundingsOf(varied);
                                       file->write(chain.isFiltered ? filterByLobes(around, chain.size).cubemap
                                                                    : captureMeans(around, chain.size));
                                   }
                                   varied.hierarchy = kTierProbes;
                                   varied.profile.exactMip = isExact;
                                   varied.probes.front().environment = {CubemapFile{file->path()}, chain.size};
                               }};
            method.captureSize = chain.size;
            methods.push_back(std::move(method));
        }
    }
    return methods;
}

// What each traced pixel shows by either lobe.
struct Reference {
    std::vector<glm::dvec3> ggx, blinnPhong;
};

std::shared_ptr<const void> prepare(const CaseData& data)
{
    auto reference = std::make_shared<Reference>();
    const RadianceByDirection around = surroundingsOf(data.testCase());
    const double roughness = data.testCase().material.roughness;
    for (size_t pixel = 0; pixel < data.tracedPixels().size(); ++pixel) {
        reference->ggx.emplace_back(0.0);
        reference->blinnPhong.emplace_back(0.0);
        if (!data.tracedPixels()[pixel]) continue;
        const SurfacePoint& surface = data.surfaces()[pixel];
        const auto integrate = [&](GlossLobe lobe) {
            return integrateGloss(around, surface.normalWS, surface.toEyeWS, roughness, lobe, kReferenceSamples);
        };
        reference->ggx.back() = integrate(GlossLobe::kGgx);
        reference->blinnPhong.back() = integrate(GlossLobe::kBlinnPhong);
    }
    return reference;
}

double meanError(const FamilyRun& run, const std::vector<glm::dvec3>& expected)
{
    const Plane& colors = run.plane("Color");
    double sum = 0, count = 0;
    for (size_t pixel = 0; pixel < expected.size(); ++pixel) {
        if (!run.data.tracedPixels()[pixel]) continue;
        for (int c = 0; c < 3; ++c)
            sum += std::abs(colors.values[3 * pixel + static_cast<size_t>(c)] - expected[pixel][c]) / 3;
        count += 1;
    }
    return count > 0 ? sum / count : 0;
}

// Radiances that are rendered for a chain, and texels that its levels are made of.
double countMaking(const Chain& chain)
{
    const double finest = kCubeFaces * static_cast<double>(chain.size) * chain.size;
    if (!chain.isFiltered) return finest + 4 * (finest - kCubeFaces) / 3; // four texels for each of a coarser level
    const auto nothing = [](const glm::dvec3&) { return glm::dvec3(0.0); };
    return filterByLobes(nothing, chain.size).samplesTaken;
}

void judge(const FamilyRun& run, BenchPoint& point)
{
    const auto& reference = *static_cast<const Reference*>(run.prepared);
    point.errors["Color"] = meanError(run, reference.ggx);
    point.errors["ColorBlinnPhong"] = meanError(run, reference.blinnPhong);
    point.counters["Reads"] = kReads;
    point.counters["Instructions"] = static_cast<double>(countSpirvInstructions(run.job.programs.back().spirv));
    for (const Chain& chain : allChains()) {
        if (point.method.ends_with(chain.name)) point.counters["Making"] = countMaking(chain);
    }
}

std::string withoutParameters(const std::string& name)
{
    return name.substr(0, name.find('['));
}

// Means over the roughnesses of one scene, by method.
std::map<std::string, BenchPoint> averagePoints(const std::vector<const BenchScene*>& scenes)
{
    std::map<std::string, BenchPoint> sums;
    const auto count = static_cast<double>(scenes.size());
    for (const BenchScene* scene : scenes) {
        for (const BenchPoint& point : scene->points) {
            BenchPoint& sum = sums[point.method];
            sum.method = point.method;
            sum.counters = point.counters;
            for (const auto& [name, value] : point.errors)
                sum.errors[name] += value / count;
            sum.time.ratio += point.time.ratio / count;
        }
    }
    return sums;
}

std::vector<Chart> chartScene(const std::string& name, std::vector<const BenchScene*> scenes, const std::string& device)
{
    std::sort(scenes.begin(), scenes.end(),
              [](const BenchScene* a, const BenchScene* b) { return a->parameter < b->parameter; });
    const std::string id = "glossy_" + chartIdOf(shortNameOf(name));
    const char* const error = "mean error of the colour against the GGX integral";
    Chart curves{id + "_roughness", "Glossy mapping: " + name, "perceptual roughness", error, {}, true};
    for (const BenchScene* scene : scenes) {
        for (const BenchPoint& point : scene->points) {
            const bool isShown =
                point.method.ends_with(" 16") || point.method.ends_with(" 64") || point.method.ends_with("lobes, 128");
            if (isShown && scene->parameter > 0)
                curves.points.push_back({point.method, scene->parameter, point.errors.at("Color")});
        }
    }
    Chart making{id + "_making",
                 "Glossy mapping: " + name,
                 "radiances and texels that making the chain takes",
                 "mean error of the colour over all roughnesses",
                 {}};
    Chart time{id + "_time",
               "Glossy mapping: " + name,
               "time, rendering at its floor, over that of reading the G-buffer and writing the outputs (" + device +
                   ")",
               making.errorLabel,
               {}};
    for (const auto& [method, point] : averagePoints(scenes)) {
        making.points.push_back({method, point.counters.at("Making"), point.errors.at("Color")});
        time.points.push_back({method, point.time.ratio, point.errors.at("Color")});
    }
    return {curves, making, time};
}

std::vector<Chart> makeCharts(std::span<const BenchScene* const> scenes, const std::string& device)
{
    std::map<std::string, std::vector<const BenchScene*>> byName;
    for (const BenchScene* scene : scenes)
        byName[withoutParameters(scene->name)].push_back(scene);
    std::vector<Chart> charts;
    for (const auto& [name, group] : byName) {
        const std::vector<Chart> made = chartScene(name, group, device);
        charts.insert(charts.end(), made.begin(), made.end());
    }
    return charts;
}

} // namespace

const BenchFamily& glossyMappings()
{
    static const BenchFamily family{.name = "glossy",
                                    .outputs = {"Color", "ProbeMipLevel"},
                                    .errors = {"Color", "ColorBlinnPhong"},
                                    .counters = {"Reads", "Instructions", "Making"},
                                    .makeMethods = makeMethods,
                                    .prepare = prepare,
                                    .judge = judge,
                                    .makeCharts = makeCharts,
                                    .costs = {"Making", "Instructions"}};
    return family;
}

} // namespace crossray
