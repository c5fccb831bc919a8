// How many cases a second: distinct 64x64 HiZ cases, prepared, compiled, run and judged as `crossray run` does it, a
// backend and a number of cores at a time.
#pragma once

#include "harness/case/case.h"
#include "harness/run/environment.h"

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace crossray {

// What is already there when the clock starts.
enum class CacheState {
    kCold, // workers run, Mesa's shader cache is empty: each case costs the driver's whole compile
    kWarm, // new workers over a filled Mesa cache: each case costs loading a compiled shader
    kHot,  // the same workers once more: each program is already in its worker
};
std::string_view nameOf(CacheState state);

struct ThroughputOptions {
    std::vector<std::string> backends;
    int cases = 32;            // distinct ones, 1 to 4096
    std::vector<int> cores{1}; // one measurement each
    int rounds = 3;            // the median counts
};

struct ThroughputPoint {
    std::string backend;
    int cores = 1;
    CacheState state = CacheState::kCold;
    int cases = 0;
    double millisecondsPerCase = 0;  // wall clock over all cases, divided by their number; median of the rounds
    double fastest = 0, slowest = 0; // of the rounds
    double shaderMilliseconds = 0;   // of it: the driver's compile and the dispatches, mean a case, in the median round
    int failed = 0;                  // cases whose verdict is not pass; figures of failing cases mean nothing
};

// Cases that differ in scene and in which outputs they ask for, so that each has a scene and a shader of its own.
std::vector<Case> makeThroughputCases(int count);

// Calls `report` after each point. Throws EnvironmentError when a backend cannot be opened.
std::vector<ThroughputPoint> measureThroughput(const ThroughputOptions& options, const Folders& folders,
                                               const std::function<void(const ThroughputPoint&)>& report);

std::string formatThroughputJson(std::span<const ThroughputPoint> points);

} // namespace crossray
