// The methods of this library on a case's scene, on a real device: how far their answers are from the truth, what they
// read, and how long they take.
#pragma once

#include "harness/bench/chart.h"
#include "harness/case/case.h"
#include "harness/compile/compile.h"
#include "harness/run/environment.h"

#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace crossray {

// One way to answer a case's rays.
struct BenchMethod {
    std::string name;
    std::string kind; // "proxy", "linear", "hiz", "patches", "own"; of refraction: "none", "thin", "box", "sphere"
    std::function<void(Case&)> apply;
    int scale = 1;       // 2: at half the width and height, each answer standing for four pixels
    int captureSize = 0; // texels a side of a cubemap that it renders each frame; 0: none
};
// Those that go with the case's effect: for reflections the projections, for refractions the models.
std::vector<BenchMethod> makeBenchMethods(const Case& testCase);
// A person's own tracer by "NAME=FILE". Throws InputError that says what is allowed.
BenchMethod makeOwnMethod(const std::string& text);

struct BenchTime { // milliseconds of the passes: by the device's clock where it is right, else around a finish
    double median = 0, fastest = 0, slowest = 0;
    double ratio = 0; // median over that of a pass that only reads the G-buffer and writes the outputs
};

struct BenchPoint {
    std::string method, kind;
    // By name, all so that less is better. Reflections: Wrong (missed or wrong answerable rays and claimed unanswerable
    // ones, of all rays), Missed (of the answerable), False (of the unanswerable), HitDepth (mean relative error over
    // the answerable, 1 where there is no answer), HitPositionSS (median of the right hits, pixels), Flips (where asked
    // for: of the rays, those whose class changes where the camera moves by a hundredth of a pixel, the mean of 16
    // directions; of analytic scenes without a previous frame). Refractions: RayDirWS (mean, degrees), RayOriginWS and
    // PathLength (mean, metres). Those of the other families: family.h.
    std::map<std::string, double> errors;
    // Fetches and FetchesOf32 (of the depth buffer, its pyramid or a pixel's surface, a pixel of the full image, and
    // the mean over 32 neighbouring rays of the largest), Iterations and IterationsOf32, counted by the shader; of
    // refractions Instructions (of the SPIR-V module). Exact: they do not depend on the device's speed.
    std::map<std::string, double> counters;
    BenchTime time;
};

// What a BenchScene of the case calls its effect.
std::string effectNameOf(const Case& testCase);

struct BenchScene {
    std::string name;     // of the case
    std::string effect;   // "reflection" or "refraction"; of the other families their name
    double parameter = 0; // what the cases of one family differ in: of "glossy" the roughness
    int width = 0, height = 0;
    double rays = 0;
    double unknowable = 0;             // share of the rays whose end no screen shows
    double oracleWrong = 0;            // share that even the best reader of the depth buffer answers wrongly
    std::optional<double> trueFlips{}; // Flips of the truth itself
    double baselineMs = 0;
    std::vector<BenchPoint> points;
    std::string needs, budget; // the case's own claim; empty: none
};

struct BenchOptions {
    std::string backend = "lavapipe";
    int rounds = 9;               // each runs every method once, A B C A B C; one more before them is not counted
    std::vector<BenchMethod> own; // beside the library's
    bool jitter = false;          // measures Flips, in 16 runs more of each method
};

struct BenchResult {
    Fingerprint fingerprint;
    std::string command;
    std::vector<BenchScene> scenes;
};

// Throws EnvironmentError when the backend cannot be opened, ShaderError when a method's shader is refused, InputError
// when a method of the person's own cannot be measured there.
BenchScene benchCase(const Case& testCase, const BenchOptions& options, WorkerPool& pool, ShaderCompiler& compiler,
                     const Folders& folders);

} // namespace crossray
