// Frames on the pipes between the pool and a worker: a mark, a kind, a length, the payload.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace crossray {

enum class FrameKind : uint32_t {
    kGreeting = 1,     // worker: WorkerGreeting; the device is open
    kRefusal,          // worker: text; the device cannot be opened
    kJob,              // pool: encoded job
    kResult,           // worker: encoded result
    kShaderError,      // worker: text
    kEnvironmentError, // worker: text
    kUnknownProgram,   // worker: nothing; the job is to be sent again with all its code
    kTaken,            // worker: nothing; the job has arrived whole, what happens from here on is its doing
};

struct FrameHeader {
    uint32_t mark = 0;
    uint32_t kind = 0;
    uint64_t length = 0;
};
inline constexpr uint32_t kFrameMark = 0x31465243; // "CRF1"
inline constexpr uint64_t kMaxFrameBytes = uint64_t{4} << 30;

struct Frame {
    FrameKind kind = FrameKind::kJob;
    std::vector<std::byte> payload;
    std::string text() const { return {reinterpret_cast<const char*>(payload.data()), payload.size()}; }
};

// Blocking, for the worker's side. Nothing at the end of the stream; throws InputError on a frame that is none.
std::optional<Frame> readFrame(int fd);
// False when the reader is gone.
bool writeFrame(int fd, FrameKind kind, std::span<const std::byte> payload);
bool writeFrame(int fd, FrameKind kind, const std::string& text);

FrameHeader makeFrameHeader(FrameKind kind, size_t length);
// Throws InputError when the mark, the kind or the length is none that the protocol knows.
void checkFrameHeader(const FrameHeader& header);

} // namespace crossray
