#include "tests/fuzz/case_fuzzer.h"

#include "harness/pass/pass.h"
#include "harness/run/execute.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace crossray {

namespace {

constexpr double kMostFloat = std::numeric_limits<float>::max();
constexpr auto kPatience = std::chrono::seconds(60);

const Plane& planeOf(const std::vector<Plane>& planes, std::string_view name)
{
    return *std::find_if(planes.begin(), planes.end(), [&](const Plane& plane) { return plane.name == name; });
}

std::string placeOf(const Plane& plane, size_t index)
{
    const size_t pixel = index / static_cast<size_t>(plane.channels), width = static_cast<size_t>(plane.width);
    return fmt::format("({}, {})", pixel % width, pixel / width);
}

// The first value that fails, as a finding.
template <class Fails>
std::optional<Finding> findValue(const Plane& plane, const std::string& backend, FindingKind kind, const char* what,
                                 const Fails& fails)
{
    const auto at = std::find_if(plane.values.begin(), plane.values.end(), fails);
    if (at == plane.values.end()) return std::nullopt;
    const auto count = std::count_if(plane.values.begin(), plane.values.end(), fails);
    const auto index = static_cast<size_t>(at - plane.values.begin());
    return Finding{
        kind, backend, plane.name,
        fmt::format("{} on {}: {} at {}, {} values {}", plane.name, backend, *at, placeOf(plane, index), count, what),
        0};
}

// What is a share of one, or of light.
bool isShare(std::string_view output)
{
    constexpr std::string_view kShares[] = {"HitWeight", "TierWeights", "ProbeWeights", "Confidence", "Transmittance"};
    return std::find(std::begin(kShares), std::end(kShares), output) != std::end(kShares);
}

double mostIterations(const Projection& projection)
{
    switch (projection.model) {
    case ProjectionModel::kHiz:
        return projection.hiz.maxIterations;
    case ProjectionModel::kLinear:
        return projection.linear.maxIterations;
    case ProjectionModel::kPatches:
        return projection.patches.maxIterations;
    default:
        return 0;
    }
}

std::optional<Finding> checkPlane(const Case& testCase, const Plane& plane, const std::string& backend)
{
    const auto find = [&](FindingKind kind, const char* what, const auto& fails) {
        return findValue(plane, backend, kind, what, fails);
    };
    if (auto found =
            find(FindingKind::kNotFinite, "are not finite", [](double v) { return !(std::fabs(v) <= kMostFloat); }))
        return found;
    const OutputType type = findOutput(plane.name)->type;
    if (isShare(plane.name)) {
        // One ulp for a sum of weights.
        if (auto found =
                find(FindingKind::kRange, "are no share", [](double v) { return v < 0.0 || v > 1.0 + 0x1p-22; }))
            return found;
    }
    if (type == OutputType::kHitClass || type == OutputType::kCount) {
        if (auto found = find(FindingKind::kRange, "are no whole numbers",
                              [](double v) { return v < 0.0 || v != std::floor(v); }))
            return found;
    }
    if (type == OutputType::kHitClass) {
        if (auto found = find(FindingKind::kRange, "are no class", [](double v) { return v > 3.0; })) return found;
    }
    if (plane.name == "IterationCount") {
        const double most = mostIterations(testCase.projection);
        if (auto found = find(FindingKind::kIterations, "exceed the bound", [&](double v) { return v > most; })) {
            found->bound = most;
            return found;
        }
    }
    return std::nullopt;
}

// Depth and normals moved up or down by one unit in the last place of a float, by a hash of their place.
Job moveImages(const Job& job, uint64_t seed)
{
    Job moved = job;
    rc::Random random(seed);
    for (ImageDesc& image : moved.images) {
        for (double& texel : image.texels) {
            if (texel == 0.0 || texel == 1.0 || !std::isfinite(texel)) continue;
            texel *= 1.0 + (random.next() % 2 == 0 ? 1.0 : -1.0) * 0x1p-23;
        }
    }
    return moved;
}

} // namespace

CaseFuzzer::CaseFuzzer(Options options)
    : options_(std::move(options)), compiler_(options_.cache / "spirv"),
      pool_(WorkerOptions{
          .mesaCacheFolder = options_.cache / "mesa", .cores = options_.cores, .executable = options_.executable})
{
    std::filesystem::create_directories(options_.scratch);
}

std::filesystem::path CaseFuzzer::scratchFile(int core) const
{
    return options_.scratch / fmt::format("core{}.toml", core);
}

std::vector<Plane> CaseFuzzer::ask(const Case& testCase, const std::string& backend, const Job& job, int core,
                                   std::optional<Finding>& finding)
{
    const JobReport report = pool_.run(backend, core, job, kPatience);
    if (report.outcome != JobOutcome::kDone) {
        const char* const what = report.outcome == JobOutcome::kTimeout ? "no answer in time" : report.text.c_str();
        finding = Finding{FindingKind::kNoAnswer, backend, "", fmt::format("{}: {}", backend, what), 0};
        return {};
    }
    return readPlanes(testCase, report.result);
}

CaseOutcome CaseFuzzer::check(const Node& root, int core)
{
    CaseOutcome outcome;
    try {
        const CaseData data(readTree(root, scratchFile(core)));
        const Case& testCase = data.testCase();
        const Job floatJob = buildJob(data, compiler_, options_.shaders, Precision::kFloat);
        const Job doubleJob = buildJob(data, compiler_, options_.shaders, Precision::kDouble);
        std::vector<std::string> backends{"cpu64", "cpu32"};
        backends.insert(backends.end(), options_.backends.begin(), options_.backends.end());
        const std::vector<bool>& traced = data.tracedPixels();
        outcome.pixels = static_cast<size_t>(std::count(traced.begin(), traced.end(), true));

        std::vector<double> reference; // classes on cpu64
        std::vector<std::pair<std::string, std::vector<double>>> classes;
        for (const std::string& backend : backends) {
            const std::vector<Plane> planes =
                ask(testCase, backend, usesDoubles(backend) ? doubleJob : floatJob, core, outcome.finding);
            if (outcome.finding) return outcome;
            for (const Plane& plane : planes) {
                outcome.finding = checkPlane(testCase, plane, backend);
                if (outcome.finding) return outcome;
            }
            classes.emplace_back(backend, planeOf(planes, "HitSuccess").values);
        }
        reference = classes.front().second;
        std::vector<bool> differs(reference.size());
        for (const auto& [backend, values] : classes) {
            for (size_t pixel = 0; pixel < values.size(); ++pixel)
                differs[pixel] = differs[pixel] || values[pixel] != reference[pixel];
        }
        outcome.differingPixels = static_cast<size_t>(std::count(differs.begin(), differs.end(), true));
        if (outcome.differingPixels == 0) return outcome;
        std::vector<bool> undecidable(reference.size());
        for (uint64_t move = 1; move <= 6; ++move) {
            for (const std::string backend : {"cpu64", "cpu32"}) {
                const Job moved = moveImages(usesDoubles(backend) ? doubleJob : floatJob, move);
                const std::vector<Plane> planes = ask(testCase, backend, moved, core, outcome.finding);
                if (outcome.finding) return outcome;
                const std::vector<double>& values = planeOf(planes, "HitSuccess").values;
                for (size_t pixel = 0; pixel < values.size(); ++pixel)
                    undecidable[pixel] = undecidable[pixel] || values[pixel] != reference[pixel];
            }
        }
        for (const auto& [backend, values] : classes) {
            for (size_t pixel = 0; pixel < values.size(); ++pixel) {
                if (values[pixel] == reference[pixel]) continue;
                if (undecidable[pixel]) {
                    ++outcome.undecidablePixels;
                    continue;
                }
                const auto nameAt = [&](double value) {
                    return nameOf(static_cast<HitClass>(static_cast<int>(value)));
                };
                outcome.finding =
                    Finding{FindingKind::kClass, backend, "HitSuccess",
                            fmt::format("HitSuccess on {}: {} at ({}, {}), {} on cpu64", backend, nameAt(values[pixel]),
                                        pixel % static_cast<size_t>(testCase.camera.width),
                                        pixel / static_cast<size_t>(testCase.camera.width), nameAt(reference[pixel])),
                            0};
                return outcome;
            }
        }
    } catch (const InputError& error) {
        outcome.refused = error.what();
    } catch (const ShaderError& error) {
        outcome.finding = Finding{FindingKind::kNoAnswer, "", "", error.what(), 0};
    }
    return outcome;
}

Node CaseFuzzer::minimize(const rc::Shrinkable<Node>& failing, Finding& finding, int core, int budget)
{
    rc::Shrinkable<Node> smallest = failing;
    for (bool isSmaller = true; isSmaller && budget > 0;) {
        isSmaller = false;
        rc::Seq<rc::Shrinkable<Node>> shrinks = smallest.shrinks();
        while (budget > 0) {
            const rc::Maybe<rc::Shrinkable<Node>> next = shrinks.next();
            if (!next) break;
            const CaseOutcome outcome = check(next->value(), core);
            if (outcome.refused.empty()) --budget; // what is refused costs next to nothing
            if (!outcome.finding || outcome.finding->kind != finding.kind ||
                outcome.finding->backend != finding.backend)
                continue;
            smallest = *next;
            finding = *outcome.finding;
            isSmaller = true;
            break;
        }
    }
    return smallest.value();
}

} // namespace crossray
