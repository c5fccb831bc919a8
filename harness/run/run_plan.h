// What the parts of a run must have in common to be one run: the same cases, shaders, harness and options. Two runs of
// one plan may differ in machines and times alone.
#pragma once

#include "harness/base/hash.h"
#include "harness/run/execute.h"
#include "harness/run/results.h"

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace crossray {

// Of all selected cases, whatever part of them this run takes: their number, their names, and what their files say
// (ContentHashes::hashFilesOf).
RunPlan describeSelection(const std::map<std::string, Hash128>& filesOfNames);

// Hash over names, whatever their order.
std::string hashNames(std::vector<std::string> names);

// "4 parts by name", or "4 parts by time" with a hash over who takes what; "whole".
std::string describePartition(std::span<const std::string> names, std::span<const int> parts, int count, bool isByTime);

// Names and contents of all files below the folder.
std::string hashFolder(const std::filesystem::path& folder);

// Version and sources of the harness up to the verdict, and what it compiles shaders with.
std::string describeHarness();

// What can change a verdict or leave one out.
std::string describeOptions(const ExecuteOptions& options, bool validation);

// Over all of it but what is this part's own.
std::string hashPlan(const RunPlan& plan);

// In which fields the second differs from the first, in words; empty for one plan.
std::vector<std::string> comparePlans(const RunPlan& first, const RunPlan& second);

} // namespace crossray
