#include "harness/report/plane_data.h"

#include "harness/report/page.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <stdexcept>

namespace crossray {

namespace {

constexpr int kDeflateLevel = 5; // zlib's

// Exponents lie beside exponents then, and so shrink: half the size of the floats as they come.
std::string shuffleFloats(const Plane& plane)
{
    const size_t pixels = plane.pixelCount(), channels = static_cast<size_t>(plane.channels);
    const size_t count = pixels * channels;
    std::string bytes(count * sizeof(float), '\0');
    for (size_t channel = 0; channel < channels; ++channel) {
        for (size_t pixel = 0; pixel < pixels; ++pixel) {
            const auto value = static_cast<float>(plane.values[pixel * channels + channel]);
            unsigned char raw[sizeof(float)];
            std::memcpy(raw, &value, sizeof(float));
            for (size_t byte = 0; byte < sizeof(float); ++byte)
                bytes[byte * count + channel * pixels + pixel] = static_cast<char>(raw[byte]);
        }
    }
    return bytes;
}

} // namespace

std::string deflateBytes(std::string_view bytes)
{
    uLongf size = compressBound(static_cast<uLong>(bytes.size()));
    std::string packed(size, '\0');
    const int status =
        compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                  static_cast<uLong>(bytes.size()), kDeflateLevel);
    if (status != Z_OK) throw std::logic_error(fmt::format("zlib's compress2 says {}", status));
    packed.resize(size);
    return packed;
}

std::string packPlane(const Plane& plane)
{
    return deflateBytes(shuffleFloats(plane));
}

std::string PlaneEncoder::encode(const std::string& source, std::span<const Plane> planes)
{
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const Plane& plane : planes) {
        nlohmann::ordered_json entry{{"name", plane.name}, {"channels", plane.channels}};
        std::string bytes = shuffleFloats(plane);
        std::vector<Written>& others = written_[plane.name];
        const auto same =
            std::find_if(others.begin(), others.end(), [&](const Written& other) { return other.bytes == bytes; });
        if (same != others.end()) {
            entry["same"] = same->source;
        } else {
            entry["data"] = encodeBase64(deflateBytes(bytes));
            others.push_back({source, std::move(bytes)});
        }
        list.push_back(std::move(entry));
    }
    const int width = planes.empty() ? 0 : planes.front().width, height = planes.empty() ? 0 : planes.front().height;
    const nlohmann::ordered_json json{{"width", width}, {"height", height}, {"planes", list}};
    return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::string formatPlaneBytes(std::span<const Plane> planes)
{
    static_assert(std::endian::native == std::endian::little);
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const Plane& plane : planes)
        list.push_back({{"name", plane.name}, {"channels", plane.channels}});
    const int width = planes.empty() ? 0 : planes.front().width, height = planes.empty() ? 0 : planes.front().height;
    std::string head = nlohmann::ordered_json{{"width", width}, {"height", height}, {"planes", list}}.dump();
    head.resize((head.size() + 3) / 4 * 4, ' ');
    size_t size = sizeof(uint32_t) + head.size();
    for (const Plane& plane : planes)
        size += plane.values.size() * sizeof(float);
    std::string bytes(size, '\0');
    char* to = bytes.data();
    const auto headSize = static_cast<uint32_t>(head.size());
    std::memcpy(to, &headSize, sizeof(headSize));
    to = std::copy(head.begin(), head.end(), to + sizeof(headSize));
    for (const Plane& plane : planes) {
        const size_t pixels = plane.pixelCount(), channels = static_cast<size_t>(plane.channels);
        for (size_t channel = 0; channel < channels; ++channel) {
            for (size_t pixel = 0; pixel < pixels; ++pixel, to += sizeof(float)) {
                const auto value = static_cast<float>(plane.values[pixel * channels + channel]);
                std::memcpy(to, &value, sizeof(value));
            }
        }
    }
    return bytes;
}

std::string encodeCubemap(const Cubemap& cubemap)
{
    nlohmann::ordered_json levels = nlohmann::ordered_json::array();
    for (int level = 0; level < cubemap.levelCount(); ++level) {
        const int side = cubemap.sizeOf(level);
        Plane plane({}, side, side * kCubeFaces, 3);
        size_t value = 0;
        for (const glm::dvec3& texel : cubemap.levels[static_cast<size_t>(level)]) {
            for (int channel = 0; channel < 3; ++channel)
                plane.values[value++] = texel[channel];
        }
        levels.push_back(encodeBase64(packPlane(plane)));
    }
    return nlohmann::ordered_json{{"size", cubemap.size}, {"levels", levels}}.dump();
}

void PlaneEncoder::forget(const std::string& source)
{
    for (auto& [name, others] : written_)
        std::erase_if(others, [&](const Written& other) { return other.source == source; });
}

} // namespace crossray
