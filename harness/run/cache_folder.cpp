#include "harness/run/cache_folder.h"

#include "harness/base/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace crossray {

namespace fs = std::filesystem;

namespace {

std::vector<CachePart> partsOfCache()
{
    return {{"spirv", "compiled shaders"}, {"results", "verdicts of cases that passed"}, {"mesa", "Mesa's own"}};
}

struct CacheFile {
    fs::path path;
    fs::file_time_type used;
    uint64_t bytes = 0;
};

// Other processes write and remove here, too: what has gone meanwhile is left out.
std::vector<CacheFile> listFilesOf(const fs::path& folder)
{
    std::vector<CacheFile> files;
    std::error_code failure;
    fs::recursive_directory_iterator place(folder, fs::directory_options::skip_permission_denied, failure);
    for (; !failure && place != fs::recursive_directory_iterator(); place.increment(failure)) {
        std::error_code gone;
        if (place->is_symlink(gone) || !place->is_regular_file(gone)) continue;
        CacheFile file{place->path(), place->last_write_time(gone), 0};
        file.bytes = gone ? 0 : place->file_size(gone);
        if (!gone) files.push_back(std::move(file));
    }
    return files;
}

} // namespace

std::vector<CachePart> measureCache(const fs::path& cache)
{
    std::vector<CachePart> parts = partsOfCache();
    for (CachePart& part : parts) {
        for (const CacheFile& file : listFilesOf(cache / part.name)) {
            ++part.files;
            part.bytes += file.bytes;
        }
    }
    return parts;
}

uint64_t trimCache(const fs::path& cache, uint64_t maxBytes)
{
    std::vector<CacheFile> files;
    uint64_t bytes = 0;
    for (const CachePart& part : partsOfCache()) {
        for (CacheFile& file : listFilesOf(cache / part.name)) {
            bytes += file.bytes;
            files.push_back(std::move(file));
        }
    }
    if (bytes <= maxBytes) return 0;
    std::sort(files.begin(), files.end(), [](const CacheFile& a, const CacheFile& b) { return a.used < b.used; });
    uint64_t freed = 0;
    for (const CacheFile& file : files) {
        if (bytes - freed <= maxBytes) break;
        std::error_code failure;
        if (fs::remove(file.path, failure)) freed += file.bytes;
    }
    return freed;
}

uint64_t clearCache(const fs::path& cache, const std::vector<std::string>& parts)
{
    std::vector<std::string> known;
    for (const CachePart& part : partsOfCache())
        known.push_back(part.name);
    for (const std::string& part : parts) {
        if (std::find(known.begin(), known.end(), part) == known.end()) {
            throw InputError(fmt::format("the cache has no part \"{}\"; allowed are {}", part, fmt::join(known, ", ")));
        }
    }
    uint64_t freed = 0;
    for (const CachePart& part : measureCache(cache)) {
        if (!parts.empty() && std::find(parts.begin(), parts.end(), part.name) == parts.end()) continue;
        std::error_code failure;
        fs::remove_all(cache / part.name, failure);
        if (failure) {
            throw EnvironmentError(
                fmt::format("{}: cannot be removed: {}", (cache / part.name).string(), failure.message()));
        }
        freed += part.bytes;
    }
    return freed;
}

} // namespace crossray
