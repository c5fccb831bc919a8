// What a verdict depends on, as a key: `--changed` runs a case again only where it has changed since the case passed.
#pragma once

#include "harness/backend/device.h"
#include "harness/case/case.h"
#include "harness/run/results.h"

#include <filesystem>
#include <map>
#include <set>
#include <string>

namespace crossray {

// Content hash of the shader variants as the devices get them, of their inputs, and of what is expected: the case's
// file, its tolerances, its golden files. A shader that is edited where this variant does not go leaves the key alone.
// The harness's own code is no part of it.
std::string computeInputKey(const Case& testCase, const Job& job);

// On which backends each case passed, and with which key.
struct PassedInputs {
    std::string key;
    std::set<std::string> backends;
};
using PassedCases = std::map<std::string, PassedInputs>;

// OUT/inputs.json; empty when it is not there or not readable: then everything counts as changed.
PassedCases readPassedCases(const std::filesystem::path& runFolder);
// `before` with what the run adds: passes with their keys; what failed is taken out.
PassedCases mergePassedCases(PassedCases before, const RunResult& run);
void writePassedCases(const std::filesystem::path& runFolder, const PassedCases& cases);

} // namespace crossray
