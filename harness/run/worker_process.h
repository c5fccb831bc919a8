// One worker process as the pool sees it: start, exchange under a deadline, log, end.
#pragma once

#include "harness/run/worker_frame.h"

#include <atomic>
#include <chrono>
#include <deque>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <sys/types.h>
#include <utility>
#include <vector>

namespace crossray {

struct WorkerCommand {
    std::filesystem::path executable;
    std::vector<std::string> arguments; // after the program's name; "--request-fd 3 --reply-fd 4" is appended
    std::map<std::string, std::string> environment; // on top of this process's own; an empty value removes the variable
    int cpu = -1;                                   // the core to be pinned to; -1: none
};

class UniqueFd {
  public:
    UniqueFd() = default;
    explicit UniqueFd(int fd) : fd_(fd) {}
    UniqueFd(UniqueFd&& other) noexcept : fd_(other.release()) {}
    UniqueFd& operator=(UniqueFd&& other) noexcept;
    ~UniqueFd() { reset(); }
    int get() const { return fd_; }
    int release();
    void reset();

  private:
    int fd_ = -1;
};

// The worker's last lines on stdout and stderr.
class LogRing {
  public:
    static constexpr size_t kLines = 40;
    static constexpr size_t kLineBytes = 1000; // what is longer is cut
    void add(std::string_view text);
    void clear();
    std::vector<std::string> lines() const;

  private:
    std::deque<std::string> lines_;
    std::string partial_;
};

// How an exchange ended.
enum class ExchangeEnd { kAnswered, kDied, kTimeout, kGarbage };

struct MemoryUse {
    uint64_t peak = 0;   // resident at most, bytes
    uint64_t shared = 0; // of that, pages of files: the libraries, which other workers of the backend map as well
};

class WorkerProcess {
  public:
    using Deadline = std::chrono::steady_clock::time_point;

    // Throws EnvironmentError when no process can be started.
    explicit WorkerProcess(const WorkerCommand& command);
    ~WorkerProcess(); // ends it: kindly first
    WorkerProcess(const WorkerProcess&) = delete;
    WorkerProcess& operator=(const WorkerProcess&) = delete;

    // Sends a frame (nothing when `request` is empty) and waits for one, past the word that the former was taken. After
    // any end but kAnswered the process is to be disposed of by kill().
    struct Answer {
        ExchangeEnd end = ExchangeEnd::kDied;
        Frame frame;
        std::string text;   // what was wrong with the frame
        bool taken = false; // the request had arrived whole before this end
    };
    Answer exchange(const std::optional<FrameKind>& request, std::span<const std::byte> payload, Deadline deadline);

    // Kills the process if it lives and says how it ended: "signal 11 (Segmentation fault)", "exit code 3". A process
    // that is about to end by itself is given a moment, so that the cause is its own.
    std::string kill(std::chrono::milliseconds grace);

    // The worker's cue to end by itself, with its driver's caches written.
    void dismiss() { request_.reset(); }

    pid_t pid() const { return pid_; }
    bool isAlive();     // reaps it when it is dead
    LogRing& log();     // with what has arrived until now
    MemoryUse memory(); // of a dead process, the last known; from any thread

  private:
    bool waitUntil(Deadline deadline);
    void drainLog();
    void closePipes();

    pid_t pid_ = -1;
    std::atomic<bool> reaped_ = false;
    int status_ = 0;
    UniqueFd request_, reply_, logPipe_;
    LogRing log_;
    std::mutex memoryMutex_;
    MemoryUse memory_;
};

// "signal 11 (Segmentation fault)" or "exit code 3" of a status from waitpid.
std::string describeStatus(int status);

} // namespace crossray
