// Families of methods beside the projections and the refraction models, which bench_case.h has: what a case with a key
// `bench` is measured by. Each is a file family_NAME.cpp: its methods, its errors against a truth that shares no code
// with the shaders, its counters, and its charts.
#pragma once

#include "harness/backend/device.h"
#include "harness/bench/bench_case.h"
#include "harness/expect/expect.h"

#include <memory>
#include <span>

namespace crossray {

// What a method's run gave.
struct FamilyRun {
    const CaseData& data; // of the case as it stands in its file
    const Case& varied;   // as the method has it
    const std::vector<Plane>& planes;
    const Job& job;
    const BenchMethod& method;
    const void* prepared; // by BenchFamily::prepare
    const Plane& plane(std::string_view name) const;
};

struct BenchFamily {
    std::string name; // of the case's key, and BenchScene::effect
    std::vector<const char*> outputs;
    std::vector<std::string> errors;   // in the order in which a table shows them
    std::vector<std::string> counters; // the same
    bool judgesHits = false;           // the errors and steps of projections are measured beside
    std::vector<BenchMethod> (*makeMethods)(const Case& testCase) = nullptr;
    // What all methods of a case are held against, once a case; null: nothing but its truth.
    std::shared_ptr<const void> (*prepare)(const CaseData& data) = nullptr;
    void (*judge)(const FamilyRun& run, BenchPoint& point) = nullptr; // fills errors and counters
    std::vector<Chart> (*makeCharts)(std::span<const BenchScene* const> scenes, const std::string& device) = nullptr;
    std::vector<std::string> costs; // counters that a cheapest method is chosen by, the first one first
};

// Null for the effects' own, and for a name that is none.
const BenchFamily* findBenchFamily(const std::string& name);

// How far light comes out of a solid from where the models say (RayDirWS, RayOriginWS, PathLength): the refraction
// models' charts, which need no methods of their own.
std::vector<Chart> makeRefractionModelCharts(const BenchScene& scene, const std::string& device);

// What a refraction shows, by the way in which its colour is found. Errors: Color (mean over rays and channels of the
// difference to the radiance that the truth tracer sees along the exact refracted ray), ColorP95 (of the rays' means,
// the 95th percentile). Counters: Reads (a ray: of depth, pyramid, colour, probe texels), Rendered (texels and pyramid
// cells that are made for it each frame, a ray), Cost (their sum), FrameShare (texels rendered each frame, the frame's
// own among them, over the frame's own).
const BenchFamily& refractionTechniques();

// Which level of a probe's mip chain a roughness reads, by the Built-in pipeline's parabola (approximate) and by what
// that stands for (exact), of chains whose levels are means of four texels, captured at five sizes, and of one whose
// levels are lobes (gloss_reference.h). Errors: Color (mean over rays and channels of the difference to the integral
// over the GGX lobe), ColorBlinnPhong (over that of Blinn-Phong). Counters: Reads, Instructions, Making (radiances and
// texels that making the chain takes).
const BenchFamily& glossyMappings();

// Depth of 16, 24 and 32 bits, standard and reversed, under the tracers over planes and over the pyramid. Errors:
// Position and PositionP95 (median and 95th percentile of the distance between the surface's point read back and its
// true one, over its distance to the eye), and those of projections. Counters: Bits, and those of projections.
const BenchFamily& depthFormats();

// What charts call a case: the end of its name.
std::string shortNameOf(const std::string& caseName);
// Letters, digits and _ alone.
std::string chartIdOf(const std::string& name);

} // namespace crossray
