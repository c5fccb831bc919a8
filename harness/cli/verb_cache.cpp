#include "harness/cli/verbs.h"
#include "harness/run/cache_folder.h"
#include "harness/run/environment.h"

#include <fmt/format.h>

namespace crossray {

namespace {

std::string formatBytes(uint64_t bytes)
{
    if (bytes < 1024) return fmt::format("{} B", bytes);
    const double kibibytes = static_cast<double>(bytes) / 1024;
    return kibibytes < 1024 ? fmt::format("{:.1f} KiB", kibibytes) : fmt::format("{:.1f} MiB", kibibytes / 1024);
}

} // namespace

uint64_t cacheBound(const GlobalOptions& global)
{
    return global.cacheMebibytes << 20;
}

int showCache(const GlobalOptions& global)
{
    const Folders folders = findFolders(global.shaders, global.cases, global.cache);
    fmt::print("{}\n", folders.cache.string());
    uint64_t sum = 0;
    for (const CachePart& part : measureCache(folders.cache)) {
        fmt::print("{:<8} {:>6} files {:>11}  {}\n", part.name, part.files, formatBytes(part.bytes), part.what);
        sum += part.bytes;
    }
    const uint64_t bound = cacheBound(global);
    fmt::print("{:<8} {:>24}  of at most {}\n", "all", formatBytes(sum), formatBytes(bound));
    return static_cast<int>(ExitCode::kAsExpected);
}

int emptyCache(const GlobalOptions& global, const std::vector<std::string>& parts)
{
    const Folders folders = findFolders(global.shaders, global.cases, global.cache);
    fmt::print("{} freed\n", formatBytes(clearCache(folders.cache, parts)));
    return static_cast<int>(ExitCode::kAsExpected);
}

} // namespace crossray
