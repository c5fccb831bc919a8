// Long work on one thread that others may watch and end early: an image's rows say how far it is and learn whether
// anybody still waits for it.
#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <string>

namespace crossray {

// Thrown where work is ended early. No Error: nothing is wrong, and nobody on the way shall take it for a verdict.
class WorkCancelled : public std::exception {
  public:
    const char* what() const noexcept override { return "the work was ended early"; }
};

// Thread-safe.
class WorkWatch {
  public:
    void cancel() { isCancelled_ = true; }
    bool isCancelled() const { return isCancelled_; }
    // Not at the work's next word, but now: what it waits for in other processes is to be killed.
    void interrupt() { isCancelled_ = isInterrupted_ = true; }
    bool isInterrupted() const { return isInterrupted_; }
    // A new part of the work begins. Throws WorkCancelled.
    void begin(std::string what, size_t total = 1);
    // Throws WorkCancelled.
    void note(size_t done, size_t total);

    struct Progress {
        std::string what;
        size_t done = 0, total = 0;
    };
    Progress progress() const;

  private:
    std::atomic<bool> isCancelled_ = false, isInterrupted_ = false;
    std::atomic<size_t> done_ = 0, total_ = 0;
    mutable std::mutex mutex_; // guards what_
    std::string what_;
};

// While it lives, work on this thread is watched.
class WatchedWork {
  public:
    explicit WatchedWork(WorkWatch& watch);
    ~WatchedWork();
    WatchedWork(const WatchedWork&) = delete;
    WatchedWork& operator=(const WatchedWork&) = delete;

  private:
    WorkWatch* before_;
};

// Called by loops that may take long, once a row or so; without a watch it does nothing. Throws WorkCancelled.
void noteWork(size_t done, size_t total);

} // namespace crossray
