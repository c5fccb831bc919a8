#include "harness/base/outputs.h"

#include <array>

namespace crossray {

namespace {

constexpr std::array kOutputs{
    OutputInfo{0, "Color", OutputType::kColor, 3, "radiance", "Colour of what the ray found, weighted and composited."},
    OutputInfo{1, "RayDirWS", OutputType::kDirection, 3, "", "Unit direction of the traced ray in world space."},
    OutputInfo{2, "HitDepth", OutputType::kDepth, 1, "m", "Linear depth of the hit along the view axis; 0 where none."},
    OutputInfo{3, "HitSuccess", OutputType::kHitClass, 1, "", "0 no raycast, 1 hit, 2 miss, 3 unknown."},
    OutputInfo{4, "HitReason", OutputType::kCount, 1, "", "Why the hit class is what it is; crossray/shared/outputs.glsl."},
    OutputInfo{5, "TracingModel", OutputType::kCount, 1, "", "Projection model that answered for this pixel."},
    OutputInfo{6, "PositionNDC", OutputType::kScalar, 2, "", "End of the ray in normalised device coordinates, y up."},
    OutputInfo{7, "RayDirNDC", OutputType::kScalar, 3, "", "Unit direction on screen in NDC; z: change of 1/linear depth along it."},
    OutputInfo{8, "IterationCount", OutputType::kCount, 1, "", "Steps that the tracer took."},
    OutputInfo{9, "MaxUsedMipLevel", OutputType::kCount, 1, "", "Coarsest pyramid level that the tracer read."},
    OutputInfo{10, "IntersectionKind", OutputType::kCount, 1, "", "Last intersection: 0 none, 1 cell, 2 depth."},
    OutputInfo{11, "HitWeight", OutputType::kScalar, 1, "", "Weight of the hit in the hierarchy, 0 to 1."},
    OutputInfo{12, "SampledColor", OutputType::kColor, 3, "radiance", "Colour read at the hit, before any weight."},
    OutputInfo{13, "HitPositionSS", OutputType::kScalar, 2, "px", "Hit on screen, origin at the top left corner."},
    OutputInfo{14, "PathLength", OutputType::kDepth, 1, "m", "Way inside the refracting material."},
    OutputInfo{15, "RayOriginWS", OutputType::kScalar, 3, "m", "Start of the traced ray in world space."},
    OutputInfo{16, "TierWeights", OutputType::kScalar, 4, "", "What the screen, standard probes, planar probes and the sky got."},
    OutputInfo{17, "ProbeWeights", OutputType::kScalar, 4, "", "What each of the case's first four probes got."},
    OutputInfo{18, "ProbeDirWS", OutputType::kDirection, 3, "", "Direction in which the first probe that got something is read; 0 without one."},
    OutputInfo{19, "ProbeMipLevel", OutputType::kScalar, 1, "", "Mip level at which it is read."},
    OutputInfo{20, "Confidence", OutputType::kScalar, 1, "", "Share of such hits that are right; 0 without a hit, 1 where the model does not say."},
    OutputInfo{21, "PlanarUV", OutputType::kScalar, 2, "", "Where the first planar probe that reaches the pixel shows its reflection; [0,1], v down."},
    OutputInfo{22, "PlanarStatus", OutputType::kCount, 1, "", "Why that is nowhere: 0 it is not; pass/planar_tier.glsl."},
    OutputInfo{23, "Transmittance", OutputType::kColor, 3, "", "Share of light that the way inside the material leaves."},
    OutputInfo{24, "ColorMipLevel", OutputType::kScalar, 1, "", "Level of the previous frame's colour pyramid that was read."},
    OutputInfo{25, "HistoryUV", OutputType::kScalar, 2, "", "Where the hit was on screen in the previous frame; 0 where it was not."},
    OutputInfo{26, "FetchCount", OutputType::kCount, 1, "", "Reads of the depth buffer or a pyramid of it that finding the hit took."},
};

} // namespace

std::span<const OutputInfo> allOutputs() { return kOutputs; }

std::optional<OutputInfo> findOutput(std::string_view name)
{
    for (const OutputInfo& info : kOutputs) {
        if (info.name == name) return info;
    }
    return std::nullopt;
}

std::string_view nameOf(HitClass hitClass)
{
    switch (hitClass) {
    case HitClass::kNoRaycast: return "no raycast";
    case HitClass::kHit: return "hit";
    case HitClass::kMiss: return "miss";
    case HitClass::kUnknown: return "unknown";
    }
    return "not a class";
}

} // namespace crossray
