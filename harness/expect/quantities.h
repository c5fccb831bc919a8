// The tables of closed forms and truth quantities: by name, what they can answer for, and how.
#pragma once

#include "harness/expect/analytic.h"
#include "harness/expect/analytic_probe.h"
#include "harness/expect/expect.h"

#include <string_view>
#include <vector>

namespace crossray {

// The outputs that a closed form or the truth answers for; the numbers are those of base/outputs.h.
enum class Output : int {
    kColor = 0,
    kRayDirWS = 1,
    kHitDepth = 2,
    kHitSuccess = 3,
    kHitReason = 4,
    kPositionNDC = 6,
    kRayDirNDC = 7,
    kIterationCount = 8,
    kHitWeight = 11,
    kSampledColor = 12,
    kHitPositionSS = 13,
    kPathLength = 14,
    kRayOriginWS = 15,
    kTierWeights = 16,
    kProbeWeights = 17,
    kProbeDirWS = 18,
    kProbeMipLevel = 19,
    kPlanarUV = 21,
    kPlanarStatus = 22,
    kTransmittance = 23,
    kColorMipLevel = 24,
    kHistoryUV = 25,
    kFetchCount = 26,
};

// All that a quantity may know of one pixel; each fills what it answers for.
struct PixelAnswer {
    EffectRay ray;
    HitClass hitClass = HitClass::kNoRaycast;
    HitReason reason = HitReason::kNone;
    double hitDepth = 0;
    glm::dvec2 hitPositionSS{0.0};
    glm::dvec2 positionNDC{0.0}; // x right, y up, [-1,1] on screen
    glm::dvec3 rayDirNDC{0.0};
    int iterations = 0;
    int fetches = 0;
    double hitWeight = 0;
    glm::dvec3 radiance{0.0};
    HierarchyShare share;
    PlanarPlace planar;
    glm::dvec3 transmittance{0.0};
    glm::dvec3 composite{1.0}; // what the refracting surface lets through of the radiance
    double mipLevel = 0;
    glm::dvec2 historyUV{0.0};
};

// What the quantities work on; `truth` only where the quantity asks for it.
struct QuantityInput {
    const CaseData& data;
    const Case& testCase;
    CameraFrame frame;
    const std::vector<SurfacePoint>* surfaces = nullptr;
    const Truth* truth = nullptr;
};

// For those that need the truth in any case.
inline bool always(const Case&)
{
    return true;
}

struct Quantity {
    ClosedForm info;
    std::vector<Output> outputs;
    bool (*needsTruth)(const Case& testCase) = nullptr; // null: never
    // Why the case cannot be asked for it, or empty.
    std::string (*refuse)(const Case& testCase, Output output) = nullptr;
    PixelAnswer (*answer)(const QuantityInput& input, size_t pixel) = nullptr;
};

// Those of the hierarchy; part of analyticQuantities().
std::vector<Quantity> hierarchyQuantities();
// Those of the Built-in and the URP profile; part of it, too.
std::vector<Quantity> profileQuantities();
// What the case's surface lets through: 1 for a mirror.
glm::dvec3 compositeOf(const Case& testCase, const SurfacePoint& surface, double pathLength);
// A refracted ray's hit at that depth lies in front of the surface that refracts.
bool isBeforeSurface(const QuantityInput& input, size_t pixel, double linearDepth);
// Radiance that the pixel itself shows.
glm::dvec3 ownColor(const CaseData& data, size_t pixel);

const std::vector<Quantity>& analyticQuantities();
std::vector<Quantity> planarQuantities();
const std::vector<Quantity>& truthTable();

// A quantity whose info's output names are those of `outputs`.
Quantity makeQuantity(std::string name, std::string summary, std::vector<Output> outputs,
                      bool (*needsTruth)(const Case&), std::string (*refuse)(const Case&, Output),
                      PixelAnswer (*answer)(const QuantityInput&, size_t));

} // namespace crossray
