// What the libFuzzer targets share. Each takes a reader as the program calls it, on any bytes: it may answer, or refuse
// with an error of the program's own; anything else (another exception, a crash, a sanitizer's finding, a hang, a leak)
// is a finding.
#pragma once

#include "harness/base/error.h"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include <sys/mman.h>
#include <unistd.h>

namespace crossray::fuzz {

inline void expect(bool holds, std::string_view claim)
{
    if (holds) return;
    std::fprintf(stderr, "does not hold: %.*s\n", static_cast<int>(claim.size()), claim.data());
    std::abort();
}

inline std::string_view textOf(const uint8_t* data, size_t size)
{
    return {reinterpret_cast<const char*>(data), size};
}

// A file that is in no folder.
class MemoryFile {
  public:
    explicit MemoryFile(std::string_view bytes) : descriptor_(::memfd_create("fuzz", MFD_CLOEXEC))
    {
        expect(descriptor_ >= 0, "a file in memory can be made");
        const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
        expect(written == static_cast<ssize_t>(bytes.size()), "a file in memory can be written");
    }
    ~MemoryFile() { ::close(descriptor_); }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;

    std::filesystem::path path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

  private:
    int descriptor_;
};

// The answer, or nothing where the reader refused. What it says then is one line that names the file.
template <typename Read>
auto readOrRefuse(const Read& read, const std::string& name) -> std::optional<decltype(read())>
{
    try {
        return read();
    } catch (const InputError& error) {
        const std::string_view line = error.what();
        expect(line.find('\n') == std::string_view::npos, "a message is one line");
        expect(line.starts_with(name), "a message begins with the file's name");
    }
    return std::nullopt;
}

} // namespace crossray::fuzz
