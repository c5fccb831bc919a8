// The shards of a merge: which attempts there are, which of them count, and whether together they are the whole run.
#pragma once

#include "harness/run/attempt.h"
#include "harness/run/merge.h"
#include "harness/run/run_json.h"

#include <memory>
#include <string>
#include <vector>

namespace crossray {

struct ShardCase {
    std::string name;
    std::string_view text; // of the shard's run.json
    uint64_t verdicts = 0; // hash over them: two attempts agree when these are equal
    bool hasFailed = false;
    bool hasFiles = false; // planes and the like beside the run.json
};

// One attempt of one shard.
struct ShardRun {
    std::filesystem::path folder;
    std::unique_ptr<RunFile> file; // stays where it is: the cases are views of its text
    Shard shard;
    RunCounts counts;
    std::vector<ShardCase> cases;
};

struct MergeInputs {
    std::vector<ShardRun> shards;     // one each, in order
    std::vector<std::string> missing; // "3/4"
    std::vector<std::string> notes;
};

// Of a case, relative to its run's folder.
std::vector<std::string> listFilesOf(const CaseResult& testCase);

// Throws InputError; `isPartial` lets shards be missing.
MergeInputs readMergeInputs(std::span<const std::filesystem::path> inputs, bool isPartial);

} // namespace crossray
