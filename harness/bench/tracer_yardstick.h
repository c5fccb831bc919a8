// The yardstick for screen-space tracers: mirror rays of random rooms, what each really meets, and how well and at what
// cost a tracer finds it by the depth buffer alone.
#pragma once

#include "harness/scene/gbuffer.h"

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
    glm::dvec2 hitPositionSS{0.0}; // answerable and hidden
    double hitLinearDepth = 0;     // metres
};

struct YardstickScene {
    uint64_t seed = 0;
    GBuffer gbuffer;                // device depth and normal
    std::vector<YardstickRay> rays; // row by row
};

// The random room of a seed: the reflected ray of every `stride`-th pixel of every `stride`-th row that shows a
// surface.
YardstickScene makeYardstickRoom(uint64_t seed, int width, int height, int stride = 4);

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
    double medianPixels = 0; // error of the right ones
    double p95Pixels = 0;    // 95th percentile
    double medianDepth = 0;  // relative error of their depth
    double fetches = 0;      // a ray
    double groupFetches = 0; // the mean over 32 neighbouring rays of their maximum: what a GPU pays
    double iterations = 0;   // a ray
    double capped = 0;       // share of all rays
};
TracerScore scoreTracer(const YardstickScene& scene, const Tracer& tracer);

// A row of the table: means over scenes, and the worst scene.
struct TracerRow {
    std::string name;
    TracerScore mean;
    TracerScore worst; // of each column
    int scenes = 0;
};
TracerRow summarize(std::string name, std::span<const TracerScore> scores);

// Every method on the rooms of the seeds [first, last]; a room is made once for all. Calls `report` after each room.
std::vector<TracerRow> measureTracers(std::span<const TracerMethod> methods, uint64_t firstSeed, uint64_t lastSeed,
                                      int width, int height, const std::function<void(uint64_t)>& report = {});

// A Markdown table.
std::string formatTracerTable(std::span<const TracerRow> rows);

// The library's tracers as they ship, compiled as C++ in float: planes (project/patch_tracer.glsl) at four cautions,
// and the depth pyramid (project/hiz.glsl) from level 0, with this thickness in metres. Their state is per thread: one
// tracer of these is in use at a time.
std::vector<TracerMethod> libraryTracers(double thickness);

} // namespace crossray
