// The order of probes, by the shader library's own key: so a test of that file is a test of this order.
#include "harness/pass/probe_params.h"

#include <algorithm>
#include <numeric>

namespace crossray {

namespace hdrp {
int keyOf(double x, double y, double z);
}

std::vector<size_t> orderProbes(const Case& testCase)
{
    const std::vector<Probe>& probes = testCase.probes;
    std::vector<size_t> order(probes.size());
    std::iota(order.begin(), order.end(), size_t{0});
    if (testCase.probeProfile != ProbeProfile::kHdrp) return order;
    const auto keyOf = [&](size_t probe) {
        const glm::dvec3& extents = probes[probe].influence.halfExtents;
        return hdrp::keyOf(extents.x, extents.y, extents.z);
    };
    // Stable: equal keys stay in the order of the case.
    std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return keyOf(a) < keyOf(b); });
    return order;
}

} // namespace crossray
