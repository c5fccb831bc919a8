// run.json: the only hand-over between running and showing. docs/run-json.md documents each field; a test holds the two
// against each other.
#pragma once

#include "harness/run/results.h"
#include "harness/run/run_slices.h"

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace crossray {

inline constexpr std::string_view kRunSchema = "crossray-run/1";

// Numbers that JSON does not have are the strings "NaN", "Infinity" and "-Infinity". The head is indented for people;
// of the cases, which may be millions, each stands on a line of its own.
std::string formatRunJson(const RunResult& run);
// The same in pieces, for a run whose cases are not all at hand: between the two stand the cases, each after "\n  " as
// formatCaseJson has it, with commas between them and "\n " after the last. The counts in it are countVerdicts(run)'s.
struct RunJsonFrame {
    std::string before, after;
};
RunJsonFrame formatRunJsonFrame(const RunResult& run);
// One of its cases, on one line.
std::string formatCaseJson(const CaseResult& testCase);
// All of it but the cases, on one line.
std::string formatHeadJson(const RunResult& run);
// Throws InputError with `name` for text that is no run.json of this schema.
RunResult parseRunJson(std::string_view text, const std::string& name);
// The same of one case.
CaseResult parseCaseJson(std::string_view text, const std::string& name);
// A run.json, or the folder that holds one.
RunResult readRun(const std::filesystem::path& path);
std::filesystem::path findRunJson(const std::filesystem::path& path);

// After so many cases what was read of a file is given back.
inline constexpr size_t kCasesBetweenReleases = 4096;

// A run.json of any size: its head, and its cases one at a time.
class RunFile {
  public:
    // The run's folder or its run.json. Throws InputError.
    explicit RunFile(const std::filesystem::path& path);
    const std::string& name() const { return name_; }
    const RunResult& head() const { return head_; } // without cases
    std::span<const std::string_view> cases() const { return cases_; }
    CaseResult parse(std::string_view testCase) const { return parseCaseJson(testCase, name_); }
    CaseResult parseBare(std::string_view testCase) const; // as parseBareCase
    void release() const { file_.release(); }              // what was read may leave the memory

  private:
    std::string name_;
    MappedFile file_;
    RunResult head_;
    std::vector<std::string_view> cases_;
};

// Every field that run.json can have, as "cases[].backends[].verdict", for the test of the document.
std::vector<std::string> listRunJsonFields();

// What --json prints: the head of run.json without the cases, and one line of facts for each verdict that is not a
// pass.
std::string formatSummaryJson(const RunResult& run);

} // namespace crossray
