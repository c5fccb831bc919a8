// A 128-bit content hash for cache keys: FNV-1a with the published 128-bit prime and offset basis. It guards against
// accidents (edits, versions, truncation), not against an adversary.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace crossray {

struct Hash128 {
    uint64_t high = 0;
    uint64_t low = 0;
    auto operator<=>(const Hash128&) const = default;
    std::string hex() const; // 32 lower-case digits
};

// Feeds fields one after another. Strings are preceded by their length, so that ("ab", "c") and ("a", "bc") differ.
class Hasher {
  public:
    Hasher& addBytes(std::span<const std::byte> bytes);
    Hasher& addString(std::string_view text);
    Hasher& addNumber(uint64_t number); // eight bytes, the lowest first
    Hasher& addHash(const Hash128& hash) { return addNumber(hash.high).addNumber(hash.low); }
    Hash128 finish() const;

  private:
    unsigned __int128 state_ = (static_cast<unsigned __int128>(0x6c62272e07bb0142ULL) << 64) | 0x62b821756295c58dULL;
};

// Plain FNV-1a of the bytes, without a length.
Hash128 hashBytes(std::string_view bytes);
Hash128 hashBytes(std::span<const std::byte> bytes);

} // namespace crossray
