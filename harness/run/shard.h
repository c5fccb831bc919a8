// Parts of a selection for several machines: which part is this one's, and which cases fall into it.
#pragma once

#include "harness/run/results.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace crossray {

// Part `index` of `count`, from 1.
struct Shard {
    int index = 1;
    int count = 1;
    static Shard parse(std::string_view text); // "2/3"; throws InputError
    std::string format() const;                // the same
    bool operator==(const Shard&) const = default;
};

// FNV-1a, 64 bit, with a final mix: the same on every machine and in every version.
uint64_t computeStableHash(std::string_view text);

// The part, from 1 to `count`, that a case falls into by its name alone: parts computed on different machines, and of
// selections that differ, fit together.
int findPartByName(std::string_view caseName, int count);

// Milliseconds that each case took on all backends together, by name.
using Timings = std::map<std::string, double, std::less<>>;
double computeCaseMs(const CaseResult& testCase);
// Of a run's folder or run.json; of skipped cases too, which take no time. Throws InputError.
Timings readTimings(const std::filesystem::path& run);

// The part of each name, from 1, such that the parts take equally long: the longest case first, each to the part with
// the least to do. A case without a time counts as the median of those that have one. The order of `names` plays no
// part, and all sums are of whole microseconds, so that every machine finds the same parts.
std::vector<int> findPartsByTime(const std::vector<std::string>& names, const Timings& timings, int count);

// Reads an environment variable; nothing where it is not set.
using ReadVariable = std::function<std::optional<std::string>(const char* name)>;
std::optional<std::string> readEnvironment(const char* name);

// A part that an engine's variables name.
struct ShardOffer {
    std::string engine;       // "gitlab", "bazel", "googletest", "slurm", "kubernetes"
    std::string variables;    // "CI_NODE_INDEX=2, CI_NODE_TOTAL=4"
    int index = 0;            // from 1
    std::optional<int> count; // Kubernetes does not say
    std::string statusFile;   // to be touched by who takes its part; empty: none
    std::string wrong;        // why the variables name no part; empty when they do
};
std::vector<ShardOffer> findShardOffers(const ReadVariable& readVariable);

// What `--shard` means: I/N; auto, or an engine's name, for the part that its variables name; both also with /N, which
// says how many parts there are where the engine does not, and is held against it where it does.
struct ShardChoice {
    Shard shard;
    std::string source;     // "slurm: SLURM_ARRAY_TASK_ID=3, ..."; empty for I/N
    std::string statusFile; // to be touched; empty: none
};
// Throws InputError that says what is wrong and what is allowed.
ShardChoice chooseShard(std::string_view text, const ReadVariable& readVariable);

} // namespace crossray
