#include "harness/base/bytes.h"

#include <fmt/format.h>

namespace crossray {

void ByteWriter::append(const void* data, size_t size)
{
    if (size == 0) return;
    const auto* first = static_cast<const std::byte*>(data);
    bytes_.insert(bytes_.end(), first, first + size);
}

void ByteWriter::putAsFloats(std::span<const double> values)
{
    put<uint64_t>(values.size());
    const size_t start = bytes_.size();
    bytes_.resize(start + values.size() * sizeof(float));
    for (size_t i = 0; i < values.size(); ++i) {
        const auto value = static_cast<float>(values[i]);
        std::memcpy(bytes_.data() + start + i * sizeof(float), &value, sizeof(float));
    }
}

std::span<const std::byte> ByteReader::take(size_t size)
{
    if (size > bytes_.size()) {
        throw InputError(fmt::format("truncated data: {} bytes expected, {} left", size, bytes_.size()));
    }
    const std::span<const std::byte> result = bytes_.first(size);
    bytes_ = bytes_.subspan(size);
    return result;
}

bool ByteReader::getBool()
{
    const auto value = get<uint8_t>();
    if (value > 1) throw InputError(fmt::format("malformed data: {} where 0 or 1 is allowed", value));
    return value == 1;
}

size_t ByteReader::getCount(size_t elementSize)
{
    const auto count = get<uint64_t>();
    if (count > bytes_.size() / elementSize) {
        throw InputError(fmt::format("malformed data: {} elements of {} bytes announced, {} bytes left", count,
                                     elementSize, bytes_.size()));
    }
    return static_cast<size_t>(count);
}

std::string ByteReader::getString()
{
    std::string text(getCount(1), '\0');
    const std::span<const std::byte> source = take(text.size());
    if (!source.empty()) std::memcpy(text.data(), source.data(), source.size());
    return text;
}

std::vector<double> ByteReader::getFloatsAsDoubles()
{
    std::vector<double> values(getCount(sizeof(float)));
    const std::span<const std::byte> source = take(values.size() * sizeof(float));
    for (size_t i = 0; i < values.size(); ++i) {
        float value = 0;
        std::memcpy(&value, source.data() + i * sizeof(float), sizeof(float));
        values[i] = static_cast<double>(value);
    }
    return values;
}

void ByteReader::finish() const
{
    if (!bytes_.empty()) throw InputError(fmt::format("malformed data: {} bytes after the end", bytes_.size()));
}

} // namespace crossray
