// What `crossray run` shows while it runs.
#pragma once

#include "harness/cli/terminal.h"
#include "harness/run/execute.h"

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <map>
#include <set>
#include <string>

namespace crossray {

enum class ProgressMode { kAuto, kBar, kLines, kNone };

struct ProgressOptions {
    ProgressMode mode = ProgressMode::kLines; // not kAuto
    bool quiet = false;                       // failures alone
    bool verbose = false;                     // every backend's verdict and all failed expectations
    FILE* text = stdout;                      // lines and failures
    FILE* bar = stderr;
    Style style{false};
    size_t caseCount = 0;
    size_t resultCount = 0;           // verdicts to come
    std::filesystem::path caseFolder{}; // cases outside it are named by their files
};

// kBar where standard error is a terminal, else kLines.
ProgressMode chooseProgress(ProgressMode mode);

class Progress : public RunObserver {
  public:
    explicit Progress(const ProgressOptions& options) : options_(options) {}
    ~Progress() override { clearBar(); }
    void startBackend(const std::string& backend, const CaseResult& testCase) override;
    void finishBackend(const CaseResult& testCase, const BackendResult& result) override;
    void finishCase(const CaseResult& testCase) override;
    void tick() override;
    // The run has ended: takes the bar off the terminal and says how often the errors shown came again.
    void finish();
    // The bar's text for a terminal of this width; `seconds` since the start.
    std::string formatBar(int width, double seconds) const;

  private:
    void clearBar();
    void printText(const std::string& text);

    ProgressOptions options_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    std::string current_; // "case on backend"
    std::set<std::string> shownErrors_;
    size_t repeatedErrors_ = 0;
    size_t finished_ = 0, finishedCases_ = 0;
    RunCounts counts_;
    bool barIsShown_ = false;
};

// A case in one line: "pass  reflection/mirror   6 backends, 12 ms".
std::string formatCaseLine(const CaseResult& testCase, const Style& style);

} // namespace crossray
