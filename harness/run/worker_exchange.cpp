// The exchange of one request for one answer with a worker that may die, hang or talk nonsense at any byte.
#include "harness/run/worker_process.h"

#include "harness/base/error.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <poll.h>
#include <pthread.h>
#include <sys/uio.h>
#include <unistd.h>

namespace crossray {

using Clock = std::chrono::steady_clock;

namespace {

constexpr size_t kChunk = 1 << 20;

// A write to a worker that has died must be an error of the call, not the end of this process. The signal is masked for
// this thread alone: a library does not change the disposition of a whole process.
class PipeSignalBlock {
  public:
    PipeSignalBlock()
    {
        sigemptyset(&pipe_);
        sigaddset(&pipe_, SIGPIPE);
        sigset_t pending;
        sigpending(&pending);
        wasPending_ = sigismember(&pending, SIGPIPE) == 1;
        pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
    }
    ~PipeSignalBlock()
    {
        const timespec now{};
        if (!wasPending_) {
            while (sigtimedwait(&pipe_, nullptr, &now) < 0 && errno == EINTR) {
            }
        }
        pthread_sigmask(SIG_SETMASK, &before_, nullptr);
    }
    PipeSignalBlock(const PipeSignalBlock&) = delete;
    PipeSignalBlock& operator=(const PipeSignalBlock&) = delete;

  private:
    sigset_t pipe_{}, before_{};
    bool wasPending_ = false;
};

// A frame on its way out.
class Outgoing {
  public:
    Outgoing(const std::optional<FrameKind>& kind, std::span<const std::byte> payload) : payload_(payload)
    {
        if (!kind) return;
        header_ = makeFrameHeader(*kind, payload.size());
        total_ = sizeof(header_) + payload.size();
    }
    bool isDone() const { return done_ >= total_; }
    // False when the reader is gone.
    bool advance(int fd)
    {
        while (!isDone()) {
            iovec parts[2];
            int count = 0;
            if (done_ < sizeof(header_))
                parts[count++] = {reinterpret_cast<char*>(&header_) + done_, sizeof(header_) - done_};
            const size_t skip = done_ > sizeof(header_) ? done_ - sizeof(header_) : 0;
            if (skip < payload_.size())
                parts[count++] = {const_cast<std::byte*>(payload_.data()) + skip, payload_.size() - skip};
            const ssize_t written = ::writev(fd, parts, count);
            if (written < 0 && errno == EINTR) continue;
            if (written < 0) return errno == EAGAIN;
            done_ += static_cast<size_t>(written);
        }
        return true;
    }

  private:
    FrameHeader header_;
    std::span<const std::byte> payload_;
    size_t total_ = 0, done_ = 0;
};

// A frame on its way in. The payload grows with what has arrived: its announced length is not to be trusted.
class Incoming {
  public:
    bool isDone() const { return headerBytes_ == sizeof(header_) && received_ == header_.length; }
    // False at the end of the stream. Throws InputError on a header that is none.
    bool advance(int fd)
    {
        while (!isDone()) {
            std::span<std::byte> target;
            if (headerBytes_ < sizeof(header_)) {
                target = std::as_writable_bytes(std::span(&header_, 1)).subspan(headerBytes_);
            } else {
                const size_t wanted = std::min<size_t>(header_.length - received_, std::max(kChunk, received_));
                if (payload_.size() < received_ + wanted) payload_.resize(received_ + wanted);
                target = std::span(payload_).subspan(received_, wanted);
            }
            const ssize_t count = ::read(fd, target.data(), target.size());
            if (count < 0 && errno == EINTR) continue;
            if (count < 0) return errno == EAGAIN;
            if (count == 0) return false;
            if (headerBytes_ < sizeof(header_)) {
                headerBytes_ += static_cast<size_t>(count);
                if (headerBytes_ == sizeof(header_)) checkFrameHeader(header_);
            } else {
                received_ += static_cast<size_t>(count);
            }
        }
        return true;
    }
    Frame take() { return {static_cast<FrameKind>(header_.kind), std::move(payload_)}; }

  private:
    FrameHeader header_;
    size_t headerBytes_ = 0, received_ = 0;
    std::vector<std::byte> payload_;
};

int millisecondsUntil(WorkerProcess::Deadline deadline)
{
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
    return static_cast<int>(std::clamp<int64_t>(left, 0, 1'000'000));
}

} // namespace

WorkerProcess::Answer WorkerProcess::exchange(const std::optional<FrameKind>& request,
                                              std::span<const std::byte> payload, Deadline deadline)
{
    const PipeSignalBlock block;
    Outgoing outgoing(request, payload);
    Incoming incoming;
    bool accepts = true; // the request: a worker that stops reading may still have something to say
    bool taken = false;
    try {
        while (true) {
            if (accepts && !outgoing.isDone()) accepts = outgoing.advance(request_.get());
            pollfd watched[3] = {{reply_.get(), POLLIN, 0},
                                 {logPipe_.get(), POLLIN, 0},
                                 {accepts && !outgoing.isDone() ? request_.get() : -1, POLLOUT, 0}};
            const int ready = ::poll(watched, 3, millisecondsUntil(deadline));
            if (ready < 0 && errno != EINTR) return {ExchangeEnd::kDied, {}, {}, taken};
            if (ready > 0 && watched[1].revents != 0) {
                drainLog();
                if ((watched[1].revents & POLLHUP) != 0) logPipe_.reset(); // else poll would return at once for ever
            }
            if (ready > 0 && watched[0].revents != 0) {
                if (!incoming.advance(reply_.get())) return {ExchangeEnd::kDied, {}, {}, taken};
                if (incoming.isDone()) {
                    Frame frame = incoming.take();
                    if (frame.kind != FrameKind::kTaken) return {ExchangeEnd::kAnswered, std::move(frame), {}, true};
                    taken = true;
                    incoming = Incoming();
                }
            }
            if (Clock::now() >= deadline) return {ExchangeEnd::kTimeout, {}, {}, taken};
        }
    } catch (const InputError& error) {
        return {ExchangeEnd::kGarbage, {}, error.what(), taken};
    }
}

} // namespace crossray
