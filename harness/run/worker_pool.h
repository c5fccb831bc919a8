// Worker processes: a driver and its environment are per process, so each backend runs in processes of its own, started
// once, kept warm, pinned to a core, killed on a time-out and replaced after a crash, with the blame on the job that
// ran.
#pragma once

#include "harness/backend/device.h"

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace crossray {

// "lavapipe", "swiftshader", "osmesa", "softpipe", "egl", "cpu32", "cpu64", or "vulkan:NAME" for any other device by
// name.
struct BackendInfo {
    std::string name;
    std::string api;       // "Vulkan", "OpenGL", "none"
    bool byDefault = true; // part of a plain run where it is found
    bool found = false;    // the libraries and ICD files are there (no device is opened to find out)
    std::string missing;   // what to install, when it is not found
};
std::vector<BackendInfo> listBackends();

struct WorkerOptions {
    bool validation = false;
    std::filesystem::path mesaCacheFolder;          // MESA_SHADER_CACHE_DIR of the workers
    int cores = 1;                                  // workers are pinned to cores 0..cores-1 of the process's own set
    std::filesystem::path executable;               // whose "worker" verb calls runWorker(); empty: this program
    std::chrono::duration<double> startTimeout{60}; // a driver that takes longer to open is taken for hung
};

enum class JobOutcome { kDone, kShaderError, kEnvironmentError, kCrash, kTimeout };

struct JobReport {
    JobOutcome outcome = JobOutcome::kDone;
    JobResult result;
    std::string text;                  // error text, or "signal 11 (Segmentation fault)"
    std::vector<std::string> logLines; // the worker's last lines on stderr: crash, timeout
    double milliseconds = 0;           // wall clock from hand-over to answer
};

// Thread-safe. Each (backend, core) pair has at most one process, started on first use.
class WorkerPool {
  public:
    explicit WorkerPool(const WorkerOptions& options);
    ~WorkerPool(); // ends the workers
    // Blocks until a worker of the backend has answered, crashed or timed out. `core` chooses the worker. One that ends
    // before it has begun the job (while it opens its device, between two jobs, before it has read the job) is
    // replaced; after five in a row the report is an environment error that calls the backend broken, and the next job
    // tries again.
    JobReport run(const std::string& backend, int core, const Job& job, std::chrono::duration<double> timeout);
    // Starts a worker ahead of need; returns its device's fingerprint. Throws EnvironmentError when the device cannot
    // be opened.
    Fingerprint fingerprint(const std::string& backend, int core = 0);
    // Ends the worker, which is at rest; the next job gets a fresh one, without what the old one had kept.
    void restart(const std::string& backend, int core);
    // Process ids of live workers. Killing one ends the job that it runs as a crash.
    std::vector<int> processIds(const std::string& backend) const;
    // Sum of the workers' peak resident memory so far, bytes. Pages of libraries count once a backend, not once a
    // worker.
    uint64_t peakMemory() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

// main() of a worker process, of the verb `worker --backend NAME --request-fd N --reply-fd M [--validation]`: reads
// jobs from `requestFd`, answers on `replyFd`, until the former closes. Returns the exit code.
int runWorker(const std::string& backend, int requestFd, int replyFd, bool validation);

// Opens a device in this process. Throws EnvironmentError.
std::unique_ptr<Device> openDevice(const std::string& backend, const DeviceOptions& options);

// Job and its answer as bytes; decode throws InputError on anything malformed.
std::vector<std::byte> encodeJob(const Job& job);
Job decodeJob(std::span<const std::byte> bytes);

} // namespace crossray
