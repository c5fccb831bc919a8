// Cache files: one a key, written aside and renamed, so that a reader sees a whole entry or none. Each bears a magic, a
// format version, its key and a checksum; whatever does not fit is as good as absent.
#pragma once

#include "harness/base/hash.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

namespace crossray {

class FileCache {
  public:
    explicit FileCache(std::filesystem::path folder); // empty: finds nothing and keeps nothing
    std::optional<std::vector<std::byte>> find(const Hash128& key) const;
    // A folder that cannot be written is no error: the entry is made anew the next time.
    void store(const Hash128& key, std::span<const std::byte> payload) const;

  private:
    std::filesystem::path fileOf(const Hash128& key) const;
    std::filesystem::path folder_;
};

} // namespace crossray
