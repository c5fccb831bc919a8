// The plan of a run: the cases that a command line selects, in order.
#pragma once

#include "harness/case/case.h"
#include "harness/run/selection.h"
#include "harness/run/shard.h"

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace crossray {

struct Selection {
    std::vector<std::string>
        arguments; // paths of files or folders, names, globs; empty: everything below the case root
    std::optional<KeyExpression> expression;
    std::vector<std::string> tags;              // a case with any of them
    std::optional<Shard> shard;                 // a part of what all the others select
    std::optional<Timings> timings;             // parts take equally long by these, instead of by name
    std::optional<std::set<std::string>> names; // only these: the failures of the last run
};

// A case file that cannot be read.
struct BrokenFile {
    std::filesystem::path file;
    std::string line; // "file:line:column: what is wrong and what is allowed"
};

struct Plan {
    std::vector<Case> cases; // of the shard
    RunPlan common;          // what the shards have in common, as far as the selection says
    std::vector<BrokenFile> broken;
};

// Reads the files that the arguments can mean and keeps what the filters let through. A path, or a folder, stands for
// its files; anything else is a name, the start of a name up to a slash or a bracket, or a glob over names and paths.
// Files that are broken are collected; when they were not named themselves, but stood in the way of finding a name,
// they are collected only if the name was not found. Throws InputError for a path that does not exist and for two cases
// of one name; an argument that matches no case gives the nearest names in `unmatched`.
struct PlanResult {
    Plan plan;
    std::vector<std::string> unmatched; // one line an argument that matched nothing
};
PlanResult makePlan(const Selection& selection, const std::filesystem::path& caseRoot);

} // namespace crossray
