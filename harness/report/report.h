// A run as pages for people. A pure function of run.json and of the planes that the run kept: the same inputs give the
// same bytes. docs/report.md describes what the pages show.
#pragma once

#include "harness/base/plane.h"
#include "harness/report/atlas.h"
#include "harness/run/results.h"
#include "harness/scene/cubemap.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace crossray {

inline constexpr std::string_view kReportSchema = "crossray-report/1";
inline constexpr size_t kMaxSingleBytes = 20'000'000;

// A file that a report shows beside the run.
struct ReportInput {
    std::string name; // for complaints
    std::string json;
    bool isOfRun = false; // a trace that the run kept: left out of a single file where there is no room
};

struct ReportCubemap {
    std::string name;
    Cubemap cubemap;
};

struct ReportOptions {
    // Whether the run kept a file beside those that its JSON names; none where it is not set.
    std::function<bool(const std::string& file)> hasFile;
    bool isSingle = false;              // one file that holds all its data
    size_t maxBytes = kMaxSingleBytes;  // of that file; what does not fit is left out, and the page says what
    std::string runFolder = "out/last"; // as the commands on the page name it
    std::vector<std::string> leftOut;   // what the run that is given lacks already, one line each
    std::vector<ReportInput> traces;    // of `crossray trace --json`, shown with the case and pixel that they are of
    std::vector<ReportCubemap> cubemaps;
    std::vector<ReportInput> benches; // JSON of `bench`, `bench tracers`, `sweep` and `mutate`
    std::span<const AtlasFile> atlas; // a page of its own; empty: none
};

struct ReportSummary {
    size_t files = 0, bytes = 0;
    std::vector<std::string> leftOut; // of the single file, one line each
};

// Both work on paths relative to a folder: of the run, of the report.
using ReadPlanes = std::function<std::vector<Plane>(const std::string& file)>;
using WriteFile = std::function<void(const std::string& file, std::string_view content)>;

// Throws InputError when a trace or a bench is none, or when not even the list of cases fits into the single file.
ReportSummary makeReport(const RunResult& run, const ReportOptions& options, const ReadPlanes& readPlanes,
                         const WriteFile& writeFile);

// The same from a run's folder to a folder (index.html and data/) or, for a single one, to a file, with the program's
// own atlas. What an earlier report left there is replaced. Throws InputError (no such planes; a folder that holds
// other things), and EnvironmentError when it cannot be written.
ReportSummary writeReport(const RunResult& run, const std::filesystem::path& runFolder,
                          const std::filesystem::path& target, const ReportOptions& options);

} // namespace crossray
