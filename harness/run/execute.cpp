#include "harness/run/execute.h"

#include "harness/base/stopwatch.h"

#include "harness/run/case_flight.h"
#include "harness/run/golden.h"
#include "harness/run/schedule.h"
#include "harness/run/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

namespace crossray {

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

bool usesDoubles(const std::string& backend)
{
    return backend == "cpu64";
}

namespace {

using Clock = std::chrono::steady_clock;

// An estimate of what a case holds while in flight, for the schedule's bound: its G-buffer, two jobs, the expected
// planes, and those of the backends that are not judged yet, are held for others or keep a failure company.
size_t estimateBytes(const Case& testCase, size_t backends)
{
    constexpr size_t kInputChannels = 40;
    constexpr size_t kPlanesAtOnce = 3;
    size_t outputChannels = 0;
    for (const OutputInfo& output : testCase.outputs)
        outputChannels += static_cast<size_t>(output.channels);
    const size_t channelBytes =
        static_cast<size_t>(testCase.camera.width) * static_cast<size_t>(testCase.camera.height) * sizeof(double);
    const size_t company = std::min(kMaxCompanyBytes, channelBytes * outputChannels * backends);
    return channelBytes * (kInputChannels + kPlanesAtOnce * outputChannels) + company;
}

// The quick CPU devices first: they give the first verdicts, and are what the others are mostly held against.
std::vector<std::string> orderForSchedule(std::vector<std::string> backends)
{
    const auto rank = [](const std::string& name) { return name == "cpu64" ? 0 : name == "cpu32" ? 1 : 2; };
    std::stable_sort(backends.begin(), backends.end(),
                     [&](const std::string& a, const std::string& b) { return rank(a) < rank(b); });
    return backends;
}

class Execution {
  public:
    Execution(const std::vector<Case>& cases, const ExecuteOptions& options, const ExecuteSteps& steps,
              RunObserver& observer, const std::atomic<bool>& interrupted, RunResult& run)
        : cases_(cases), options_(options), order_(orderForSchedule(options.backends)), steps_(steps),
          observer_(observer), interrupted_(interrupted), run_(run), flights_(cases.size()), schedule_(makeSchedule())
    {
        for (const Case& testCase : cases_) {
            run_.cases.push_back(startCaseResult(testCase));
        }
    }

    void runAll()
    {
        const Clock::time_point start = Clock::now();
        if (steps_.recall) openAll();
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
            for (const std::string& backend : order_)
                row.push_back(runsOn(testCase, backend));
            bytes.push_back(estimateBytes(testCase, order_.size()));
        }
        return Schedule(std::move(applies), std::move(bytes), static_cast<size_t>(options_.cores), Schedule::Limits{});
    }

    // Whether a kept result still answers depends on each device's fingerprint.
    void openAll()
    {
        std::vector<std::jthread> threads;
        for (size_t i = 0; i < order_.size(); ++i) {
            threads.emplace_back([this, i] {
                try {
                    openWorker(i % static_cast<size_t>(options_.cores), order_[i]);
                } catch (...) {
                    const std::lock_guard lock(mutex_);
                    if (!failure_) failure_ = std::current_exception();
                }
            });
        }
    }

    ExecuteSteps::Devices devices()
    {
        const std::lock_guard lock(backendsMutex_);
        ExecuteSteps::Devices open;
        for (const auto& [name, record] : run_.backends) {
            if (record.environmentError.empty()) open[name] = record.fingerprint;
        }
        return open;
    }

    // Returns whether the case has its verdicts already.
    bool recallCase(std::unique_lock<std::mutex>& lock, size_t caseIndex)
    {
        if (!steps_.recall) return false;
        lock.unlock();
        std::optional<CaseResult> known = steps_.recall(cases_[caseIndex], devices());
        lock.lock();
        if (!known) return false;
        CaseResult& place = run_.cases[caseIndex];
        std::vector<BackendResult> results = std::move(known->backends);
        place = std::move(*known);
        place.backends.clear();
        for (BackendResult& result : results)
            recordVerdict(caseIndex, std::move(result));
        schedule_.finishPrepare(caseIndex, false);
        finishCase(caseIndex);
        changed_.notify_all();
        return true;
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
                    prepare(lock, core, task.caseIndex);
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

    void prepare(std::unique_lock<std::mutex>& lock, size_t core, size_t caseIndex)
    {
        if (recallCase(lock, caseIndex)) return;
        const Case& testCase = cases_[caseIndex];
        bool needsFloat = false, needsDouble = false;
        for (const std::string& backend : options_.backends) {
            if (runsOn(testCase, backend)) (usesDoubles(backend) ? needsDouble : needsFloat) = true;
        }
        const bool mayMeasure = options_.conditioning || excusesPixels(testCase);
        if (!needsFloat && !needsDouble) {
            skipForeignBackends(caseIndex);
            schedule_.finishPrepare(caseIndex, false);
            finishCase(caseIndex);
            return;
        }
        lock.unlock();
        PreparedCase prepared;
        std::string error;
        bool isBrokenInput = false;
        try {
            prepared = steps_.prepare(testCase, needsFloat || mayMeasure, needsDouble || mayMeasure);
        } catch (const InputError& failure) {
            error = failure.what();
            isBrokenInput = true;
        } catch (const ShaderError& failure) {
            error = failure.what();
        }
        lock.lock();
        run_.cases[caseIndex].inputKey = prepared.inputKey;
        if (error.empty() && isUnchanged(testCase, prepared.inputKey)) {
            run_.unchanged.push_back(testCase.name);
            schedule_.finishPrepare(caseIndex, false);
            changed_.notify_all();
            return;
        }
        skipForeignBackends(caseIndex);
        run_.cases[caseIndex].prepareMs = prepared.prepareMs;
        run_.cases[caseIndex].compileMs = prepared.compileMs;
        if (error.empty()) {
            prepared.askCpu = makeAskCpu(core, testCase);
            flights_[caseIndex] = std::make_unique<CaseFlight>(testCase, std::move(prepared), options_);
            if (options_.conditioning) {
                lock.unlock();
                flights_[caseIndex]->measure();
                lock.lock();
            }
        } else {
            if (isBrokenInput) recordBrokenInput(error);
            for (const std::string& backend : options_.backends) {
                if (runsOn(testCase, backend)) recordError(caseIndex, makeErrorResult(backend, error));
            }
        }
        schedule_.finishPrepare(caseIndex, error.empty());
        if (!error.empty()) finishCase(caseIndex);
        changed_.notify_all();
    }

    // A job beside the case's own, on a worker of this core.
    AskCpu makeAskCpu(size_t core, const Case& testCase) const
    {
        return [this, core, &testCase](const std::string& backend, const Job& job) {
            const std::chrono::duration<double> timeout(options_.timeoutSeconds.value_or(testCase.timeoutSeconds));
            const JobReport report = steps_.run(backend, static_cast<int>(core), job, timeout);
            if (report.outcome != JobOutcome::kDone)
                throw EnvironmentError(fmt::format("{} gave no answer: {}", backend, report.text));
            return steps_.readPlanes(testCase, report.result);
        };
    }

    bool isUnchanged(const Case& testCase, const std::string& inputKey) const
    {
        if (!options_.passedBefore) return false;
        const auto passed = options_.passedBefore->find(testCase.name);
        if (passed == options_.passedBefore->end() || passed->second.key != inputKey) return false;
        return std::all_of(options_.backends.begin(), options_.backends.end(),
                           [&](const std::string& backend) { return passed->second.backends.contains(backend); });
    }

    void recordBrokenInput(const std::string& line)
    {
        // One file may break on several backends at once: a line says it for all.
        auto& lines = run_.brokenFiles;
        if (std::find(lines.begin(), lines.end(), line) == lines.end()) lines.push_back(line);
        if (options_.keepGoing) return;
        run_.stoppedEarly = true;
        schedule_.stop();
    }

    void runTask(std::unique_lock<std::mutex>& lock, size_t core, const Task& task)
    {
        const std::string& backend = order_[task.backend];
        const Clock::time_point start = Clock::now();
        observer_.startBackend(backend, run_.cases[task.caseIndex]);
        CaseFlight& flight = *flights_[task.caseIndex];
        lock.unlock();

        Answer answer;
        std::string brokenInput;
        if (const std::string error = openWorker(core, backend); !error.empty()) {
            answer.result = makeErrorResult(backend, error);
        } else {
            try {
                answer = askBackend(cases_[task.caseIndex], flight.prepared(), flight.judge(), backend,
                                    static_cast<int>(core), options_, steps_, interrupted_);
            } catch (const InputError& failure) {
                brokenInput = failure.what();
                answer = {makeErrorResult(backend, brokenInput), {}, {}};
            } catch (const ShaderError& failure) { // found while it ran
                answer = {makeErrorResult(backend, failure.what()), {}, {}};
            }
        }

        const bool cutOff = interrupted_ && answer.planes.empty();
        CaseFlight::Settled settled;
        if (!cutOff) settled = flight.take(std::move(answer), isExpectedToRepeat(backend));
        lock.lock();
        if (!brokenInput.empty()) recordBrokenInput(brokenInput);
        record(task.caseIndex, std::move(settled));
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
        const auto record = run_.backends.find(backend);
        return record != run_.backends.end() && isSoftwareRasterizer(record->second.fingerprint);
    }

    void record(size_t caseIndex, CaseFlight::Settled settled)
    {
        for (const std::string& line : settled.brokenInput)
            recordBrokenInput(line);
        for (BackendResult& result : settled.results)
            recordVerdict(caseIndex, std::move(result));
    }

    // No other thread has a task of this case any more, so the lock can be released while planes are written.
    void completeCase(std::unique_lock<std::mutex>& lock, size_t caseIndex)
    {
        CaseFlight& flight = *flights_[caseIndex];
        record(caseIndex, flight.finish());
        CaseResult copy = run_.cases[caseIndex];
        lock.unlock();
        flight.writePlanes(copy);
        if (steps_.keep && copy.backends.size() == options_.backends.size()) {
            steps_.keep(cases_[caseIndex], flight.prepared(), copy, devices());
        }
        lock.lock();
        run_.cases[caseIndex] = std::move(copy);
        finishCase(caseIndex);
        flights_[caseIndex].reset();
    }

    // Of a case that could not be prepared.
    void recordError(size_t caseIndex, BackendResult result)
    {
        const Judgement judgement =
            applyKnownFailures(cases_[caseIndex], result.backend, options_.today, {result.verdict, result.reason});
        result.verdict = judgement.verdict;
        result.reason = judgement.reason;
        recordVerdict(caseIndex, std::move(result));
    }

    void recordVerdict(size_t caseIndex, BackendResult result)
    {
        if (run_.firstVerdictMs < 0 && result.verdict != Verdict::kSkip) {
            run_.firstVerdictMs = millisecondsSince(options_.processStart);
        }
        if (tallyOf(result.verdict) == Tally::kFailed) ++failures_;
        noteGoldens(cases_[caseIndex], result);
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

    // A golden holds for the device that it was recorded on; of another one a reader is told.
    void noteGoldens(const Case& testCase, BackendResult& result)
    {
        for (ExpectationResult& expectation : result.expectations) {
            const auto* golden = std::get_if<GoldenSource>(&testCase.expectations.at(expectation.index).source);
            if (golden == nullptr || !expectation.judged || !expectation.note.empty()) continue;
            const std::lock_guard lock(backendsMutex_);
            const auto record = run_.backends.find(result.backend);
            if (record == run_.backends.end()) continue;
            Fingerprint here = record->second.fingerprint;
            here.backend = result.backend;
            expectation.note = describeGoldenOrigin(golden->file, here);
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
            result.reason = whyNotOn(cases_[caseIndex], backend);
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
    std::vector<std::string> order_; // of the backends in the schedule
    const ExecuteSteps& steps_;
    RunObserver& observer_;
    const std::atomic<bool>& interrupted_;
    RunResult& run_;
    std::vector<std::unique_ptr<CaseFlight>> flights_;
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
