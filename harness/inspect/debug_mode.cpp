#include "harness/inspect/debug_mode.h"

#include "harness/base/error.h"
#include "harness/inspect/names.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace crossray {

namespace {

using enum Encoding;
using enum DebugMode::March;

constexpr DebugMode kModes[] = {
    {"None", "", kColor, kAny},
    {"Color", "Color", kColor, kAny},
    {"RayDirWS", "RayDirWS", kDirection, kAny},
    {"HitDepth", "HitDepth", kLinearDepth, kAny},
    {"HitSuccess", "HitSuccess", kHitClass, kAny},
    {"HitReason", "HitReason", kIndex, kAny},
    {"TracingModel", "TracingModel", kIndex, kAny},
    {"HiZPositionNDC", "PositionNDC", kPositionNDC, kPyramid},
    {"HiZRayDirNDC", "RayDirNDC", kRayDirNDC, kPyramid},
    {"HiZIterationCount", "IterationCount", kCount, kPyramid},
    {"HiZMaxUsedMipLevel", "MaxUsedMipLevel", kCount, kPyramid},
    {"HiZIntersectionKind", "IntersectionKind", kIndex, kPyramid},
    {"HiZHitWeight", "HitWeight", kWeight, kPyramid},
    {"HiZSampledColor", "SampledColor", kColor, kPyramid},
    {"LinearPositionNDC", "PositionNDC", kPositionNDC, kLinear},
    {"LinearRayDirNDC", "RayDirNDC", kRayDirNDC, kLinear},
    {"LinearIterationCount", "IterationCount", kCount, kLinear},
    {"LinearHitWeight", "HitWeight", kWeight, kLinear},
    {"LinearSampledColor", "SampledColor", kColor, kLinear},
};

bool isPyramidMarch(ProjectionModel model)
{
    return model == ProjectionModel::kHiz || model == ProjectionModel::kPatches;
}

} // namespace

std::span<const DebugMode> debugModes()
{
    return kModes;
}

const DebugMode& findDebugMode(const std::string& name)
{
    std::vector<std::string_view> names;
    for (const DebugMode& mode : kModes) {
        if (mode.name == name) return mode;
        names.push_back(mode.name);
    }
    throw InputError(
        fmt::format("--debug-mode {}: there is no such mode; allowed are {}", name, fmt::join(names, ", ")));
}

void requireRecorded(const DebugMode& mode, const Case& testCase)
{
    const ProjectionModel model = testCase.projection.model;
    const bool casts = model != ProjectionModel::kNone;
    const bool isRay = mode.name == "None" || mode.output == "RayDirWS" || mode.output == "TracingModel";
    const bool isRecorded = mode.march == kPyramid  ? isPyramidMarch(model)
                            : mode.march == kLinear ? model == ProjectionModel::kLinear
                                                    : casts || isRay;
    if (isRecorded) return;
    throw InputError(fmt::format("--debug-mode {}: shows a {}; the tracing model of {} is \"{}\"", mode.name,
                                 mode.march == kPyramid  ? "march through a pyramid (hiz, patches)"
                                 : mode.march == kLinear ? "linear march"
                                                         : "projected ray",
                                 testCase.name, nameOfTracingModel(static_cast<int>(model))));
}

int maximumOf(const DebugMode& mode, const Case& testCase)
{
    const Projection& projection = testCase.projection;
    const bool isLevel = mode.output == "MaxUsedMipLevel";
    switch (projection.model) {
    case ProjectionModel::kHiz:
        return isLevel ? projection.hiz.maxLevel : projection.hiz.maxIterations;
    case ProjectionModel::kPatches:
        return isLevel ? projection.patches.maxLevel : projection.patches.maxIterations;
    case ProjectionModel::kLinear:
        return isLevel ? 0 : projection.linear.maxIterations;
    default:
        return 0;
    }
}

std::vector<EncodedColor> encodePlane(const DebugMode& mode, const Plane& plane, const Case& testCase)
{
    std::vector<EncodedColor> colors;
    colors.reserve(plane.pixelCount());
    const int maximum = maximumOf(mode, testCase);
    for (size_t pixel = 0; pixel < plane.pixelCount(); ++pixel) {
        const double* const value = plane.values.data() + pixel * static_cast<size_t>(plane.channels);
        colors.push_back(encodeForDisplay(mode.encoding, value, maximum));
    }
    return colors;
}

} // namespace crossray
