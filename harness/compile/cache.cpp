#include "harness/compile/cache.h"

#include "harness/base/bytes.h"
#include "harness/compile/source.h"

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <fstream>
#include <unistd.h>

namespace crossray {

namespace fs = std::filesystem;

namespace {

constexpr uint64_t kMagic = 0x3159415253534f52; // "ROSSRAY1"
constexpr uint32_t kFormat = 1;
constexpr size_t kMaxEntryBytes = 64 << 20;

// What is used stays longest where the cache is cut back. Once an hour is exact enough, and spares the disk.
void touch(const fs::path& file)
{
    std::error_code failure;
    const auto now = fs::file_time_type::clock::now();
    if (now - fs::last_write_time(file, failure) > std::chrono::hours(1)) fs::last_write_time(file, now, failure);
}

} // namespace

FileCache::FileCache(fs::path folder) : folder_(std::move(folder)) {}

fs::path FileCache::fileOf(const Hash128& key) const
{
    const std::string name = key.hex();
    return folder_ / name.substr(0, 2) / name;
}

std::optional<std::vector<std::byte>> FileCache::find(const Hash128& key) const
{
    if (folder_.empty()) return std::nullopt;
    const std::optional<std::string> file = readFile(fileOf(key), kMaxEntryBytes);
    if (!file) return std::nullopt;
    try {
        ByteReader reader(std::as_bytes(std::span(file->data(), file->size())));
        if (reader.get<uint64_t>() != kMagic || reader.get<uint32_t>() != kFormat) return std::nullopt;
        const auto readHash = [&reader] {
            const auto high = reader.get<uint64_t>();
            return Hash128{high, reader.get<uint64_t>()};
        };
        if (readHash() != key) return std::nullopt;
        const Hash128 checksum = readHash();
        std::vector<std::byte> payload = reader.getVector<std::byte>();
        reader.finish();
        if (hashBytes(payload) != checksum) return std::nullopt;
        touch(fileOf(key));
        return payload;
    } catch (const InputError&) {
        return std::nullopt;
    }
}

void FileCache::store(const Hash128& key, std::span<const std::byte> payload) const
{
    if (folder_.empty()) return;
    ByteWriter writer;
    writer.put(kMagic);
    writer.put(kFormat);
    const Hash128 checksum = hashBytes(payload);
    for (const uint64_t word : {key.high, key.low, checksum.high, checksum.low})
        writer.put(word);
    writer.putVector(std::vector<std::byte>(payload.begin(), payload.end()));
    const std::vector<std::byte> bytes = writer.take();

    const fs::path target = fileOf(key);
    static std::atomic<unsigned> counter{0};
    fs::path aside = target;
    aside += fmt::format(".{}.{}", ::getpid(), counter++);
    std::error_code failed;
    fs::create_directories(target.parent_path(), failed);
    {
        std::ofstream file(aside, std::ios::binary);
        file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
        file.close();
        if (!file) {
            fs::remove(aside, failed);
            return;
        }
    }
    fs::rename(aside, target, failed);
    if (failed) fs::remove(aside, failed);
}

} // namespace crossray
