// What a run found, as values: everything that run.json holds. Reports are functions of this and of the planes beside
// it.
#pragma once

#include "harness/backend/device.h"
#include "harness/base/error.h"
#include "harness/judge/judge.h"

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace crossray {

enum class Verdict {
    kPass,
    kFail,
    kError,         // the case or its shader is broken, or the device refused it
    kCrash,         // the worker died
    kTimeout,       // the worker did not answer in time
    kSkip,          // with a reason
    kKnownFail,     // fails, as its known failure says
    kUnknownPass,   // passes, although a known failure says that it fails
    kMissingGolden, // its golden file is not there
};
std::span<const Verdict> allVerdicts();
std::string_view nameOf(Verdict verdict); // "pass", "known-fail", ...
std::optional<Verdict> findVerdict(std::string_view name);

enum class Tally { kPassed, kFailed, kSkipped };
// What a verdict counts as in "N passed, N failed, N skipped". A known failure is neither passed nor failed.
Tally tallyOf(Verdict verdict);

struct ExpectationResult {
    size_t index = 0;                       // place among the case's expectations
    std::string output;                     // "HitDepth"
    std::string source;                     // "analytic mirror_direction", "agree with cpu64", ...
    SourcePosition position;                // of the [[expect]] table
    std::string tolerance;                  // in words: "0.0001 relative or 4 ulp"
    std::optional<double> undecidable;      // share that it excuses; none: nothing
    std::optional<double> undecidableAbove; // output ulps for an input ulp from which on it may
    bool judged = false;
    std::string note; // why it was not judged; of a golden: under which other fingerprint it was recorded
    bool missingGolden = false;
    Comparison comparison; // when judged
};

struct StageTimes { // milliseconds; all repeats together where a case is repeated
    double program = 0, upload = 0, dispatch = 0, readback = 0; // in the worker
    double device = -1; // by the device's own clock; -1 where it is not to be trusted
    double worker = 0;  // from hand-over to answer
    double judge = 0;
};

// One case on one backend.
struct BackendResult {
    std::string backend;
    Verdict verdict = Verdict::kSkip;
    std::string reason; // one line; empty for a plain pass
    StageTimes times;
    bool programsWereWarm = false;
    std::vector<ExpectationResult> expectations;
    std::vector<std::string> messages; // of the validation layer or the GL
    std::vector<std::string> logLines; // the worker's last lines: crash, timeout
    std::string planesFile;            // relative to the run's folder; empty when not kept
    std::string traceFile;             // of the worst pixel, relative to the run's folder; empty when there is none
    std::string traceNote;             // why a failure has no trace; empty otherwise
};

// How well the questions of a case's pixels are posed (harness/run/conditioning.h).
struct ConditioningResult {
    struct Worst {
        int x = 0, y = 0;
        double condition = 0; // may be infinite
        int cause = 0;        // an InputGroup
    };
    struct Output {
        std::string output;
        uint64_t pixels = 0;                 // that trace a ray
        uint64_t undecidable = 0;            // of them, above the bound
        uint64_t fragile = 0;                // decidable, and yet lost by float arithmetic: never excused
        double median = 0, p95 = 0, max = 0; // of the finite conditions
        std::optional<Worst> worst;
    };
    double bound = 0;
    std::string file; // relative to the run's folder; empty when not kept
    std::string note; // why it was not measured; empty otherwise
    std::vector<Output> outputs;
};

struct CaseResult {
    std::string name;
    std::string summary;
    std::vector<std::string> tags;
    SourcePosition position;
    int width = 0, height = 0;
    bool mustFail = false;
    double prepareMs = 0;     // scene, G-buffer
    double compileMs = 0;     // shaders and the job, of both precisions
    std::string answeredBy;   // "cache" or "interrupted run" where no backend was asked; else empty
    std::string inputKey;     // of all that the verdicts depend on; empty when it could not be prepared
    std::string expectedFile; // expected planes, relative to the run's folder; empty when not kept
    std::optional<ConditioningResult> conditioning; // where it was measured
    std::vector<BackendResult> backends;            // in the run's order; those that were not reached are absent
};

struct BackendRecord {
    Fingerprint fingerprint;
    double startMs = 0;           // the first worker, from process start to an open device
    std::string environmentError; // why no device could be opened; empty otherwise
};

struct RunCounts {
    std::map<Verdict, int> byVerdict;
    int passed = 0, failed = 0, skipped = 0;
};

// What the parts of a run must have in common to be merged (run_plan.h makes and compares them).
struct RunPlan {
    std::string hash;      // over all below but `partition` and `ownCases`; empty: not known
    uint64_t cases = 0;    // selected, in all parts together
    uint64_t ownCases = 0; // of these in this run
    std::string names;     // hash over the names of all
    std::string contents;  // hash over their files
    std::string partition; // how they were parted: "4 parts by name"; "whole"
    std::string shaders;   // hash over the shader folder
    std::string harness;   // version, sources and compilers
    std::string options;   // what can change a verdict
};

// A part that a merged run holds.
struct MergedPart {
    std::string shard;   // "2/4"
    std::string attempt; // that was taken
    std::string started; // UTC
    double seconds = 0;
    uint64_t cases = 0;
    std::map<std::string, std::string> devices; // by backend: device, driver, processor
};

struct RunResult {
    std::string version;   // of crossray
    std::string commit;    // "" when unknown
    bool modified = false; // the working tree differs from the commit
    std::string started;   // UTC, "2026-01-31T12:00:00Z"
    double seconds = 0;
    double firstVerdictMs = -1; // from the start of the process; -1 when there was none
    bool interrupted = false;
    bool stoppedEarly = false; // by -x, --max-fail or a broken case
    std::vector<std::string> commandLine;
    bool validation = false;
    int cores = 0;
    int repeat = 1;
    std::optional<uint64_t> seed;
    std::string shard;   // "2/3" or ""
    std::string attempt; // which run of this shard; "" for one that has none
    RunPlan plan;
    std::vector<MergedPart> parts;                // of a merged run
    std::vector<std::string> missingParts;        // "3/4": of a run that was merged without them
    std::map<std::string, std::string> compilers; // "glslang" -> version, ...
    uint64_t toolPeakBytes = 0;                   // resident memory
    uint64_t workersPeakBytes = 0;                // summed over the workers
    std::map<std::string, BackendRecord> backends;
    std::vector<std::string> brokenFiles; // one line each: file:line:column: what is wrong
    std::vector<std::string> unchanged;   // --changed: cases that have passed with these inputs, by name
    std::vector<CaseResult> cases;
    std::optional<RunCounts> countsOfAll; // where `cases` holds only some of the run's
    int exitCode = 0;
};

RunCounts countVerdicts(const RunResult& run);
void addToCounts(RunCounts& counts, const CaseResult& testCase);
// What a person looks at first: the failed expectation with the largest share of failed pixels; null without one.
const ExpectationResult* findWorstExpectation(const CaseResult& testCase, const BackendResult& result);
// "12 passed, 0 failed, 1 skipped": the last line of every run.
std::string formatCounts(const RunCounts& counts);
// The exit code that the results alone ask for, by precedence: interrupted, environment, broken input, a failure,
// nothing.
ExitCode computeExitCode(const RunResult& run);

} // namespace crossray
