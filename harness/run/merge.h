// One run of shards that ran apart. Cases are read and written one at a time, so that their number is bounded by the
// disk: in memory stay their names and places.
#pragma once

#include "harness/run/results.h"
#include "harness/run/run_at_hand.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace crossray {

struct MergeOptions {
    std::vector<std::filesystem::path> inputs; // folders of runs or shards, run.json files, folders that hold shards
    std::filesystem::path output;
    std::filesystem::path junit;       // empty: none
    bool isPartial = false;            // shards may be missing
    size_t casesAtHand = kCasesAtHand; // kept in the result for the pages
};

struct MergedRun {
    RunResult run;                  // with the cases at hand, and the counts of all
    uint64_t cases = 0;             // of the whole run
    std::vector<std::string> notes; // attempts that were left out and why, machines that differ
    uint64_t planesBytes = 0;       // of the planes and traces that came with them
};

// Writes OUT/run.json, OUT/planes and the JUnit file. Throws InputError, before anything is written, where the shards
// are not of one plan, one is missing, two attempts of a shard have other verdicts, or a case is in two shards or none.
MergedRun mergeRuns(const MergeOptions& options, const std::vector<std::string>& commandLine);

} // namespace crossray
