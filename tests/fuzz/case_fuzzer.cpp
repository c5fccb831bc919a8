#include "tests/fuzz/case_fuzzer.h"

#include "harness/pass/pass.h"
#include "harness/run/conditioning.h"
#include "harness/run/execute.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
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

std::string nameOfClass(double value)
{
    return std::string(nameOf(static_cast<HitClass>(static_cast<int>(value))));
}

} // namespace

CaseFuzzer::CaseFuzzer(Options options)
    : options_(std::move(options)), compiler_(options_.cache / "spirv"),
      pool_(WorkerOptions{
          .mesaCacheFolder = options_.cache / "mesa", .cores = options_.cores, .executable = options_.executable})
{
}

std::filesystem::path CaseFuzzer::scratchFile(int core) const
{
    return scratch_.path() / fmt::format("core{}.toml", core);
}

std::vector<Plane> CaseFuzzer::ask(const Subject& subject, const std::string& backend, const Job& job)
{
    const JobReport report = pool_.run(backend, subject.core, job, kPatience);
    if (report.outcome != JobOutcome::kDone) {
        throw EnvironmentError(report.outcome == JobOutcome::kTimeout ? "no answer in time" : report.text);
    }
    return readPlanes(subject.data.testCase(), report.result);
}

// All backends' answers, each checked by itself; nothing where one is at fault.
std::vector<CaseFuzzer::Classes> CaseFuzzer::askAll(const Subject& subject, std::span<const std::string> backends,
                                                    CaseOutcome& outcome)
{
    std::vector<std::string> all{"cpu64", "cpu32"};
    all.insert(all.end(), backends.begin(), backends.end());
    std::vector<Classes> classes;
    for (const std::string& backend : all) {
        std::vector<Plane> planes;
        const auto start = std::chrono::steady_clock::now();
        try {
            planes = ask(subject, backend, usesDoubles(backend) ? subject.doubleJob : subject.floatJob);
        } catch (const Error& error) {
            outcome.finding =
                Finding{FindingKind::kNoAnswer, backend, "", fmt::format("{}: {}", backend, error.what()), 0};
            return {};
        }
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
        outcome.asked.emplace_back(backend, took.count());
        for (const Plane& plane : planes) {
            outcome.finding = checkPlane(subject.data.testCase(), plane, backend);
            if (outcome.finding) return {};
        }
        classes.push_back({backend, planeOf(planes, "HitSuccess").values});
    }
    return classes;
}

// Pixels of another class than on cpu64, where moving the inputs changes nothing there.
void CaseFuzzer::compareClasses(const Subject& subject, const std::vector<Classes>& classes, CaseOutcome& outcome)
{
    const std::vector<double>& reference = classes.front().values;
    const bool isAlike =
        std::all_of(classes.begin(), classes.end(), [&](const Classes& each) { return each.values == reference; });
    if (isAlike) return;
    const Conditioning conditioning =
        measureConditioning(subject.data.testCase(), subject.floatJob, subject.doubleJob,
                            [&](const std::string& backend, const Job& job) { return ask(subject, backend, job); });
    if (!conditioning.note.empty()) {
        outcome.finding = Finding{FindingKind::kNoAnswer, "", "", "with moved inputs: " + conditioning.note, 0};
        return;
    }
    const Mask undecidable = findUndecidable(conditioning, "HitSuccess", kUndecidableAbove);
    const auto width = static_cast<size_t>(subject.data.testCase().camera.width);
    for (size_t pixel = 0; pixel < reference.size(); ++pixel) {
        bool differs = false;
        for (const Classes& each : classes) {
            if (each.values[pixel] == reference[pixel]) continue;
            differs = true;
            if (undecidable[pixel] != 0 || outcome.finding) continue;
            outcome.finding = Finding{FindingKind::kClass, each.backend, "HitSuccess",
                                      fmt::format("HitSuccess on {}: {} at ({}, {}), {} on cpu64", each.backend,
                                                  nameOfClass(each.values[pixel]), pixel % width, pixel / width,
                                                  nameOfClass(reference[pixel])),
                                      0};
        }
        outcome.differingPixels += differs;
        outcome.undecidablePixels += differs && undecidable[pixel] != 0;
    }
}

CaseOutcome CaseFuzzer::check(const Node& root, int core, std::span<const std::string> backends)
{
    CaseOutcome outcome;
    try {
        const CaseData data(readTree(root, scratchFile(core)));
        const std::vector<bool>& traced = data.tracedPixels();
        outcome.pixels = static_cast<size_t>(std::count(traced.begin(), traced.end(), true));
        const Subject subject{data, buildJob(data, compiler_, options_.shaders, Precision::kFloat),
                              buildJob(data, compiler_, options_.shaders, Precision::kDouble), core};
        const std::vector<Classes> classes = askAll(subject, backends, outcome);
        if (!outcome.finding) compareClasses(subject, classes, outcome);
    } catch (const InputError& error) {
        outcome.refused = error.what();
    } catch (const ShaderError& error) {
        outcome.finding = Finding{FindingKind::kNoAnswer, "", "", error.what(), 0};
    }
    return outcome;
}

Node CaseFuzzer::minimize(const rc::Shrinkable<Node>& failing, Finding& finding, int core,
                          std::span<const std::string> backends, int budget)
{
    // Only the backend at fault is asked again.
    std::vector<std::string> suspects;
    std::copy_if(backends.begin(), backends.end(), std::back_inserter(suspects),
                 [&](const std::string& backend) { return backend == finding.backend; });
    rc::Shrinkable<Node> smallest = failing;
    for (bool isSmaller = true; isSmaller && budget > 0;) {
        isSmaller = false;
        rc::Seq<rc::Shrinkable<Node>> shrinks = smallest.shrinks();
        while (budget > 0) {
            const rc::Maybe<rc::Shrinkable<Node>> next = shrinks.next();
            if (!next) break;
            const CaseOutcome outcome = check(next->value(), core, suspects);
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
