#include "harness/scene/file_io.h"

#include "harness/base/error.h"

#include <fmt/format.h>

#include <atomic>
#include <fstream>
#include <system_error>

#include <unistd.h>

namespace crossray {

namespace {

constexpr uintmax_t kMaxFileBytes = uintmax_t{1} << 32;

} // namespace

std::string readWholeFile(const std::filesystem::path& file)
{
    const auto fail = [&](const std::string& what) { throw InputError({file.string(), 0, 0}, what); };
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(file, error);
    if (!std::filesystem::exists(status)) fail("no such file; allowed: a file that exists");
    if (!std::filesystem::is_regular_file(status)) fail("not a regular file; allowed: a regular file");
    const uintmax_t size = std::filesystem::file_size(file, error);
    if (error) fail(fmt::format("cannot be read ({})", error.message()));
    if (size > kMaxFileBytes) fail(fmt::format("{} bytes; allowed: up to {}", size, kMaxFileBytes));
    std::string bytes(static_cast<size_t>(size), '\0');
    std::ifstream stream(file, std::ios::binary);
    if (!stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size())))
        fail("cannot be read; allowed: a readable file");
    return bytes;
}

void writeWholeFile(const std::filesystem::path& file, std::string_view bytes)
{
    static std::atomic<unsigned> counter{0};
    std::filesystem::path aside = file;
    aside += fmt::format(".{}.{}.part", ::getpid(), counter++);
    std::ofstream stream(aside, std::ios::binary | std::ios::trunc);
    stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    stream.close(); // what is still buffered can fail here
    std::error_code error;
    if (stream) std::filesystem::rename(aside, file, error);
    if (stream && !error) return;
    std::error_code ignored;
    std::filesystem::remove(aside, ignored);
    throw EnvironmentError(fmt::format("{}: cannot be written; allowed: a writable folder with room", file.string()));
}

} // namespace crossray
