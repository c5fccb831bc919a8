// One thread that does one thing at a time, for many who ask: of each kind the newest request counts.
#pragma once

#include "harness/base/work_watch.h"

#include <array>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

namespace crossray {

// A trace is short and goes before a render.
enum class WorkKind { kTrace, kRender };

enum class WorkEnd {
    kDone,
    kSuperseded, // a newer request of the kind took its place
    kCancelled,  // somebody ended it
};

// Thread-safe.
class LatestQueue {
  public:
    using Clock = std::chrono::steady_clock;
    // How long work that is not wanted any more may go on to its own end, before its watch is interrupted: a worker
    // that is killed costs more to start again than most jobs take.
    static constexpr std::chrono::milliseconds kGrace{300};

    LatestQueue();
    ~LatestQueue(); // cancels what waits and runs, and waits for it

    // Blocks until the queue's thread has done the work, or it is known that it is not wanted any more: then nobody
    // hears what it made. Rethrows what the work throws.
    WorkEnd run(WorkKind kind, std::function<void(WorkWatch&)> work);
    // Ends what runs and what waits, at once. Returns whether there was anything.
    bool cancel();
    // The same for all that is still to come.
    void close();

    struct State {
        bool isBusy = false;
        WorkWatch::Progress progress;
        double seconds = 0; // that the work has taken so far
    };
    State state() const;

  private:
    struct Ticket {
        WorkKind kind;
        std::function<void(WorkWatch&)> work;
        WorkWatch watch;
        std::optional<WorkEnd> end{};
        std::exception_ptr failure{};
        Clock::time_point started{}, unwantedSince{};
    };

    void serve();
    void finish(Ticket& ticket, WorkEnd end);
    void interruptWhenDue(std::unique_lock<std::mutex>& lock);

    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::array<std::shared_ptr<Ticket>, 2> waiting_; // by kind
    std::shared_ptr<Ticket> running_;
    bool isClosed_ = false, isOver_ = false;
    std::thread thread_;
};

} // namespace crossray
