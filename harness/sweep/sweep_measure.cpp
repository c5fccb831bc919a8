// One value of the parameter on the backends: the case's job, its answers, and what can be said of them in numbers.
#include "harness/expect/expect.h"
#include "harness/inspect/names.h"
#include "harness/pass/pass.h"
#include "harness/run/case_judge.h"
#include "harness/run/execute.h"
#include "harness/run/worker_explain.h"
#include "harness/sweep/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>

namespace crossray {

namespace {

const Plane* findPlane(const std::vector<Plane>& planes, std::string_view name)
{
    const auto found = std::find_if(planes.begin(), planes.end(), [&](const Plane& p) { return p.name == name; });
    return found == planes.end() ? nullptr : &*found;
}

std::vector<SweepError> judgeErrors(CaseJudge& judge, const std::string& backend, const std::vector<Plane>& planes)
{
    std::vector<SweepError> errors;
    for (const ExpectationResult& result : judge.judgeAlone(backend, planes)) {
        if (!result.judged) continue;
        const Comparison& comparison = result.comparison;
        SweepError error{result.output,
                         result.source,
                         comparison.unit,
                         comparison.mean,
                         comparison.p99,
                         comparison.max,
                         comparison.compared,
                         0,
                         comparison.passed || comparison.compared == 0,
                         {}};
        if (comparison.compared > 0)
            error.failed = static_cast<double>(comparison.failed) / static_cast<double>(comparison.compared);
        for (const char* name : {"recall", "precision", "false"}) {
            const auto metric = comparison.metrics.find(name);
            if (metric != comparison.metrics.end()) error.metrics[name] = metric->second;
        }
        errors.push_back(std::move(error));
    }
    return errors;
}

int kindAt(const Plane& hits, const Plane& reasons, size_t pixel)
{
    const auto whole = [](double value) { return std::isfinite(value) ? static_cast<int>(value) : 99; };
    return whole(hits.values[pixel]) * 100 + whole(reasons.values[pixel]);
}

std::string nameOfKind(int kind)
{
    const int hitClass = kind / 100, reason = kind % 100;
    if (hitClass < 0 || hitClass > 3) return "no class";
    const std::string name(nameOf(static_cast<HitClass>(hitClass)));
    return reason == 0 ? name : fmt::format("{}: {}", name, nameOfReason(reason));
}

// The order of PlanarStatus in harness/expect/analytic.h.
std::string nameOfPlanarStatus(double status)
{
    static constexpr std::string_view kNames[] = {
        "shown",
        "camera not in front",
        "degenerate plane",
        "no field of view",
        "plane out of view",
        "outside the capture",
        "behind the near plane",
        "capture looks away",
        "degenerate ray",
        "not asked",
    };
    const bool isKnown = status >= 0 && status < static_cast<double>(std::size(kNames));
    return fmt::format("planar: {}", isKnown ? kNames[static_cast<size_t>(status)] : "no status");
}

std::vector<int> findKinds(const std::vector<Plane>& planes, const std::vector<bool>& traced)
{
    const Plane& hits = *findPlane(planes, "HitSuccess");
    const Plane& reasons = *findPlane(planes, "HitReason");
    std::vector<int> kinds(traced.size(), -1);
    for (size_t pixel = 0; pixel < traced.size(); ++pixel) {
        if (traced[pixel]) kinds[pixel] = kindAt(hits, reasons, pixel);
    }
    return kinds;
}

void countClasses(const std::vector<Plane>& planes, const std::vector<int>& kinds, SweepCell& cell)
{
    const Plane& iterations = *findPlane(planes, "IterationCount");
    const Plane* const status = findPlane(planes, "PlanarStatus");
    double rays = 0;
    for (size_t pixel = 0; pixel < kinds.size(); ++pixel) {
        if (kinds[pixel] < 0) continue;
        rays += 1;
        cell.classes[nameOfKind(kinds[pixel])] += 1;
        if (status != nullptr) cell.classes[nameOfPlanarStatus(status->values[pixel])] += 1;
        if (!std::isfinite(iterations.values[pixel])) continue;
        cell.meanIterations += iterations.values[pixel];
        cell.maxIterations = std::max(cell.maxIterations, iterations.values[pixel]);
    }
    if (rays == 0) {
        cell.classes["nothing traces"] = 1;
        return;
    }
    cell.meanIterations /= rays;
    for (auto& [name, share] : cell.classes)
        share /= rays;
}

void countNotFinite(const std::vector<Plane>& planes, SweepCell& cell)
{
    for (const Plane& plane : planes) {
        const auto count =
            std::count_if(plane.values.begin(), plane.values.end(), [](double value) { return !std::isfinite(value); });
        if (count == 0) continue;
        cell.notFinite += static_cast<uint64_t>(count);
        cell.notFiniteOutputs += (cell.notFiniteOutputs.empty() ? "" : " ") + plane.name;
    }
}

double shareOfDifferences(const std::vector<int>& kinds, const std::vector<int>& reference)
{
    double rays = 0, different = 0;
    for (size_t pixel = 0; pixel < kinds.size() && pixel < reference.size(); ++pixel) {
        rays += reference[pixel] >= 0;
        different += reference[pixel] >= 0 && kinds[pixel] != reference[pixel];
    }
    return rays > 0 ? different / rays : 0;
}

SweepPixels keepPixels(const CaseData& data, const std::vector<int>& kinds)
{
    const Camera& camera = data.testCase().camera;
    SweepPixels pixels{camera.width, camera.height, kinds, std::vector<float>(kinds.size())};
    const std::vector<SurfacePoint>& surfaces = data.surfaces();
    for (size_t pixel = 0; pixel < kinds.size(); ++pixel) {
        if (kinds[pixel] < 0) continue;
        const double cosine = glm::dot(surfaces[pixel].normalWS, surfaces[pixel].toEyeWS);
        pixels.incidence[pixel] = static_cast<float>(glm::degrees(std::acos(std::clamp(cosine, -1.0, 1.0))));
    }
    return pixels;
}

std::string describeFailure(const JobReport& report)
{
    switch (report.outcome) {
    case JobOutcome::kCrash:
        return "crash: " + report.text;
    case JobOutcome::kTimeout:
        return "no answer in time";
    default:
        return report.text;
    }
}

} // namespace

SweepRow measureOnDevices(const SweepPlan& plan, double value, const std::vector<std::string>& backends,
                          const SweepDevices& devices)
{
    SweepRow row;
    row.value = value;
    std::shared_ptr<const CaseData> data;
    Job floatJob, doubleJob;
    try {
        data = std::make_shared<const CaseData>(makeCaseAt(plan, value));
        floatJob = buildJob(*data, devices.compiler, devices.shaders, Precision::kFloat);
        doubleJob = buildJob(*data, devices.compiler, devices.shaders, Precision::kDouble);
    } catch (const InputError& error) {
        row.refused = error.what();
        return row;
    }
    CaseJudge judge(data);
    std::vector<std::vector<int>> kinds(backends.size());
    row.cells.resize(backends.size());
    std::atomic<size_t> next = 0;
    std::exception_ptr failure;
    std::mutex mutex;
    const auto serve = [&](int core) {
        for (size_t i = next++; i < backends.size(); i = next++) {
            SweepCell& cell = row.cells[i];
            cell.backend = backends[i];
            try {
                const JobReport report = runExplained(devices.pool, devices.compiler, devices.shaders, backends[i],
                                                      core, usesDoubles(backends[i]) ? doubleJob : floatJob,
                                                      std::chrono::duration<double>(data->testCase().timeoutSeconds));
                if (report.outcome != JobOutcome::kDone) {
                    cell.failure = describeFailure(report);
                    continue;
                }
                const std::vector<Plane> planes = readPlanes(data->testCase(), report.result);
                cell.errors = judgeErrors(judge, backends[i], planes);
                kinds[i] = findKinds(planes, data->tracedPixels());
                countClasses(planes, kinds[i], cell);
                countNotFinite(planes, cell);
            } catch (...) {
                const std::lock_guard lock(mutex);
                if (!failure) failure = std::current_exception();
            }
        }
    };
    {
        std::vector<std::jthread> threads;
        for (int core = 0; core < devices.jobs; ++core)
            threads.emplace_back(serve, core);
    }
    if (failure) {
        try {
            std::rethrow_exception(failure);
        } catch (const InputError& error) { // an expectation that has no answer for this case
            row.cells.clear();
            row.refused = error.what();
            return row;
        }
    }
    const auto reference = std::find(backends.begin(), backends.end(), "cpu64") - backends.begin();
    const auto place = static_cast<size_t>(reference);
    if (place < backends.size() && !kinds[place].empty()) {
        row.pixels = keepPixels(*data, kinds[place]);
        for (size_t i = 0; i < backends.size(); ++i) {
            if (!kinds[i].empty()) row.cells[i].differs = shareOfDifferences(kinds[i], kinds[place]);
        }
    }
    return row;
}

} // namespace crossray
