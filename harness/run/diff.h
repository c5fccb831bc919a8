// What changed between two runs, or between two files of planes.
#pragma once

#include "harness/judge/judge.h"
#include "harness/run/results.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace crossray {

struct PlaneChange {
    std::string name;      // of the plane: "HitDepth"
    std::string note;      // "only in the first", "another size"; empty when they were compared
    Comparison comparison; // the second against the first, by the output's type, with every difference counted
};

struct ResultChange {
    std::string caseName;
    std::string backend;
    std::optional<Verdict> before, after; // absent where a run has no such result
    std::vector<PlaneChange> planes;      // only those that differ; where both runs kept them
};

// Planes by name. Planes that are no output of crossray are compared as scalars.
std::vector<PlaneChange> comparePlaneFiles(const std::filesystem::path& before, const std::filesystem::path& after);

struct RunFolder {
    std::filesystem::path folder;
    RunResult run;
};
// Every case and backend whose verdict or kept planes differ.
std::vector<ResultChange> compareRuns(const RunFolder& before, const RunFolder& after);

// What makes numbers incomparable: drivers, compilers and CPUs that are not the same. One line each.
std::vector<std::string> compareFingerprints(const RunResult& before, const RunResult& after);

} // namespace crossray
