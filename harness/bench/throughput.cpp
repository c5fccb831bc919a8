#include "harness/bench/throughput.h"

#include "harness/base/temporary_folder.h"
#include "harness/base/outputs.h"
#include "harness/compile/compile.h"
#include "harness/run/execute.h"
#include "harness/run/steps.h"
#include "harness/run/worker_pool.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>

namespace crossray {

namespace {

class SilentObserver final : public RunObserver {
  public:
    void startBackend(const std::string&, const CaseResult&) override {}
    void finishBackend(const CaseResult&, const BackendResult&) override {}
    void finishCase(const CaseResult&) override {}
    void tick() override {}
};

struct Round {
    double millisecondsPerCase = 0;
    double shaderMilliseconds = 0;
    int failed = 0;
};

// One pass over the cases through a pool whose workers are already open.
Round runOnce(const std::vector<Case>& cases, const std::string& backend, int cores, WorkerPool& pool,
              ShaderCompiler& compiler, const Folders& folders)
{
    const std::string backends[] = {backend};
    ExecuteOptions options;
    options.backends = {backend};
    options.cores = cores;
    options.keepPlanes = KeepPlanes::kNone;
    options.today = "0000-00-00"; // no case here has a known failure that could end
    SilentObserver observer;
    const std::atomic<bool> interrupted = false;
    RunResult run;
    const auto start = std::chrono::steady_clock::now();
    execute(cases, options, makeSteps(pool, compiler, folders.shaders, backends), observer, interrupted, run);
    const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start;

    Round round;
    round.millisecondsPerCase = elapsed.count() / static_cast<double>(cases.size());
    for (const CaseResult& result : run.cases) {
        for (const BackendResult& answer : result.backends) {
            round.shaderMilliseconds +=
                (answer.times.program + answer.times.dispatch) / static_cast<double>(cases.size());
            if (answer.verdict != Verdict::kPass) ++round.failed;
        }
    }
    return round;
}

ThroughputPoint summarize(const std::string& backend, int cores, CacheState state, size_t cases,
                          std::vector<Round> rounds)
{
    std::sort(rounds.begin(), rounds.end(),
              [](const Round& a, const Round& b) { return a.millisecondsPerCase < b.millisecondsPerCase; });
    const Round& median = rounds[rounds.size() / 2];
    ThroughputPoint point{backend,
                          cores,
                          state,
                          static_cast<int>(cases),
                          median.millisecondsPerCase,
                          rounds.front().millisecondsPerCase,
                          rounds.back().millisecondsPerCase,
                          median.shaderMilliseconds,
                          0};
    for (const Round& round : rounds)
        point.failed = std::max(point.failed, round.failed);
    return point;
}

WorkerOptions workerOptions(const std::filesystem::path& mesaCache, int cores)
{
    WorkerOptions options;
    options.mesaCacheFolder = mesaCache;
    options.cores = cores;
    return options;
}

void openWorkers(WorkerPool& pool, const std::string& backend, int cores)
{
    for (int core = 0; core < cores; ++core)
        pool.fingerprint(backend, core);
}

} // namespace

std::string_view nameOf(CacheState state)
{
    switch (state) {
    case CacheState::kCold:
        return "cold";
    case CacheState::kWarm:
        return "warm";
    case CacheState::kHot:
        return "hot";
    }
    return "";
}

std::vector<Case> makeThroughputCases(int count)
{
    if (count < 1 || count > 4096) throw InputError(fmt::format("{} cases: allowed are 1 to 4096", count));
    // Outputs that a case may ask for or not: each set of them is a shader of its own.
    constexpr const char* kOptional[] = {
        "HitReason", "PositionNDC",  "RayDirNDC",    "IterationCount", "MaxUsedMipLevel", "IntersectionKind",
        "HitWeight", "TracingModel", "SampledColor", "Color",          "RayOriginWS",     "PathLength"};
    std::vector<Case> cases;
    for (int index = 0; index < count; ++index) {
        Case made;
        made.name = fmt::format("throughput/{:04}", index);
        const double nudge = 0.001 * index; // metres: no two cases share a G-buffer
        made.camera.worldFromView = makeLookAt({nudge, 1.6, 4.0}, {0.0, 0.6, -4.0}, {0.0, 1.0, 0.0});
        Primitive floor;
        floor.worldFromLocal = glm::dmat3(glm::dvec3(1, 0, 0), glm::dvec3(0, 0, -1), glm::dvec3(0, 1, 0));
        floor.halfExtents = {4.0, 4.0, 0.0};
        floor.material = "mirror";
        Primitive wall;
        wall.center = {0.0, 0.0, -4.0};
        wall.halfExtents = {50.0, 50.0, 0.0};
        made.scene.primitives = {floor, wall};
        made.projection.model = ProjectionModel::kHiz;
        made.projection.hiz = {0, 6, 256, 0.1};
        for (const char* name : {"RayDirWS", "HitDepth", "HitSuccess", "HitPositionSS"}) {
            made.outputs.push_back(*findOutput(name));
        }
        for (size_t bit = 0; bit < std::size(kOptional); ++bit) {
            if ((index >> bit) & 1) made.outputs.push_back(*findOutput(kOptional[bit]));
        }

        Expectation direction;
        direction.output = *findOutput("RayDirWS");
        direction.source = AnalyticSource{"reflection_direction"};
        direction.tolerance.degrees = 1e-3;
        Expectation hits;
        hits.output = *findOutput("HitSuccess");
        hits.source = TruthSource{"hit"};
        hits.budget = HitBudget{0.95, 0.95, 0.05, 2.0};
        made.expectations = {direction, hits};
        cases.push_back(std::move(made));
    }
    return cases;
}

std::vector<ThroughputPoint> measureThroughput(const ThroughputOptions& options, const Folders& folders,
                                               const std::function<void(const ThroughputPoint&)>& report)
{
    const std::vector<Case> cases = makeThroughputCases(options.cases);
    ShaderCompiler compiler(folders.cache / "spirv");
    std::vector<ThroughputPoint> points;
    const auto add = [&](ThroughputPoint point) {
        report(point);
        points.push_back(std::move(point));
    };
    for (const std::string& backend : options.backends) {
        for (const int cores : options.cores) {
            std::vector<Round> cold, warm, hot;
            // Round -1 fills the SPIR-V cache, which is the same for every backend, and is not counted.
            for (int round = -1; round < options.rounds; ++round) {
                const TemporaryFolder mesaCache("bench");
                {
                    WorkerPool pool(workerOptions(mesaCache.path(), cores));
                    openWorkers(pool, backend, cores);
                    const Round first = runOnce(cases, backend, cores, pool, compiler, folders);
                    if (round >= 0) cold.push_back(first);
                }
                if (round < 0) continue;
                WorkerPool pool(workerOptions(mesaCache.path(), cores));
                openWorkers(pool, backend, cores);
                warm.push_back(runOnce(cases, backend, cores, pool, compiler, folders));
                hot.push_back(runOnce(cases, backend, cores, pool, compiler, folders));
            }
            add(summarize(backend, cores, CacheState::kCold, cases.size(), cold));
            add(summarize(backend, cores, CacheState::kWarm, cases.size(), warm));
            add(summarize(backend, cores, CacheState::kHot, cases.size(), hot));
        }
    }
    return points;
}

std::string formatThroughputJson(std::span<const ThroughputPoint> points)
{
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const ThroughputPoint& point : points) {
        rows.push_back({{"backend", point.backend},
                        {"cores", point.cores},
                        {"cache", nameOf(point.state)},
                        {"cases", point.cases},
                        {"millisecondsPerCase", point.millisecondsPerCase},
                        {"fastest", point.fastest},
                        {"slowest", point.slowest},
                        {"shaderMilliseconds", point.shaderMilliseconds},
                        {"failed", point.failed}});
    }
    return nlohmann::ordered_json{{"schema", "crossray-throughput/1"}, {"points", rows}}.dump(2) + "\n";
}

} // namespace crossray
