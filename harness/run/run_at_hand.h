// Of a run of any size the cases that people look at.
#pragma once

#include "harness/run/results.h"

#include <cstdint>
#include <filesystem>
#include <string>

namespace crossray {

// So many cases at most are kept in memory for pages: all of a run that has no more, else of those that failed.
inline constexpr size_t kCasesAtHand = 20'000;

struct RunAtHand {
    RunResult run; // with these cases, and the counts of all
    uint64_t cases = 0;
};

// The run's folder or its run.json. Throws InputError.
RunAtHand readRunAtHand(const std::filesystem::path& path, size_t atMost = kCasesAtHand);

// What is left out, in one line; empty where nothing is.
std::string describeLeftOut(size_t atHand, uint64_t cases);

} // namespace crossray
