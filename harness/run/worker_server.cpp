#include "harness/run/worker_server.h"

#include "harness/base/error.h"
#include "harness/run/job_codec.h"
#include "harness/run/worker_frame.h"
#include "harness/run/worker_pool.h"

#include <chrono>
#include <csignal>
#include <list>
#include <map>
#include <new>
#include <poll.h>
#include <thread>
#include <unistd.h>

namespace crossray {

namespace {

constexpr size_t kProgramsHeld = 1024;
constexpr auto kGrace = std::chrono::seconds(3);

// Sources by key, the least recently used dropped first.
class ProgramStore {
  public:
    const ProgramSource* find(const std::string& key)
    {
        const auto found = byKey_.find(key);
        if (found == byKey_.end()) return nullptr;
        programs_.splice(programs_.begin(), programs_, found->second);
        return &programs_.front();
    }
    void keep(const ProgramSource& program)
    {
        if (program.key.empty() || find(program.key) != nullptr) return;
        programs_.push_front(program);
        byKey_[program.key] = programs_.begin();
        if (programs_.size() <= kProgramsHeld) return;
        byKey_.erase(programs_.back().key);
        programs_.pop_back();
    }

  private:
    std::list<ProgramSource> programs_;
    std::map<std::string, std::list<ProgramSource>::iterator> byKey_;
};

// Ends the process when the pool is gone and the main thread does not see it, being inside a driver. A death signal of
// the parent would not do: it follows the thread that started the worker, which may end before the pool does.
void watchForParent(int requestFd)
{
    std::thread([requestFd] {
        pollfd watched{requestFd, 0, 0}; // POLLHUP is always reported
        while (::poll(&watched, 1, -1) < 0) {
        }
        std::this_thread::sleep_for(kGrace);
        ::_exit(1);
    }).detach();
}

bool answer(int replyFd, Device& device, ProgramStore& store, std::span<const std::byte> payload)
{
    try {
        const DecodedJob decoded = decodeJob(payload, [&store](const std::string& key) { return store.find(key); });
        if (!decoded.complete) return writeFrame(replyFd, FrameKind::kUnknownProgram, std::string{});
        for (const ProgramSource& program : decoded.job.programs)
            store.keep(program);
        const std::vector<std::byte> result = encodeResult(device.run(decoded.job), device.precision());
        return writeFrame(replyFd, FrameKind::kResult, result);
    } catch (const EnvironmentError& error) {
        return writeFrame(replyFd, FrameKind::kEnvironmentError, error.what());
    } catch (const Error& error) {
        return writeFrame(replyFd, FrameKind::kShaderError, error.what());
    } catch (const std::bad_alloc&) {
        return writeFrame(replyFd, FrameKind::kEnvironmentError, std::string("the worker is out of memory"));
    } catch (const std::exception& error) {
        return writeFrame(replyFd, FrameKind::kEnvironmentError, std::string("unexpected failure: ") + error.what());
    }
}

} // namespace

int serveJobs(int requestFd, int replyFd, const std::function<std::unique_ptr<Device>()>& open)
{
    std::signal(SIGPIPE, SIG_IGN);
    watchForParent(requestFd);
    std::unique_ptr<Device> device;
    try {
        device = open();
        writeFrame(replyFd, FrameKind::kGreeting, encodeGreeting({device->fingerprint(), device->precision()}));
    } catch (const std::exception& error) {
        writeFrame(replyFd, FrameKind::kRefusal, error.what());
        return static_cast<int>(ExitCode::kEnvironment);
    }
    ProgramStore store;
    while (const std::optional<Frame> frame = readFrame(requestFd)) {
        if (frame->kind != FrameKind::kJob) throw InputError("malformed request: a worker answers jobs alone");
        if (!writeFrame(replyFd, FrameKind::kTaken, std::string{})) break;
        if (!answer(replyFd, *device, store, frame->payload)) break;
    }
    return 0;
}

} // namespace crossray
