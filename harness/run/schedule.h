// Who does what next. One thread a core asks; it prepares cases and runs jobs on the workers that are pinned to its
// core, so that a core has one thing to do at any time. Not thread-safe by itself: the caller holds a lock.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace crossray {

struct Task {
    enum class Kind {
        kPrepare, // make the case's data and jobs
        kRun,     // run a prepared case on a backend
        kWait,    // nothing now: ask again when another task has ended
        kDone,    // nothing any more
    } kind = Kind::kDone;
    size_t caseIndex = 0;
    size_t backend = 0;
};

// A core stays with the backend whose worker is warm on it as long as that has work: a worker costs tens of
// milliseconds to start and tens of megabytes to keep. Cases that are prepared and not yet answered by all backends are
// bounded in number and bytes.
class Schedule {
  public:
    struct Limits {
        size_t casesInFlight = 48;
        size_t bytesInFlight = size_t{256} << 20;
        double workerStartMs = 150; // a second worker for a backend is worth it when more work than this waits
    };

    // `applies[case][backend]`: whether the case runs there. `caseBytes`: what a case keeps in memory while in flight.
    Schedule(std::vector<std::vector<bool>> applies, std::vector<size_t> caseBytes, size_t cores, Limits limits);

    Task next(size_t core);
    // The case is ready; `usable` is false when it could not be prepared: none of its backends will run.
    void finishPrepare(size_t caseIndex, bool usable);
    void finishRun(size_t core, size_t caseIndex, size_t backend, double milliseconds);
    // No new task from here on; those handed out end as usual.
    void stop() { stopped_ = true; }
    bool isComplete(size_t caseIndex) const;

  private:
    enum class State { kWaiting, kReady, kRunning, kDone };
    struct CaseState {
        std::vector<State> backends; // kWaiting until the case is prepared
        bool inFlight = false;
        size_t open = 0; // backends that are not done
    };
    struct BackendState {
        size_t ready = 0; // jobs that could run now
        double totalMs = 0;
        size_t finished = 0;
    };

    bool canPrepare() const;
    bool isWorthAWorker(size_t core, size_t backend) const;
    size_t chooseBackend(size_t core) const;
    Task takeRun(size_t core, size_t backend);
    void complete(size_t caseIndex);

    std::vector<CaseState> cases_;
    std::vector<BackendState> backends_;
    std::vector<size_t> caseBytes_;
    std::vector<std::vector<bool>> warm_; // [core][backend]
    std::vector<size_t> current_;         // the backend a core is with
    Limits limits_;
    size_t nextCase_ = 0;
    size_t firstOpen_ = 0; // no case before it has a ready job
    size_t inFlight_ = 0;
    size_t bytesInFlight_ = 0;
    bool stopped_ = false;
};

} // namespace crossray
