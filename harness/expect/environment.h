// The cubemap that an environment of a case stands for.
#pragma once

#include "harness/case/case.h"
#include "harness/scene/cubemap.h"

namespace crossray {

// With its whole mip chain. A gradient is taken at the texels' centres. `probe` is the one that it belongs to, null for
// a sky's. Throws what loadCubemap of harness/expect/captures.h throws.
Cubemap makeEnvironment(const Case& testCase, const Environment& environment, const Probe* probe);

} // namespace crossray
