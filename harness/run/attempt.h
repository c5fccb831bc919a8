// Folders of shards. A shard may run more than once (its machine died, its job was queued again), perhaps at the same
// time, below one output folder: each attempt has a folder of its own name, "shard-2-of-4.ATTEMPT", which ends in
// ".part" until all of it is there.
#pragma once

#include "harness/run/results.h"
#include "harness/run/shard.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace crossray {

// HOST-PROCESS-TIME: two attempts of one shard differ in one of them.
std::string makeAttemptName();

struct AttemptFolder {
    Shard shard;
    std::string attempt;
    bool isPart = false; // still being written, or never ended
};
std::string formatAttemptFolder(const AttemptFolder& folder);
// Nothing for a folder of another name.
std::optional<AttemptFolder> parseAttemptFolder(std::string_view name);

// The folder to write an attempt's results to. Throws InputError for a name that no folder can have, and where an
// attempt of this name is there and whole.
std::filesystem::path chooseAttemptFolder(const std::filesystem::path& output, const Shard& shard,
                                          const std::string& attempt);
// Gives the folder its final name and returns it. Throws EnvironmentError.
std::filesystem::path finishAttemptFolder(const std::filesystem::path& folder);

// Why the run has not all verdicts of its part, or has them from a machine that lacks a device; empty for a whole one.
std::string whyNotWhole(const RunResult& run);

// Attempts in a folder and at most three below it, in order of path.
std::vector<std::filesystem::path> findAttemptFolders(const std::filesystem::path& folder);

} // namespace crossray
