#include "harness/run/execute.h"

#include "harness/run/answer.h"
#include "harness/run/plane_files.h"
#include "harness/run/schedule.h"
#include "harness/run/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

namespace crossray {

bool usesDoubles(const std::string& backend)
{
    return backend == "cpu64";
}

namespace {

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point start)
{
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

bool runsOn(const Case& testCase, const std::string& backend)
{
    return testCase.backends.empty() ||
           std::find(testCase.backends.begin(), testCase.backends.end(), backend) != testCase.backends.end();
}

// An estimate of what a case holds while in flight, for the schedule's bound: its G-buffer, two jobs, and the planes of
// all backends.
size_t estimateBytes(const Case& testCase, size_t backendCount)
{
    size_t channels = 40;
    for (const OutputInfo& output : testCase.outputs)
        channels += static_cast<size_t>(output.channels) * (backendCount + 1);
    return static_cast<size_t>(testCase.camera.width) * static_cast<size_t>(testCase.camera.height) * channels *
           sizeof(double);
}

CaseResult startCaseResult(const Case& testCase)
{
    CaseResult result;
    result.name = testCase.name;
    result.summary = testCase.summary;
    result.tags = testCase.tags;
    result.position = testCase.position;
    if (result.position.file.empty()) result.position.file = testCase.file.string();
    result.width = testCase.camera.width;
    result.height = testCase.camera.height;
    result.mustFail = testCase.mustFail;
    return result;
}

// Everything about a case between its preparation and its last verdict.
struct CaseInFlight {
    PreparedCase prepared;
    std::unique_ptr<CaseJudge> judge;
    std::map<std::string, std::vector<Plane>> planes; // of the backends that answered
    struct BackendAnswer {
        BackendResult result;
        std::string difference; // between repeats
    };
    std::map<std::string, BackendAnswer> answers;
};

class Execution {
  public:
    Execution(const std::vector<Case>& cases, const ExecuteOptions& options, const ExecuteSteps& steps,
              RunObserver& observer, const std::atomic<bool>& interrupted, RunResult& run)
        : cases_(cases), options_(options), steps_(steps), observer_(observer), interrupted_(interrupted), run_(run),
          flights_(cases.size()), schedule_(makeSchedule())
    {
        for (const Case& testCase : cases_) {
            run_.cases.push_back(startCaseResult(testCase));
        }
    }

    void runAll()
    {
        const Clock::time_point start = Clock::now();
        for (size_t i = 0; i < cases_.size(); ++i)
            skipForeignBackends(i);
        {
            std::vector<std::jthread> threads;
            for (int core = 0; core < options_.cores; ++core)
                threads.emplace_back([this, core] { serveCore(static_cast<size_t>(core)); });
            watch();
        }
        if (failure_) std::rethrow_exception(failure_);
        run_.interrupted = interrupted_;
        settleWhatIsLeft();
        run_.seconds = millisecondsSince(start) / 1000;
    }

  private:
    Schedule makeSchedule() const
    {
        std::vector<std::vector<bool>> applies;
        std::vector<size_t> bytes;
        for (const Case& testCase : cases_) {
            std::vector<bool>& row = applies.emplace_back();
            for (const std::string& backend : options_.backends)
                row.push_back(runsOn(testCase, backend));
            bytes.push_back(estimateBytes(testCase, options_.backends.size()));
        }
        return Schedule(std::move(applies), std::move(bytes), static_cast<size_t>(options_.cores), Schedule::Limits{});
    }

    // The calling thread keeps the observer's clock and looks for an interruption while the cores' threads work.
    void watch()
    {
        std::unique_lock lock(mutex_);
        while (busyCores_ > 0) {
            changed_.wait_for(lock, std::chrono::milliseconds(100));
            observer_.tick();
            if (!interrupted_) continue;
            schedule_.stop();
            changed_.notify_all();
            lock.unlock();
            steps_.killWorkers();
            lock.lock();
        }
    }

    void serveCore(size_t core)
    {
        std::unique_lock lock(mutex_);
        try {
            while (true) {
                if (interrupted_) schedule_.stop();
                const Task task = schedule_.next(core);
                if (task.kind == Task::Kind::kDone) break;
                if (task.kind == Task::Kind::kWait) {
                    changed_.wait(lock);
                } else if (task.kind == Task::Kind::kPrepare) {
                    prepare(lock, task.caseIndex);
                } else {
                    runTask(lock, core, task);
                }
            }
        } catch (...) {
            // Not about a case: the disk is full, memory is out. It ends the run.
            if (!lock.owns_lock()) lock.lock();
            if (!failure_) failure_ = std::current_exception();
            schedule_.stop();
        }
        --busyCores_;
        changed_.notify_all();
    }

    void prepare(std::unique_lock<std::mutex>& lock, size_t caseIndex)
    {
        const Case& testCase = cases_[caseIndex];
        bool needsFloat = false, needsDouble = false;
        for (const std::string& backend : options_.backends) {
            if (runsOn(testCase, backend)) (usesDoubles(backend) ? needsDouble : needsFloat) = true;
        }
        if (!needsFloat && !needsDouble) {
            schedule_.finishPrepare(caseIndex, false);
            finishCase(caseIndex);
            return;
        }
        lock.unlock();
        auto flight = std::make_unique<CaseInFlight>();
        std::string error;
        bool isBrokenInput = false;
        try {
            flight->prepared = steps_.prepare(testCase, needsFloat, needsDouble);
            flight->judge = std::make_unique<CaseJudge>(flight->prepared.data);
        } catch (const InputError& failure) {
            error = failure.what();
            isBrokenInput = true;
        } catch (const ShaderError& failure) {
            error = failure.what();
        }
        lock.lock();
        run_.cases[caseIndex].prepareMs = flight->prepared.prepareMs;
        run_.cases[caseIndex].compileMs = flight->prepared.compileMs;
        if (error.empty()) {
            flights_[caseIndex] = std::move(flight);
        } else {
            if (isBrokenInput) recordBrokenInput(error);
            for (const std::string& backend : options_.backends) {
                if (runsOn(testCase, backend)) recordVerdict(caseIndex, makeErrorResult(backend, error));
            }
        }
        schedule_.finishPrepare(caseIndex, error.empty());
        if (!error.empty()) finishCase(caseIndex);
        changed_.notify_all();
    }

    void recordBrokenInput(const std::string& line)
    {
        run_.brokenFiles.push_back(line);
        if (options_.keepGoing) return;
        run_.stoppedEarly = true;
        schedule_.stop();
    }

    void runTask(std::unique_lock<std::mutex>& lock, size_t core, const Task& task)
    {
        const std::string& backend = options_.backends[task.backend];
        const Clock::time_point start = Clock::now();
        observer_.startBackend(backend, run_.cases[task.caseIndex]);
        CaseInFlight& flight = *flights_[task.caseIndex];
        lock.unlock();

        Answer answer;
        std::string brokenInput;
        if (const std::string error = openWorker(core, backend); !error.empty()) {
            answer.result = makeErrorResult(backend, error);
        } else {
            try {
                answer = askBackend(cases_[task.caseIndex], flight.prepared, *flight.judge, backend,
                                    static_cast<int>(core), options_, steps_, interrupted_);
            } catch (const InputError& failure) {
                brokenInput = failure.what();
                answer = {makeErrorResult(backend, brokenInput), {}, {}};
            }
        }

        lock.lock();
        if (!brokenInput.empty()) recordBrokenInput(brokenInput);
        const bool cutOff = interrupted_ && answer.planes.empty();
        if (!cutOff) {
            flight.answers[backend] = {std::move(answer.result), std::move(answer.difference)};
            if (!answer.planes.empty()) flight.planes[backend] = std::move(answer.planes);
            settleVerdict(task.caseIndex, backend, false);
        }
        schedule_.finishRun(core, task.caseIndex, task.backend, millisecondsSince(start));
        if (schedule_.isComplete(task.caseIndex)) completeCase(lock, task.caseIndex);
        changed_.notify_all();
    }

    // Returns why the backend's device cannot be opened; empty when it can.
    std::string openWorker(size_t core, const std::string& backend)
    {
        {
            const std::lock_guard lock(backendsMutex_);
            const auto known = run_.backends.find(backend);
            if (known != run_.backends.end()) return known->second.environmentError;
        }
        BackendRecord record;
        std::string error;
        const Clock::time_point start = Clock::now();
        try {
            record.fingerprint = steps_.open(backend, static_cast<int>(core));
            record.startMs = millisecondsSince(start);
        } catch (const EnvironmentError& failure) {
            error = failure.what();
            if (interrupted_) return error; // killed, not missing
            record.environmentError = error;
        }
        const std::lock_guard lock(backendsMutex_);
        run_.backends.try_emplace(backend, std::move(record));
        return error;
    }

    bool isExpectedToRepeat(const std::string& backend)
    {
        const std::lock_guard lock(backendsMutex_);
        return isSoftwareRasterizer(run_.backends.at(backend).fingerprint);
    }

    // Decides the verdict of a backend once nothing that is still to come can change it. `final`: nothing is to come
    // any more.
    void settleVerdict(size_t caseIndex, const std::string& backend, bool final)
    {
        CaseInFlight& flight = *flights_[caseIndex];
        auto& [result, difference] = flight.answers[backend];
        if (!flight.planes.contains(backend)) {
            recordVerdict(caseIndex, result);
            return;
        }
        if (!final && flight.judge->hasAgreements(backend)) return;
        const Judgement judgement = judgeAnswer(cases_[caseIndex], result, flight.judge->isReference(backend));
        result.verdict = judgement.verdict;
        result.reason = judgement.reason;
        if (!difference.empty() && isExpectedToRepeat(backend)) {
            result.verdict = Verdict::kFail;
            result.reason = difference;
        }
        recordVerdict(caseIndex, result);
    }

    // All backends have answered: what they agree upon can be judged, and planes be written. The lock is released
    // meanwhile, as no other thread has a task of this case any more.
    void completeCase(std::unique_lock<std::mutex>& lock, size_t caseIndex)
    {
        CaseInFlight& flight = *flights_[caseIndex];
        lock.unlock();
        std::string brokenInput;
        std::vector<std::string> late;
        for (auto& [backend, answer] : flight.answers) {
            BackendResult& result = answer.result;
            if (!flight.planes.contains(backend) || !flight.judge->hasAgreements(backend)) continue;
            late.push_back(backend);
            const Clock::time_point start = Clock::now();
            try {
                auto agreements = flight.judge->judgeAgreements(backend, flight.planes);
                std::move(agreements.begin(), agreements.end(), std::back_inserter(result.expectations));
            } catch (const InputError& error) {
                brokenInput = error.what();
                result = makeErrorResult(backend, brokenInput);
                flight.planes.erase(backend);
                break;
            }
            result.times.judge += millisecondsSince(start);
        }
        lock.lock();
        if (!brokenInput.empty()) recordBrokenInput(brokenInput);
        for (const std::string& backend : late)
            settleVerdict(caseIndex, backend, true);
        CaseResult copy = run_.cases[caseIndex];
        lock.unlock();
        keepPlanes(flight, copy);
        lock.lock();
        run_.cases[caseIndex] = std::move(copy);
        finishCase(caseIndex);
        flights_[caseIndex].reset();
    }

    void keepPlanes(const CaseInFlight& flight, CaseResult& testCase) const
    {
        if (options_.keepPlanes == KeepPlanes::kNone || options_.outputFolder.empty()) return;
        const PlaneFiles files(options_.outputFolder);
        bool keptAny = false;
        for (BackendResult& result : testCase.backends) {
            const auto planes = flight.planes.find(result.backend);
            const bool wanted = options_.keepPlanes == KeepPlanes::kAll || tallyOf(result.verdict) == Tally::kFailed ||
                                result.verdict == Verdict::kKnownFail;
            if (planes == flight.planes.end() || !wanted) continue;
            result.planesFile = files.write(testCase.name, result.backend, planes->second);
            keptAny = true;
        }
        const std::vector<Plane> expected = flight.judge->takeExpectedPlanes();
        if (keptAny && !expected.empty()) testCase.expectedFile = files.write(testCase.name, "expected", expected);
    }

    void recordVerdict(size_t caseIndex, BackendResult result)
    {
        const Case& testCase = cases_[caseIndex];
        const Judgement judgement =
            applyKnownFailures(testCase, result.backend, options_.today, {result.verdict, result.reason});
        result.verdict = judgement.verdict;
        result.reason = judgement.reason;
        if (run_.firstVerdictMs < 0 && result.verdict != Verdict::kSkip) {
            run_.firstVerdictMs = millisecondsSince(options_.processStart);
        }
        if (tallyOf(result.verdict) == Tally::kFailed) ++failures_;
        auto& list = run_.cases[caseIndex].backends;
        const auto place = std::find_if(list.begin(), list.end(), [&](const BackendResult& other) {
            return orderOf(other.backend) > orderOf(result.backend);
        });
        const auto stored = list.insert(place, std::move(result));
        observer_.finishBackend(run_.cases[caseIndex], *stored);
        if (options_.maxFailures > 0 && failures_ >= options_.maxFailures && !run_.stoppedEarly) {
            run_.stoppedEarly = true;
            schedule_.stop();
        }
    }

    ptrdiff_t orderOf(const std::string& backend) const
    {
        return std::find(options_.backends.begin(), options_.backends.end(), backend) - options_.backends.begin();
    }

    void skipForeignBackends(size_t caseIndex)
    {
        for (const std::string& backend : options_.backends) {
            if (runsOn(cases_[caseIndex], backend)) continue;
            BackendResult result;
            result.backend = backend;
            result.reason = "the case does not name this backend";
            recordVerdict(caseIndex, std::move(result));
        }
    }

    void finishCase(size_t caseIndex) { observer_.finishCase(run_.cases[caseIndex]); }

    // After an early end: answers that wait for another backend are judged by what there is.
    void settleWhatIsLeft()
    {
        std::unique_lock lock(mutex_);
        for (size_t i = 0; i < cases_.size(); ++i) {
            if (flights_[i]) completeCase(lock, i);
        }
        std::erase_if(run_.cases, [](const CaseResult& testCase) { return testCase.backends.empty(); });
    }

    const std::vector<Case>& cases_;
    const ExecuteOptions& options_;
    const ExecuteSteps& steps_;
    RunObserver& observer_;
    const std::atomic<bool>& interrupted_;
    RunResult& run_;
    std::vector<std::unique_ptr<CaseInFlight>> flights_;
    Schedule schedule_;
    std::mutex mutex_; // guards all above but run_.backends, and the observer
    std::mutex backendsMutex_;
    std::condition_variable changed_;
    int busyCores_ = options_.cores;
    int failures_ = 0;
    std::exception_ptr failure_;
};

} // namespace

void execute(const std::vector<Case>& cases, const ExecuteOptions& options, const ExecuteSteps& steps,
             RunObserver& observer, const std::atomic<bool>& interrupted, RunResult& run)
{
    Execution(cases, options, steps, observer, interrupted, run).runAll();
}

} // namespace crossray
