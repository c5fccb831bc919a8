// The library's sort key as C++: GLM as GLSL is a GLM of its own, so it has a unit of its own.
#define CROSSRAY_GLSL_PRECISION 64
#include "harness/backend/cpu/glsl.h"

#include "crossray/probe/hdrp_order.glsl"

#include "harness/backend/cpu/glsl_end.h"

namespace crossray::hdrp {

int keyOf(double x, double y, double z);

int keyOf(double x, double y, double z)
{
    using namespace crossray::cpu64;
    return computeHdrpProbeKey(vec3(x, y, z));
}

} // namespace crossray::hdrp
