// Values as bytes, in this machine's byte order: for files and pipes that never leave the machine. The reader trusts
// nothing: a length that passes the end is an InputError, before anything is allocated.
#pragma once

#include "harness/base/error.h"

#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace crossray {

class ByteWriter {
  public:
    template <typename T>
    void put(const T& value)
    {
        static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
        append(&value, sizeof(T));
    }
    void putString(std::string_view text)
    {
        put<uint64_t>(text.size());
        append(text.data(), text.size());
    }
    template <typename T>
    void putVector(const std::vector<T>& values)
    {
        static_assert(std::is_trivially_copyable_v<T>);
        put<uint64_t>(values.size());
        append(values.data(), values.size() * sizeof(T));
    }
    // Doubles rounded once to float: half the bytes.
    void putAsFloats(std::span<const double> values);
    void reserve(size_t size) { bytes_.reserve(size); }
    size_t size() const { return bytes_.size(); }
    std::vector<std::byte> take() { return std::move(bytes_); }

  private:
    void append(const void* data, size_t size);
    std::vector<std::byte> bytes_;
};

class ByteReader {
  public:
    explicit ByteReader(std::span<const std::byte> bytes) : bytes_(bytes) {}
    template <typename T>
    T get()
    {
        static_assert(std::is_arithmetic_v<T>);
        T value{};
        const std::span<const std::byte> source = take(sizeof(T));
        std::memcpy(&value, source.data(), sizeof(T));
        return value;
    }
    bool getBool();
    // A number of elements that take at least `elementSize` bytes each in what is left.
    size_t getCount(size_t elementSize);
    std::string getString();
    template <typename T>
    std::vector<T> getVector()
    {
        static_assert(std::is_trivially_copyable_v<T>);
        std::vector<T> values(getCount(sizeof(T)));
        const std::span<const std::byte> source = take(values.size() * sizeof(T));
        if (!source.empty()) std::memcpy(values.data(), source.data(), source.size());
        return values;
    }
    std::vector<double> getFloatsAsDoubles();
    size_t remaining() const { return bytes_.size(); }
    // Throws when something is left.
    void finish() const;

  private:
    std::span<const std::byte> take(size_t size);
    std::span<const std::byte> bytes_;
};

} // namespace crossray
