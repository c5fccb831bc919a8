// Hashes of files by their content: what a kept verdict depends on, and what the parts of a run must have in common.
#pragma once

#include "harness/base/hash.h"
#include "harness/case/case.h"

#include <filesystem>
#include <mutex>
#include <string>
#include <unordered_map>

namespace crossray {

// Each file is read once, however many cases name it; what is not there has a hash of its own. Thread-safe.
class ContentHashes {
  public:
    Hash128 find(const std::filesystem::path& file);
    // Of all that the case's answers depend on beside shaders and devices: its file, its presets, and every file that
    // it names. Folders play no part, so that it is the same on every machine.
    Hash128 hashFilesOf(const Case& testCase);

  private:
    std::filesystem::path findPresetsOf(const std::filesystem::path& folder);

    std::mutex mutex_;
    std::unordered_map<std::string, Hash128> hashes_;                // by file
    std::unordered_map<std::string, std::filesystem::path> presets_; // by folder
};

} // namespace crossray
