#include "harness/pass/trace_variant.h"

#include "harness/pass/planar_params.h"

namespace crossray {

uint32_t makeOutputMask(const Case& testCase)
{
    uint32_t mask = 0;
    for (const OutputInfo& output : testCase.outputs)
        mask |= 1u << output.id;
    return mask;
}

namespace {

// The bits of shaders/pass/probe_profiles.glsl.
int makeProfileSwitches(const ProfileSettings& profile)
{
    int bits = 0;
    int bit = 1;
    for (const bool isOn :
         {profile.blending, profile.boxProjection, profile.forwardPlus, profile.halfPrecision, profile.exactMip,
          profile.gammaSpace, profile.boxProjectionForm == BoxProjectionForm::kSelect}) {
        bits |= isOn ? bit : 0;
        bit *= 2;
    }
    return bits;
}

} // namespace

std::map<std::string, double> makeTraceVariant(const Case& testCase)
{
    const Camera& camera = testCase.camera;
    return {
        {"kEffect", testCase.effect == TraceEffect::kRefraction ? 1 : 0},
        {"kRefractionModel", static_cast<int>(testCase.material.refractionModel)},
        {"kProjectionModel", static_cast<int>(testCase.projection.model)},
        {"kOutputMask", makeOutputMask(testCase)},
        {"kOrthographic", camera.projection == ProjectionKind::kOrthographic ? 1 : 0},
        {"kReversedDepth", camera.depthConvention == DepthConvention::kStandard ? 0 : 1},
        {"kThicknessMap", testCase.material.thicknessMap ? 1 : 0},
        {"kFresnel", static_cast<int>(testCase.material.fresnel)},
        {"kColorSource", testCase.history ? 1 + static_cast<int>(testCase.history->reprojection) : 0},
        {"kScreenWeightForm", static_cast<int>(testCase.projection.screenWeightForm)},
        {"kHierarchy", testCase.hierarchy},
        {"kSkyModel", static_cast<int>(testCase.sky.model)},
        {"kProbeProfile", static_cast<int>(testCase.probeProfile)},
        {"kProfileSwitches", makeProfileSwitches(testCase.profile)},
        {"kPlanarTier", usesPlanarProbes(testCase) ? 1 : 0},
    };
}

} // namespace crossray
