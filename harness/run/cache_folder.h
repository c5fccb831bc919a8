// The cache folder as a person sees it: how much is in it, and what keeps it from growing without end.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace crossray {

struct CachePart {
    std::string name; // "spirv", "results", "mesa": a folder below the cache
    std::string what;
    uint64_t files = 0, bytes = 0;
};
std::vector<CachePart> measureCache(const std::filesystem::path& cache);

// Removes the files used longest ago, of all parts together, until at most `maxBytes` are left. What cannot be removed
// stays. Returns the bytes that were freed.
uint64_t trimCache(const std::filesystem::path& cache, uint64_t maxBytes);

// Removes the named parts, or all of them where none is named. Nothing else below the folder is touched. Returns the
// bytes that were freed. Throws InputError for a name that is none, EnvironmentError where something cannot be removed.
uint64_t clearCache(const std::filesystem::path& cache, const std::vector<std::string>& parts);

} // namespace crossray
