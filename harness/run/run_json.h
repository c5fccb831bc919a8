// run.json: the only hand-over between running and showing. docs/run-json.md documents each field; a test holds the two
// against each other.
#pragma once

#include "harness/run/results.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace crossray {

inline constexpr std::string_view kRunSchema = "crossray-run/1";

// Numbers that JSON does not have are the strings "NaN", "Infinity" and "-Infinity".
std::string formatRunJson(const RunResult& run);
// One of its cases, on one line.
std::string formatCaseJson(const CaseResult& testCase);
// All of it but the cases, on one line.
std::string formatHeadJson(const RunResult& run);
// Throws InputError with `name` for text that is no run.json of this schema.
RunResult parseRunJson(std::string_view text, const std::string& name);
// A run.json, or the folder that holds one.
RunResult readRun(const std::filesystem::path& path);
std::filesystem::path findRunJson(const std::filesystem::path& path);

// Every field that run.json can have, as "cases[].backends[].verdict", for the test of the document.
std::vector<std::string> listRunJsonFields();

// What --json prints: the head of run.json without the cases, and one line of facts for each verdict that is not a
// pass.
std::string formatSummaryJson(const RunResult& run);

} // namespace crossray
