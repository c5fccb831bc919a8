#include "harness/pass/trace_variant.h"

namespace crossray {

uint32_t makeOutputMask(const Case& testCase)
{
    uint32_t mask = 0;
    for (const OutputInfo& output : testCase.outputs)
        mask |= 1u << output.id;
    return mask;
}

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
        {"kScreenWeightForm", static_cast<int>(testCase.projection.screenWeightForm)},
        {"kHierarchy", testCase.hierarchy},
        {"kSkyModel", static_cast<int>(testCase.sky.model)},
    };
}

} // namespace crossray
