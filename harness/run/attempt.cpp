#include "harness/run/attempt.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>

namespace crossray {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kPart = ".part";

bool isNameCharacter(char character)
{
    return (character >= 'a' && character <= 'z') || (character >= 'A' && character <= 'Z') ||
           (character >= '0' && character <= '9') || character == '-' || character == '_' || character == '.';
}

bool isAttemptName(std::string_view name)
{
    return !name.empty() && name.size() <= 100 && name.front() != '.' && !name.ends_with(kPart) &&
           std::all_of(name.begin(), name.end(), isNameCharacter);
}

// Takes a prefix and the number after it off the text.
std::optional<int> takeNumber(std::string_view& text, std::string_view prefix)
{
    if (!text.starts_with(prefix)) return std::nullopt;
    text.remove_prefix(prefix.size());
    int number = 0;
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{}) return std::nullopt;
    text.remove_prefix(static_cast<size_t>(rest - text.data()));
    return number;
}

} // namespace

std::string makeAttemptName()
{
    std::array<char, 65> host{};
    if (gethostname(host.data(), host.size() - 1) != 0) host = {'h', 'o', 's', 't'};
    std::string name = host.data();
    std::replace_if(
        name.begin(), name.end(), [](char character) { return !isNameCharacter(character); }, '_');
    const auto now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
    return fmt::format("{}-{}-{:%Y%m%dT%H%M%SZ}", name, getpid(), fmt::gmtime(now));
}

std::string formatAttemptFolder(const AttemptFolder& folder)
{
    return fmt::format("shard-{}-of-{}.{}{}", folder.shard.index, folder.shard.count, folder.attempt,
                       folder.isPart ? kPart : "");
}

std::optional<AttemptFolder> parseAttemptFolder(std::string_view name)
{
    const auto index = takeNumber(name, "shard-");
    const auto count = index ? takeNumber(name, "-of-") : std::nullopt;
    if (!count || *index < 1 || *index > *count || !name.starts_with('.')) return std::nullopt;
    name.remove_prefix(1);
    const bool isPart = name.ends_with(kPart);
    if (isPart) name.remove_suffix(kPart.size());
    if (!isAttemptName(name)) return std::nullopt;
    return AttemptFolder{{*index, *count}, std::string(name), isPart};
}

fs::path chooseAttemptFolder(const fs::path& output, const Shard& shard, const std::string& attempt)
{
    if (!isAttemptName(attempt)) {
        throw InputError(
            fmt::format("--attempt \"{}\": allowed are up to 100 letters, digits, '-', '_' and '.', no dot "
                        "in front and no .part at the end",
                        attempt));
    }
    const fs::path final = output / formatAttemptFolder({shard, attempt, false});
    std::error_code failure;
    if (fs::exists(final, failure)) {
        throw InputError(fmt::format("--attempt \"{}\": {} is there already, and whole", attempt, final.string()));
    }
    return output / formatAttemptFolder({shard, attempt, true});
}

fs::path finishAttemptFolder(const fs::path& folder)
{
    std::string name = folder.filename().string();
    name.resize(name.size() - kPart.size());
    const fs::path final = folder.parent_path() / name;
    std::error_code failure;
    fs::rename(folder, final, failure);
    if (failure) throw EnvironmentError(fmt::format("{}: cannot be renamed: {}", folder.string(), failure.message()));
    return final;
}

std::string whyNotWhole(const RunResult& run)
{
    if (run.interrupted) return "it was interrupted";
    if (run.stoppedEarly) return "it stopped early";
    for (const auto& [name, record] : run.backends) {
        if (!record.environmentError.empty()) return fmt::format("{}: {}", name, record.environmentError);
    }
    return {};
}

std::vector<fs::path> findAttemptFolders(const fs::path& folder)
{
    constexpr int kDepth = 3;
    std::vector<fs::path> found;
    std::error_code failure;
    for (fs::recursive_directory_iterator entry(folder, failure), end; !failure && entry != end;
         entry.increment(failure)) {
        if (!entry->is_directory(failure)) continue;
        const bool isAttempt = parseAttemptFolder(entry->path().filename().string()).has_value();
        if (isAttempt) found.push_back(entry->path());
        if (isAttempt || entry.depth() >= kDepth) entry.disable_recursion_pending();
    }
    std::sort(found.begin(), found.end());
    return found;
}

} // namespace crossray
