// The yardstick for screen-space tracers: mirror rays of random rooms, what each really meets, and how well and at what
// cost a tracer finds it by the depth buffer alone.
#pragma once

#include "harness/expect/expect.h"
#include "harness/scene/gbuffer.h"
#include "harness/scene/scene_families.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace crossray {

// What is true of a ray, as far as a screen can know it.
enum class RayTruth {
    kAnswerable, // its hit is on screen, nothing is in front of it, and it faces the camera
    kHidden,     // on screen, but something is in front, or its back is what the ray met
    kOffScreen,
    kNothing, // the ray leaves the scene
};

struct YardstickRay {
    int x = 0, y = 0; // the pixel at whose centre it starts
    glm::dvec3 dirWS{0.0};
    RayTruth truth = RayTruth::kNothing;
    glm::dvec2 hitPositionSS{0.0};        // answerable and hidden
    double hitLinearDepth = 0;            // metres
    std::optional<glm::dvec3> originWS{}; // where it starts, of a refraction; nothing: at the pixel's surface
};

struct YardstickScene {
    uint64_t seed = 0;
    GBuffer gbuffer;                // device depth and normal
    std::vector<YardstickRay> rays; // row by row
    double depthError = 0;          // affine depth by which the depth buffer may be wrong (PatchTracerSettings)
    uint64_t serial = 0;            // no two scenes of a process have the same; 0: none
};

// What is done to a G-buffer before a tracer sees it. The rays and their truth stay those of the undisturbed scene.
enum class Disturbance {
    kNone,
    kNormalMap,     // normals bent by waves of 17 degrees and more
    kSmoothNormals, // boxes with the normals of a mesh whose eight vertices share one normal each; as far as 55 degrees
    kNoNormals,     // zero
    kDepth24,       // 24-bit fixed point
    kDepth16,       // 16-bit fixed point
    kNoise,         // linear depth off by up to 0.1 %, evenly
    kStandard32,    // standard instead of reversed depth, as 32-bit float
    kStandard24,    // 24-bit fixed point
    kStandard16,    // 16-bit fixed point
};
std::span<const Disturbance> allDisturbances();
std::string_view nameOf(Disturbance disturbance);
std::optional<Disturbance> findDisturbance(std::string_view name);

// The random scene of a family and a seed: the reflected ray of every `stride`-th pixel of every `stride`-th row that
// shows a surface.
YardstickScene makeYardstickScene(SceneFamily family, uint64_t seed, int width, int height, int stride = 4,
                                  Disturbance disturbance = Disturbance::kNone);
YardstickScene makeYardstickRoom(uint64_t seed, int width, int height, int stride = 4);

// A case's own scene, recorded ones too: the rays are those of its truth, reflected or refracted, and the G-buffer is
// what its screen shows. The library's tracers alone know rays that start elsewhere than at their pixel.
YardstickScene makeYardstickScene(const CaseData& data);

// What a tracer says of one ray.
struct TracerAnswer {
    bool isHit = false;
    bool isCapped = false; // ended by its iteration cap
    glm::dvec2 positionSS{0.0};
    double linearDepth = 0;
    double confidence = 0; // 0 where the tracer has none
    int fetches = 0;       // reads of the depth, its pyramid, or a pixel's surface
    int iterations = 0;
};
using Tracer = std::function<TracerAnswer(const YardstickRay&)>;

// A method, ready for any scene: `prepare` builds its pyramid. The scene must outlive the tracer.
struct TracerMethod {
    std::string name;
    std::function<Tracer(const YardstickScene&)> prepare;
};

// One tracer on one scene. Right: a claimed hit of an answerable ray within kRightPixels of the truth. Shares whose
// whole is empty are 1 for recall and precision and 0 for the others.
inline constexpr double kRightPixels = 2.0;
struct TracerScore {
    double recall = 0;       // right, of the answerable
    double precision = 0;    // right, of the claimed
    double falseShare = 0;   // claimed, of the unanswerable
    double wrong = 0;        // answerable rays without a right hit and unanswerable ones with a hit, of all rays
    double medianPixels = 0; // error of the right ones
    double p95Pixels = 0;    // 95th percentile
    double medianDepth = 0;  // relative error of their depth
    double fetches = 0;      // a ray
    double groupFetches = 0; // the mean over 32 neighbouring rays of their maximum: what a GPU pays
    double iterations = 0;   // a ray
    double capped = 0;       // share of all rays
};
struct ReliabilityBin;
// `bins` receive sums over the hits that have a confidence; empty: none are kept.
TracerScore scoreTracer(const YardstickScene& scene, const Tracer& tracer, std::span<ReliabilityBin> bins = {});

// A row of the table: means over scenes, and the worst scene.
struct TracerRow {
    std::string name;
    TracerScore mean;
    TracerScore worst; // of each column
    int scenes = 0;
};
TracerRow summarize(std::string name, std::span<const TracerScore> scores);

// Of hits that were said to be about so sure, so many were right.
struct ReliabilityBin {
    double confidence = 0; // mean of what was said
    double right = 0;      // share
    double count = 0;
};
inline constexpr int kReliabilityBins = 20; // of equal width
struct MeasuredTracer {
    TracerRow row;
    std::vector<ReliabilityBin> reliability; // over all scenes; empty bins left out; empty without a confidence
};

struct YardstickOptions {
    SceneFamily family = SceneFamily::kRandomRoom;
    Disturbance disturbance = Disturbance::kNone;
    uint64_t firstSeed = 1, lastSeed = 24;
    int width = 640, height = 360;
    int stride = 4;
    int threads = 1;
};

// Every method on the scenes of the seeds; a scene is made once for all. Calls `report` after each scene, from one
// thread at a time.
std::vector<MeasuredTracer> measureTracers(std::span<const TracerMethod> methods, const YardstickOptions& options,
                                           const std::function<void(uint64_t)>& report = {});
std::vector<MeasuredTracer> measureTracers(std::span<const TracerMethod> methods, const YardstickScene& scene);

// A Markdown table.
std::string formatTracerTable(std::span<const MeasuredTracer> rows);

// The library's tracers as they ship, compiled as C++ in float: planes (project/patch_tracer.glsl) at several cautions,
// and the depth pyramid (project/hiz.glsl) at several settings, with this thickness in metres. Their state is per
// thread: one tracer of these is in use at a time.
std::vector<TracerMethod> libraryTracers(double thickness);

// Other ways to trace, written for this yardstick from their descriptions, in doubles (reference_tracers.cpp): what the
// library's are held against. The last is no tracer but a bound: it knows where each ray ends, and claims what the
// depth buffer shows there.
std::vector<TracerMethod> referenceTracers(double thickness);
TracerMethod depthOracle();

// The library's tracer that a case's projection names, with its settings; nothing for a proxy.
std::optional<Tracer> caseTracer(const Projection& projection, const YardstickScene& scene);

} // namespace crossray
