#include "harness/inspector/live_render.h"

#include "harness/base/stopwatch.h"
#include "harness/run/case_flight.h"
#include "harness/run/environment.h"
#include "harness/run/verdict.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <condition_variable>
#include <csignal>
#include <exception>
#include <mutex>
#include <thread>

#include <sys/types.h>

namespace crossray {

namespace {

constexpr size_t kMostKept = 4; // cases whose data are kept

WorkerOptions makeWorkerOptions(const LiveSetup& setup)
{
    WorkerOptions options;
    options.mesaCacheFolder = setup.cache / "mesa";
    options.executable = setup.workerProgram;
    options.cores = countAvailableCores();
    return options;
}

double shaderTime(const StageTimes& times)
{
    return times.device >= 0 ? times.device : times.dispatch;
}

} // namespace

// A backend is busy while a job of it runs.
class LiveRenderer::Busy {
  public:
    Busy(LiveRenderer& owner, std::string backend) : owner_(owner), backend_(std::move(backend)) { add(1); }
    ~Busy() { add(-1); }
    Busy(const Busy&) = delete;
    Busy& operator=(const Busy&) = delete;

  private:
    void add(int count)
    {
        const std::lock_guard lock(owner_.busyMutex_);
        owner_.busy_[backend_] += count;
    }
    LiveRenderer& owner_;
    std::string backend_;
};

LiveRenderer::LiveRenderer(const LiveSetup& setup)
    : setup_(setup), pool_(makeWorkerOptions(setup)), compiler_(setup.cache / "spirv"),
      steps_(makeSteps(pool_, compiler_, setup.shaders, setup.backends))
{
}

void LiveRenderer::killBusy()
{
    const std::lock_guard lock(busyMutex_);
    for (const auto& [backend, count] : busy_) {
        if (count == 0) continue;
        for (const int process : pool_.processIds(backend))
            ::kill(process, SIGKILL);
    }
}

// Of an interrupted watch the workers are killed until the jobs are over: the pool starts one anew that dies before it
// has read its job.
void LiveRenderer::runAll(size_t count, const WorkWatch& watch, const std::function<void(size_t)>& job)
{
    constexpr std::chrono::milliseconds kGlance{10};
    std::mutex mutex;
    std::condition_variable changed;
    size_t open = count;
    std::exception_ptr failure;
    {
        std::vector<std::jthread> threads;
        for (size_t i = 0; i < count; ++i) {
            threads.emplace_back([&, i] {
                std::exception_ptr own;
                try {
                    job(i);
                } catch (...) {
                    own = std::current_exception();
                }
                const std::lock_guard lock(mutex);
                if (!failure) failure = own;
                --open;
                changed.notify_all();
            });
        }
        std::unique_lock lock(mutex);
        while (!changed.wait_for(lock, kGlance, [&] { return open == 0; })) {
            if (watch.isInterrupted()) killBusy();
        }
    }
    if (failure) std::rethrow_exception(failure);
}

// A backend stays on its core, so that its worker is warm.
int LiveRenderer::coreOf(const std::string& backend)
{
    return cores_.emplace(backend, static_cast<int>(cores_.size())).first->second;
}

LiveRenderer::Kept& LiveRenderer::keptOf(const std::string& caseName)
{
    const auto found =
        std::find_if(kept_.begin(), kept_.end(), [&](const Kept& kept) { return kept.caseName == caseName; });
    if (found != kept_.end()) {
        kept_.splice(kept_.begin(), kept_, found);
    } else {
        kept_.push_front({caseName, {}, nullptr, {}, nullptr});
        if (kept_.size() > kMostKept) kept_.pop_back();
    }
    return kept_.front();
}

std::shared_ptr<const CaseData> LiveRenderer::prepare(const CaseTree& tree)
{
    Kept& kept = keptOf(tree.testCase.name);
    if (kept.data && saysTheSame(kept.whole, tree.whole)) return kept.data;
    kept.data = kept.data ? std::make_shared<const CaseData>(tree.testCase, *kept.data)
                          : std::make_shared<const CaseData>(tree.testCase);
    kept.whole = tree.whole;
    return kept.data;
}

std::shared_ptr<const CaseData> LiveRenderer::prepareRecord(const CaseTree& tree)
{
    Kept& kept = keptOf(tree.testCase.name);
    if (kept.record && saysTheSame(kept.recordWhole, tree.whole)) return kept.record;
    const Case recorded = prepareForRecord(tree.testCase);
    const std::shared_ptr<const CaseData> earlier = kept.record ? kept.record : kept.data;
    kept.record =
        earlier ? std::make_shared<const CaseData>(recorded, *earlier) : std::make_shared<const CaseData>(recorded);
    kept.recordWhole = tree.whole;
    return kept.record;
}

LiveRender LiveRenderer::render(const CaseTree& tree, std::span<const std::string> backends, WorkWatch& watch)
{
    Stopwatch whole, watchPart;
    LiveRender live;
    const Case& testCase = tree.testCase;
    live.result = startCaseResult(testCase);
    watch.begin("scene");
    PreparedCase prepared;
    prepared.data = prepare(tree);
    live.times.prepare = watchPart.lap();

    watch.begin("shaders");
    std::vector<std::string> asked;
    for (const std::string& backend : backends) {
        if (!runsOn(testCase, backend)) continue;
        asked.push_back(backend);
        std::optional<Job>& job = usesDoubles(backend) ? prepared.doubleJob : prepared.floatJob;
        const Precision precision = usesDoubles(backend) ? Precision::kDouble : Precision::kFloat;
        if (!job) job = buildJob(*prepared.data, compiler_, setup_.shaders, precision);
    }
    live.times.compile = watchPart.lap();

    ExecuteOptions options;
    options.backends = asked;
    options.keepPlanes = KeepPlanes::kNone;
    options.today = formatToday();
    CaseFlight flight(testCase, std::move(prepared), options);
    std::vector<Answer> answers(asked.size());
    watch.begin(fmt::format("running on {}", fmt::join(asked, ", ")), asked.size());
    const std::atomic<bool> isInterrupted{false};
    std::atomic<size_t> done = 0;
    std::vector<int> cores;
    for (const std::string& backend : asked)
        cores.push_back(coreOf(backend));
    runAll(asked.size(), watch, [&](size_t i) {
        try {
            const Busy busy(*this, asked[i]);
            answers[i] = fetchAnswer(testCase, flight.prepared(), asked[i], cores[i], options, steps_, isInterrupted);
            watch.note(++done, asked.size());
        } catch (const ShaderError& error) { // found while it ran
            answers[i] = {makeErrorResult(asked[i], error.what()), {}, {}};
        }
    });
    watchPart.lap();

    watch.begin("expected values");
    std::vector<BackendResult> settled;
    const auto take = [&](CaseFlight::Settled given) {
        std::move(given.results.begin(), given.results.end(), std::back_inserter(settled));
    };
    for (Answer& answer : answers) {
        live.times.backends[answer.result.backend] = answer.result.times.worker;
        live.times.shader[answer.result.backend] = shaderTime(answer.result.times);
        if (!answer.planes.empty()) live.planes[answer.result.backend] = answer.planes;
        try {
            if (!answer.planes.empty())
                answer.result.expectations = flight.judge().judgeAlone(answer.result.backend, answer.planes);
        } catch (const InputError& error) { // the pictures are good, and what they should be is not to be had
            answer.result = makeErrorResult(answer.result.backend, error.what());
            answer.planes.clear();
        }
        take(flight.take(std::move(answer), false));
    }
    take(flight.finish());
    for (const std::string& backend : backends) {
        const auto found = std::find_if(settled.begin(), settled.end(),
                                        [&](const BackendResult& result) { return result.backend == backend; });
        if (found != settled.end()) {
            live.result.backends.push_back(std::move(*found));
        } else {
            BackendResult skipped;
            skipped.backend = backend;
            skipped.reason = whyNotOn(testCase, backend);
            live.result.backends.push_back(std::move(skipped));
        }
    }
    std::vector<Plane> expected = flight.judge().takeExpectedPlanes();
    for (Plane& mask : flight.judge().makeMaskPlanes())
        expected.push_back(std::move(mask));
    if (!expected.empty()) live.planes["expected"] = std::move(expected);
    live.times.judge = watchPart.lap();
    live.times.total = whole.lap();
    live.result.prepareMs = live.times.prepare;
    live.result.compileMs = live.times.compile;
    return live;
}

LiveTrace LiveRenderer::trace(const CaseTree& tree, glm::ivec2 pixel, std::span<const std::string> backends,
                              WorkWatch& watch)
{
    Stopwatch whole, watchPart;
    LiveTrace live;
    watch.begin("scene");
    const std::shared_ptr<const CaseData> data = prepareRecord(tree);
    live.times.prepare = watchPart.lap();
    watch.begin(fmt::format("tracing on {}", fmt::join(backends, ", ")), backends.size());
    const std::chrono::duration<double> timeout(tree.testCase.timeoutSeconds);
    std::vector<PixelTrace> traces(backends.size());
    std::vector<double> milliseconds(backends.size());
    std::vector<int> cores;
    for (const std::string& backend : backends)
        cores.push_back(coreOf(backend));
    try {
        runAll(backends.size(), watch, [&](size_t i) {
            Stopwatch own;
            const Busy busy(*this, backends[i]);
            const TraceWorkers workers{pool_, compiler_, setup_.shaders, cores[i], timeout};
            traces[i] = tracePixel(*data, pixel, backends.subspan(i, 1), workers);
            milliseconds[i] = own.lap();
        });
    } catch (const EnvironmentError&) {
        if (watch.isCancelled()) throw WorkCancelled(); // who was killed on purpose has not crashed
        throw;
    }
    live.trace = std::move(traces.front());
    for (size_t i = 0; i < backends.size(); ++i) {
        live.times.backends[backends[i]] = milliseconds[i];
        if (i > 0) live.trace.records.push_back(std::move(traces[i].records.front()));
    }
    if (live.trace.records.size() == 2) live.trace.parting = findParting(live.trace.records[0], live.trace.records[1]);
    live.times.total = whole.lap();
    return live;
}

} // namespace crossray
