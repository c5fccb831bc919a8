// The verbs of the command line: each takes its options and returns its exit code. Errors are thrown; the caller prints
// them.
#pragma once

#include "harness/cli/progress.h"
#include "harness/cli/terminal.h"
#include "harness/run/execute.h"
#include "harness/run/shard.h"

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace crossray {

struct GlobalOptions {
    ColorMode color = ColorMode::kAuto;
    std::string shaders, cases, cache; // folders; empty: found
    uint64_t cacheMebibytes = 1024;    // what the cache may grow to
    std::vector<std::string> commandLine;
    std::chrono::steady_clock::time_point processStart = std::chrono::steady_clock::now();
};

struct SelectionOptions {
    std::vector<std::string> arguments;
    std::string expression;
    std::vector<std::string> tags;
    std::string shard; // "2/4", "auto", ...; empty: all
    bool lastFailed = false;
    std::string timings = {}; // a run by whose times the shards are balanced; empty: none
};

struct RunOptions {
    SelectionOptions selection;
    std::vector<std::string> backends;
    int cores = 0; // 0: all there are
    int maxFailures = 0;
    bool keepGoing = false;
    bool changed = false; // only what has not passed with these inputs
    bool useCache = true; // verdicts of earlier runs
    bool resume = false;  // go on with the interrupted run in the output folder
    std::optional<double> timeoutSeconds;
    int repeat = 1;
    std::optional<uint64_t> seed; // order of the cases
    bool validation = false;
    KeepPlanes planes = KeepPlanes::kFailed;
    bool conditioning = false; // measured and written of every case
    std::string output = "out/last";
    std::string attempt; // of a shard; empty: a name of its own
    std::string junit;
    bool json = false;
    bool github = false;
    bool report = true; // as pages, below the output folder
    ProgressMode progress = ProgressMode::kAuto;
    bool quiet = false, verbose = false;
};
int runCases(const GlobalOptions& global, const RunOptions& options);

uint64_t cacheBound(const GlobalOptions& global); // bytes
int showCache(const GlobalOptions& global);
int emptyCache(const GlobalOptions& global, const std::vector<std::string>& parts);

int listCases(const GlobalOptions& global, const SelectionOptions& selection, bool json);

struct ShowOptions {
    std::string testCase;
    std::vector<std::string> backends;
    std::string image;               // a PNG of what the first of the cases computes; empty: none
    std::vector<std::string> panels; // of that picture; empty: all
    std::string debugMode;           // what it shows in their place; empty: the panels
    bool conditioning = false;       // measured, and told by output
    std::string pixel;               // of which that is told alone, "X,Y"; empty: all
};
int showCase(const GlobalOptions& global, const ShowOptions& options);

struct BakeOptions {
    std::string testCase;
    std::string output; // empty: where the case looks for it
};
int bakeProbes(const GlobalOptions& global, const BakeOptions& options);

struct TraceOptions {
    std::string testCase;
    std::string pixel; // "X,Y"
    std::vector<std::string> backends;
    bool json = false;
    bool conditioning = false; // measured whatever the size
};
int traceCase(const GlobalOptions& global, const TraceOptions& options);

struct InspectVerbOptions {
    SelectionOptions selection;
    int port = 0;      // 0: a free one
    bool open = false; // in a browser
};
int inspectCases(const GlobalOptions& global, const InspectVerbOptions& options);

struct CompileVerbOptions {
    std::string shader;
    std::string target = "glsl";
    std::string output;                      // empty: standard output
    std::vector<std::string> specialization; // NAME=VALUE
    bool optimize = true;
    bool assembly = false; // SPIR-V as text
};
int compileShader(const GlobalOptions& global, const CompileVerbOptions& options);

int diffRuns(const GlobalOptions& global, const std::string& before, const std::string& after, bool json);

struct ReviewOptions {
    std::string run = "out/last";
    std::string accept; // a case's name; empty: list
    std::string backend;
};
int reviewGoldens(const GlobalOptions& global, const ReviewOptions& options);

struct ReportVerbOptions {
    std::string run = "out/last";
    bool isSingle = false;
    std::string output; // folder, or for a single one the file; empty: beside the run.json
    std::vector<std::string> traces, benches, cubemaps;
    bool open = false; // in a browser
};
int reportRun(const ReportVerbOptions& options);

struct MergeVerbOptions {
    std::vector<std::string> runs; // folders with shards, shards' folders, runs
    std::string output = "out/last";
    std::string junit;
    bool isPartial = false; // without the shards that are missing
    bool report = true;
    bool quiet = false;
};
int mergeRuns(const GlobalOptions& global, const MergeVerbOptions& options);

int diagnose(const GlobalOptions& global);

struct ThroughputVerbOptions {
    std::vector<std::string> backends;
    int cases = 32;
    std::vector<int> cores{1, 2};
    int rounds = 3;
    std::string output; // JSON; empty: none
};
int benchThroughput(const GlobalOptions& global, const ThroughputVerbOptions& options);

struct BenchCasesOptions {
    std::vector<std::string> cases;
    std::string backend = "lavapipe";
    std::vector<std::string> methods; // a person's own tracers, NAME=FILE
    int rounds = 9;
    bool jitter = false; // measures Flips
    std::string budget;  // empty: none
    std::string output;  // folder; empty: none
    std::string compare; // an earlier bench.json; empty: none
    double loss = 0.05;  // share that counts as one
};
int benchCases(const GlobalOptions& global, const BenchCasesOptions& options);

struct TracersVerbOptions {
    std::string seeds = "1-24";
    std::string size = "1920x1080";
    std::string family = "random_room";
    std::string disturbance = "none";
    std::string testCase; // instead of random scenes
    std::string filter;   // part of a tracer's name; empty: all
    double thickness = 0; // metres; 0: by the size
    int stride = 4;
    int threads = 2;
    std::string json, csv;            // files; empty: none
    std::string charts;               // folder; empty: none
    std::vector<std::string> methods; // a person's own tracers, NAME=FILE
    std::string backend = "lavapipe"; // where they run
};
int benchTracers(const GlobalOptions& global, const TracersVerbOptions& options);

struct SweepVerbOptions {
    std::string testCase, parameter, range;
    std::vector<std::string> overrides; // KEY=VALUE
    std::vector<std::string> backends;
    int jobs = 0;        // 0: all processors
    double width = 1e-4; // of an edge, as a share of the range
    std::string output;  // folder; empty: none
    std::string csv;     // file; empty: none
    bool json = false;
    bool all = false;   // those of cases/sweeps.toml
    std::string filter; // part of their ids
};
int sweepCase(const GlobalOptions& global, const SweepVerbOptions& options);

// Cases for a command line: prints what is wrong with it to standard error. `keepGoing` lets broken files pass. The
// exit code is set when there is nothing to go on with.
struct MutateOptions {
    SelectionOptions selection;
    std::vector<std::string> shaders; // files or folders; empty: the library
    std::vector<std::string> mutants; // parts of their ids; empty: all
    size_t sample = 0;                // 0: all
    uint64_t seed = 1;
    std::string backend = "lavapipe";
    int jobs = 0; // 0: all there are
    int idleTries = 0;
    size_t askAtMost = 0;        // 0: all
    double minScore = 0;         // percent
    std::string json, output;    // a file; a folder; empty: none
    std::string again;           // mutation.json of an earlier hunt; empty: none
    std::string equivalents;     // file; empty: the source tree's
    bool tryEquivalents = false; // run them like the others
    bool list = false, verbose = false;
};
int mutateShaders(const GlobalOptions& global, const MutateOptions& options);

struct SelectedCases {
    std::vector<Case> cases;
    std::vector<std::string> broken; // one line each
    std::optional<ExitCode> exitCode;
    std::optional<ShardChoice> shard; // of which these cases are
    RunPlan plan;                     // as far as the selection says
};
SelectedCases selectCases(const SelectionOptions& options, const std::string& caseRoot, const std::string& lastRun,
                          bool keepGoing);

} // namespace crossray
