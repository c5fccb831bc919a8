#include "harness/run/worker_frame.h"

#include "harness/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <sys/uio.h>
#include <unistd.h>

namespace crossray {

namespace {

// Number of bytes read before the end of the stream.
size_t readFully(int fd, std::span<std::byte> target)
{
    size_t done = 0;
    while (done < target.size()) {
        const ssize_t count = ::read(fd, target.data() + done, target.size() - done);
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) break;
        done += static_cast<size_t>(count);
    }
    return done;
}

} // namespace

FrameHeader makeFrameHeader(FrameKind kind, size_t length)
{
    return {kFrameMark, static_cast<uint32_t>(kind), length};
}

void checkFrameHeader(const FrameHeader& header)
{
    if (header.mark != kFrameMark) throw InputError(fmt::format("malformed frame: mark {:08x}", header.mark));
    if (header.kind < static_cast<uint32_t>(FrameKind::kGreeting) ||
        header.kind > static_cast<uint32_t>(FrameKind::kTaken)) {
        throw InputError(fmt::format("malformed frame: kind {}", header.kind));
    }
    if (header.length > kMaxFrameBytes) throw InputError(fmt::format("malformed frame: {} bytes", header.length));
}

std::optional<Frame> readFrame(int fd)
{
    FrameHeader header;
    const size_t got = readFully(fd, std::as_writable_bytes(std::span(&header, 1)));
    if (got == 0) return std::nullopt;
    if (got < sizeof(header)) throw InputError("malformed frame: it ends in its header");
    checkFrameHeader(header);
    Frame frame;
    frame.kind = static_cast<FrameKind>(header.kind);
    frame.payload.resize(header.length);
    if (readFully(fd, frame.payload) < header.length) throw InputError("malformed frame: it ends early");
    return frame;
}

bool writeFrame(int fd, FrameKind kind, std::span<const std::byte> payload)
{
    FrameHeader header = makeFrameHeader(kind, payload.size());
    size_t done = 0;
    const size_t total = sizeof(header) + payload.size();
    while (done < total) {
        iovec parts[2];
        int count = 0;
        if (done < sizeof(header)) parts[count++] = {reinterpret_cast<char*>(&header) + done, sizeof(header) - done};
        const size_t skip = done > sizeof(header) ? done - sizeof(header) : 0;
        parts[count++] = {const_cast<std::byte*>(payload.data()) + skip, payload.size() - skip};
        const ssize_t written = ::writev(fd, parts, count);
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return false;
        done += static_cast<size_t>(written);
    }
    return true;
}

bool writeFrame(int fd, FrameKind kind, const std::string& text)
{
    return writeFrame(fd, kind, std::as_bytes(std::span(text.data(), text.size())));
}

} // namespace crossray
