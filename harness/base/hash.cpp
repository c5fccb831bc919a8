#include "harness/base/hash.h"

#include <fmt/format.h>

namespace crossray {

namespace {

// 2^88 + 2^8 + 0x3b
constexpr unsigned __int128 kPrime = (static_cast<unsigned __int128>(1) << 88) | 0x13b;

} // namespace

std::string Hash128::hex() const
{
    return fmt::format("{:016x}{:016x}", high, low);
}

Hasher& Hasher::addBytes(std::span<const std::byte> bytes)
{
    unsigned __int128 state = state_;
    for (const std::byte byte : bytes)
        state = (state ^ static_cast<unsigned char>(byte)) * kPrime;
    state_ = state;
    return *this;
}

Hasher& Hasher::addString(std::string_view text)
{
    addNumber(text.size());
    return addBytes(std::as_bytes(std::span(text.data(), text.size())));
}

Hasher& Hasher::addNumber(uint64_t number)
{
    for (int i = 0; i < 8; ++i)
        state_ = (state_ ^ ((number >> (8 * i)) & 0xff)) * kPrime;
    return *this;
}

Hash128 Hasher::finish() const
{
    return {static_cast<uint64_t>(state_ >> 64), static_cast<uint64_t>(state_)};
}

Hash128 hashBytes(std::span<const std::byte> bytes)
{
    return Hasher().addBytes(bytes).finish();
}

Hash128 hashBytes(std::string_view bytes)
{
    return hashBytes(std::as_bytes(std::span(bytes.data(), bytes.size())));
}

} // namespace crossray
