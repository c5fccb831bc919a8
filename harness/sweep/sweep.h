// One parameter of a case run through its failing edge: at each value the case is made anew, as if the file said so,
// and every backend's answer is held against what the case itself expects there.
#pragma once

#include "harness/case/case.h"
#include "harness/compile/compile.h"
#include "harness/judge/judge.h"
#include "harness/run/environment.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace crossray {

// "FROM..TO[:STEPS][:log]". Both ends are among the values.
struct SweepRange {
    double from = 0, to = 1;
    int steps = 25;
    bool isLog = false;

    // Throws InputError with what is allowed: two numbers that differ, 2 to 1000 steps, log between positive ends.
    static SweepRange parse(const std::string& text);
    // In order from `from` to `to`; of an integer key rounded, each once.
    std::vector<double> values(bool isInteger) const;
    // Between two values in the sense of the range: the geometric mean where it is log.
    double middle(double a, double b) const;
    // Their distance as a share of the range.
    double distance(double a, double b) const;
};

// The keys of the case format that a number is run through: "material.ior"; of a list one number: "scene.size.0";
// several by commas are set to one value: "camera.eye.1,camera.target.1".
struct SweepKeys {
    std::vector<std::string> paths;
    bool isInteger = false; // all of them take whole numbers alone

    // Throws InputError that names the nearest key and all that are allowed.
    static SweepKeys parse(const std::string& text);
};

struct SweepPlan {
    std::filesystem::path file;
    std::string caseName;  // the case, or the sub-case
    std::string parameter; // as it was written
    SweepKeys keys;
    SweepRange range;
    std::map<std::string, std::string> overrides; // for all values alike
    double width = 1e-4;                          // of a bisected edge, as a share of the range
};

// The case at one value. Throws InputError where the format, or how the keys fit together, refuses it; and where the
// file holds several cases of which `caseName` chooses none.
Case makeCaseAt(const SweepPlan& plan, double value);

// One expectation of the case with a plane of its own, on one backend.
struct SweepError {
    std::string output, source, unit;
    double mean = 0, p99 = 0, max = 0; // of the finite errors
    uint64_t compared = 0;             // pixels; where there are none nothing is said
    double failed = 0;                 // share of them beyond the case's own tolerance
    bool passed = false;
    std::map<std::string, double> metrics; // of budgets: recall, precision, false
};

// Shares of the pixels that trace, by class and reason: "hit", "miss: left the scene"; of planar probes beside it by
// what the look-up found, "planar: shown".
using ClassShares = std::map<std::string, double>;

struct SweepCell {
    std::string backend;
    std::string failure;            // crash, time-out, refused shader; empty: it answered
    std::vector<SweepError> errors; // in the case's order
    ClassShares classes;
    double meanIterations = 0, maxIterations = 0;
    uint64_t notFinite = 0; // values that are NaN or infinite, of all outputs at all pixels
    std::string notFiniteOutputs;
    double differs = 0; // share of the tracing pixels whose class or reason is not cpu64's
};

// What of a value's answer is kept for the explanation of an edge: each tracing pixel's class, and the angle at which
// the eye's ray meets the surface, degrees.
struct SweepPixels {
    int width = 0, height = 0;
    std::vector<int> kinds; // class * 100 + reason, -1 at pixels that do not trace
    std::vector<float> incidence;
};

struct SweepRow {
    double value = 0;
    std::string refused;          // why the format does not take it; then there are no cells
    bool isAtEdge = false;        // added by the bisection
    std::vector<SweepCell> cells; // in the order of SweepResult::backends
    SweepPixels pixels;           // of cpu64
};

enum class EdgeKind { kRefused, kFiniteness, kFailure, kClasses, kTolerance, kError, kDisagreement };
std::string_view nameOf(EdgeKind kind);

struct SweepEdge {
    EdgeKind kind = EdgeKind::kClasses;
    std::string backend;      // on which it was found
    double low = 0, high = 0; // it lies between these two values of the parameter, in the order of the range
    bool isGradual = false;   // what changes here goes on changing
    std::string sentence;
};

struct SweepResult {
    std::string id; // file name without extension
    std::string caseName, summary, parameter, command;
    SweepRange range;
    bool isInteger = false;
    double width = 0;
    std::vector<std::string> backends; // cpu64 among them
    std::vector<SweepRow> rows;        // in the order of the range
    std::vector<SweepEdge> edges;
};

// The row of one value, with a cell for each of the backends, cpu64 among them; a bisection asks for few.
using MeasureValue = std::function<SweepRow(double value, const std::vector<std::string>& backends)>;

// Rows of all values, the edges between them bisected, and a row on either side of each. Throws InputError when every
// value is refused.
SweepResult runSweep(const SweepPlan& plan, const std::vector<std::string>& backends, const MeasureValue& measure);

// On real devices. `jobs` backends answer at once.
struct SweepDevices {
    WorkerPool& pool;
    ShaderCompiler& compiler;
    std::filesystem::path shaders;
    int jobs = 1;
};
SweepRow measureOnDevices(const SweepPlan& plan, double value, const std::vector<std::string>& backends,
                          const SweepDevices& devices);

// Where something jumps between neighbouring rows, as the two rows' places.
struct SweepJump {
    EdgeKind kind = EdgeKind::kClasses;
    size_t cell = 0;                 // backend
    size_t row = 0;                  // and the next one
    bool isStart = true;             // the first pair of a run of changing rows, or all of it; else the last
    size_t runBegin = 0, runEnd = 0; // rows before and after the run
};
std::vector<SweepJump> findJumps(const SweepResult& result);

std::string formatSweepTable(const SweepResult& result);
std::string formatSweepCsv(const SweepResult& result);
std::string formatSweepJson(const SweepResult& result);
std::string formatSweepSvg(const SweepResult& result);

// One entry of a list of sweeps.
struct ListedSweep {
    std::string id, title, testCase, parameter, range;
    std::map<std::string, std::string> overrides;
    std::string shows, why; // what it shows, and why the edge is where it is
};
// A TOML file of [[sweep]] tables with the keys id, title, case, parameter, range, set, shows and why. Throws
// InputError with file:line:column.
std::vector<ListedSweep> readSweepList(const std::filesystem::path& file);

} // namespace crossray
