#include "harness/run/worker_pool.h"

#include "harness/base/error.h"
#include "harness/base/stopwatch.h"
#include "harness/run/job_codec.h"
#include "harness/run/worker_backends.h"
#include "harness/run/worker_process.h"
#include "harness/run/worker_server.h"

#include <fmt/format.h>

#include <map>
#include <mutex>
#include <sched.h>
#include <unistd.h>

namespace crossray {

using Clock = std::chrono::steady_clock;

namespace {

constexpr std::chrono::milliseconds kDeathGrace(2000); // for a process whose pipe has closed to be seen dead

// Processes in a row that may be lost before a job was begun. What kills one is not the job: it knows nothing of it.
constexpr int kMostLosses = 5;

// The cores that this process may use.
std::vector<int> ownCpus()
{
    cpu_set_t set;
    CPU_ZERO(&set);
    std::vector<int> cpus;
    if (::sched_getaffinity(0, sizeof(set), &set) != 0) return cpus;
    for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu) {
        if (CPU_ISSET(static_cast<size_t>(cpu), &set)) cpus.push_back(cpu);
    }
    return cpus;
}

Clock::time_point deadlineAfter(std::chrono::duration<double> timeout)
{
    const double seconds = std::min(timeout.count(), 1e8); // within the clock's range
    return Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

MemoryUse largerOf(const MemoryUse& a, const MemoryUse& b)
{
    return a.peak >= b.peak ? a : b;
}

// One (backend, core) pair: the process, if one lives, and what it is known to hold.
class Worker {
  public:
    Worker(WorkerCommand command, std::string backend, std::chrono::duration<double> startTimeout)
        : command_(std::move(command)), backend_(std::move(backend)), startTimeout_(startTimeout)
    {
    }

    JobReport run(const Job& job, std::chrono::duration<double> timeout);
    Fingerprint open(); // throws EnvironmentError
    void restart();
    void dismiss();
    int processId();
    MemoryUse memory(); // the largest of its processes

  private:
    // How an attempt to open the device, or to hand a job over, came to nothing.
    struct Setback {
        JobReport report;
        bool isFinal = false; // another process would fare no better
    };
    std::optional<Setback> start();
    // start() until it succeeds, or the losses are too many or took too long; then a report about the backend.
    std::optional<JobReport> startOrGiveUp(int& losses, std::chrono::steady_clock::time_point begin);
    JobReport reportGivenUp(JobReport last, int losses) const;
    // Nothing when the process died before it had read the whole job, with its end in `loss`.
    std::optional<JobReport> exchangeJob(const Job& job, std::chrono::duration<double> timeout, JobReport& loss);
    JobReport reportLoss(WorkerProcess::Answer answer, double timeoutSeconds);
    void drop();

    const WorkerCommand command_;
    const std::string backend_;
    const std::chrono::duration<double> startTimeout_;

    std::mutex running_;      // held while a job runs
    std::mutex processMutex_; // guards the pointer alone, so that process ids can be had while a job runs
    std::unique_ptr<WorkerProcess> process_;
    WorkerGreeting greeting_;
    std::set<std::string> programs_; // keys whose code the process holds
    std::optional<std::string> refusal_;
    MemoryUse memory_; // the largest of earlier processes
};

void Worker::drop()
{
    std::unique_ptr<WorkerProcess> dead;
    const std::lock_guard lock(processMutex_);
    if (process_) memory_ = largerOf(memory_, process_->memory());
    dead = std::move(process_);
    programs_.clear();
}

JobReport Worker::reportLoss(WorkerProcess::Answer answer, double timeoutSeconds)
{
    JobReport report;
    switch (answer.end) {
    case ExchangeEnd::kTimeout:
        report.outcome = JobOutcome::kTimeout;
        report.text = fmt::format("no answer within {:g} s", timeoutSeconds);
        process_->kill(std::chrono::milliseconds(0));
        break;
    case ExchangeEnd::kGarbage:
        report.outcome = JobOutcome::kCrash;
        report.text = "the worker's answer is none: " + answer.text;
        process_->kill(std::chrono::milliseconds(0));
        break;
    default:
        report.outcome = JobOutcome::kCrash;
        report.text = process_->kill(kDeathGrace);
        break;
    }
    report.logLines = process_->log().lines();
    drop();
    return report;
}

std::optional<Worker::Setback> Worker::start()
{
    if (process_ && process_->isAlive()) return std::nullopt;
    drop(); // one that ended between jobs harmed none
    if (refusal_) return Setback{{JobOutcome::kEnvironmentError, {}, *refusal_, {}, 0}, true};
    {
        auto process = std::make_unique<WorkerProcess>(command_);
        const std::lock_guard lock(processMutex_);
        process_ = std::move(process);
    }
    WorkerProcess::Answer answer = process_->exchange(std::nullopt, {}, deadlineAfter(startTimeout_));
    if (answer.end == ExchangeEnd::kAnswered && answer.frame.kind == FrameKind::kRefusal) {
        refusal_ = answer.frame.text();
        JobReport report{JobOutcome::kEnvironmentError, {}, *refusal_, process_->log().lines(), 0};
        drop();
        return Setback{std::move(report), true};
    }
    try {
        if (answer.end == ExchangeEnd::kAnswered) {
            if (answer.frame.kind != FrameKind::kGreeting) throw InputError("it answers before it is asked");
            greeting_ = decodeGreeting(answer.frame.payload);
            return std::nullopt;
        }
    } catch (const InputError& error) {
        answer.end = ExchangeEnd::kGarbage;
        answer.text = error.what();
    }
    JobReport report = reportLoss(std::move(answer), startTimeout_.count());
    report.text = "while opening the device: " + report.text;
    return Setback{std::move(report), false};
}

std::optional<JobReport> Worker::startOrGiveUp(int& losses, Clock::time_point begin)
{
    while (std::optional<Setback> setback = start()) {
        if (setback->isFinal) return std::move(setback->report);
        // A driver that hangs takes the whole time once; one that crashes is soon tried again.
        if (++losses >= kMostLosses || Clock::now() - begin >= startTimeout_)
            return reportGivenUp(std::move(setback->report), losses);
    }
    return std::nullopt;
}

JobReport Worker::reportGivenUp(JobReport last, int losses) const
{
    last.outcome = JobOutcome::kEnvironmentError;
    last.text = losses == 1
                    ? fmt::format("{} is broken: a worker ended before a job was begun, {}", backend_, last.text)
                    : fmt::format("{} is broken: {} workers in a row ended before a job was begun, the last {}",
                                  backend_, losses, last.text);
    return last;
}

std::optional<JobReport> Worker::exchangeJob(const Job& job, std::chrono::duration<double> timeout, JobReport& loss)
{
    const Clock::time_point deadline = deadlineAfter(timeout);
    JobEncoding encoding{greeting_.precision, programFormOf(backend_), &programs_};
    WorkerProcess::Answer answer = process_->exchange(FrameKind::kJob, encodeJob(job, encoding), deadline);
    if (answer.end == ExchangeEnd::kAnswered && answer.frame.kind == FrameKind::kUnknownProgram) {
        programs_.clear();
        answer = process_->exchange(FrameKind::kJob, encodeJob(job, encoding), deadline);
    }
    if (answer.end == ExchangeEnd::kDied && !answer.taken) {
        loss = reportLoss(std::move(answer), timeout.count());
        return std::nullopt;
    }
    if (answer.end != ExchangeEnd::kAnswered) return reportLoss(std::move(answer), timeout.count());
    for (const ProgramSource& program : job.programs) {
        if (!program.key.empty()) programs_.insert(program.key);
    }
    JobReport report;
    switch (answer.frame.kind) {
    case FrameKind::kResult:
        try {
            report.result = decodeResult(answer.frame.payload);
        } catch (const InputError& error) {
            return reportLoss({ExchangeEnd::kGarbage, {}, error.what(), true}, timeout.count());
        }
        break;
    case FrameKind::kShaderError:
        report.outcome = JobOutcome::kShaderError;
        report.text = answer.frame.text();
        break;
    case FrameKind::kEnvironmentError: // the device may be lost: the next job gets a fresh one
        report.outcome = JobOutcome::kEnvironmentError;
        report.text = answer.frame.text();
        report.logLines = process_->log().lines();
        drop();
        break;
    default:
        return reportLoss({ExchangeEnd::kGarbage, {}, "an answer of another kind", true}, timeout.count());
    }
    return report;
}

JobReport Worker::run(const Job& job, std::chrono::duration<double> timeout)
{
    const std::lock_guard lock(running_);
    // A process that is killed between two jobs may still look alive when the next one is handed over. What dies while
    // it opens its device, or before it has read the job, was not killed by the job: another one is asked.
    const Clock::time_point opening = Clock::now();
    for (int losses = 0;;) {
        if (std::optional<JobReport> failed = startOrGiveUp(losses, opening)) return *std::move(failed);
        process_->log().clear(); // what it said before is not this job's
        const Clock::time_point begin = Clock::now();
        JobReport loss;
        if (std::optional<JobReport> report = exchangeJob(job, timeout, loss)) {
            report->milliseconds = millisecondsSince(begin);
            return *std::move(report);
        }
        if (++losses >= kMostLosses) {
            loss.text = "before it had read the job: " + loss.text;
            return reportGivenUp(std::move(loss), losses);
        }
    }
}

Fingerprint Worker::open()
{
    const std::lock_guard lock(running_);
    int losses = 0;
    if (const std::optional<JobReport> failed = startOrGiveUp(losses, Clock::now())) {
        std::string text = refusal_ ? fmt::format("{}: {}", backend_, failed->text) : failed->text;
        if (!failed->logLines.empty()) text += "; its last line: " + failed->logLines.back();
        throw EnvironmentError(text);
    }
    return greeting_.fingerprint;
}

void Worker::restart()
{
    const std::lock_guard lock(running_);
    drop();
}

void Worker::dismiss()
{
    const std::lock_guard lock(processMutex_);
    if (process_) process_->dismiss();
}

int Worker::processId()
{
    const std::lock_guard lock(processMutex_);
    return process_ ? process_->pid() : -1;
}

MemoryUse Worker::memory()
{
    const std::lock_guard lock(processMutex_);
    return process_ ? largerOf(memory_, process_->memory()) : memory_;
}

} // namespace

struct WorkerPool::Impl {
    Worker& workerOf(const std::string& backend, int core);
    std::vector<Worker*> allWorkers() const;

    WorkerOptions options;
    std::vector<int> cpus = ownCpus();
    mutable std::mutex mutex;
    std::map<std::pair<std::string, int>, std::unique_ptr<Worker>> workers;
};

Worker& WorkerPool::Impl::workerOf(const std::string& backend, int core)
{
    const std::lock_guard lock(mutex);
    std::unique_ptr<Worker>& worker = workers[{backend, core}];
    if (!worker) {
        WorkerCommand command;
        command.executable = options.executable.empty() ? "/proc/self/exe" : options.executable;
        command.arguments = {"worker", "--backend", backend};
        if (options.validation) command.arguments.emplace_back("--validation");
        command.environment = workerEnvironment(backend, options);
        if (!cpus.empty()) command.cpu = cpus[static_cast<size_t>(std::max(core, 0)) % cpus.size()];
        worker = std::make_unique<Worker>(std::move(command), backend, options.startTimeout);
    }
    return *worker;
}

std::vector<Worker*> WorkerPool::Impl::allWorkers() const
{
    const std::lock_guard lock(mutex);
    std::vector<Worker*> all;
    for (const auto& [place, worker] : workers)
        all.push_back(worker.get());
    return all;
}

WorkerPool::WorkerPool(const WorkerOptions& options) : impl_(std::make_unique<Impl>())
{
    impl_->options = options;
}

WorkerPool::~WorkerPool()
{
    for (Worker* worker : impl_->allWorkers())
        worker->dismiss(); // all at once, then one is waited for after the other
}

JobReport WorkerPool::run(const std::string& backend, int core, const Job& job, std::chrono::duration<double> timeout)
{
    return impl_->workerOf(backend, core).run(job, timeout);
}

Fingerprint WorkerPool::fingerprint(const std::string& backend, int core)
{
    return impl_->workerOf(backend, core).open();
}

void WorkerPool::restart(const std::string& backend, int core)
{
    impl_->workerOf(backend, core).restart();
}

std::vector<int> WorkerPool::processIds(const std::string& backend) const
{
    std::vector<int> ids;
    const std::lock_guard lock(impl_->mutex);
    for (const auto& [place, worker] : impl_->workers) {
        const int id = place.first == backend ? worker->processId() : -1;
        if (id > 0) ids.push_back(id);
    }
    return ids;
}

uint64_t WorkerPool::peakMemory() const
{
    uint64_t sum = 0;
    std::map<std::string, uint64_t> shared; // by backend
    const std::lock_guard lock(impl_->mutex);
    for (const auto& [place, worker] : impl_->workers) {
        const MemoryUse use = worker->memory();
        uint64_t& common = shared[place.first];
        common = std::max(common, use.shared);
        sum += use.peak - std::min(use.peak, use.shared);
    }
    for (const auto& [backend, bytes] : shared)
        sum += bytes;
    return sum;
}

int runWorker(const std::string& backend, int requestFd, int replyFd, bool validation)
{
    return serveJobs(requestFd, replyFd, [&] {
        DeviceOptions options;
        options.validation = validation;
        return openDevice(backend, options);
    });
}

} // namespace crossray
