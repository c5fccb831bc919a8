// Environments that are no colours: a person's cubemap file, and the scene as a probe sees it, baked or at once. What
// the passes upload and the closed forms read.
#pragma once

#include "harness/case/case.h"
#include "harness/scene/cubemap.h"
#include "harness/scene/planar_capture.h"

#include <optional>

namespace crossray {

// The cubemap of an environment that holds a file or a capture; nothing where it holds colours. `probe` is the one that
// it belongs to, null for a sky's. Throws InputError: a file that is no cubemap (at the file), a baked one that is not
// there or was baked in another size (at the key, with the command that writes it).
std::optional<Cubemap> loadCubemap(const Case& testCase, const Environment& environment, const Probe* probe);

// What the probe sees now: a realtime capture, and what baking writes. The environment holds a SceneCapture. Mirrors
// look up the last capture on the probe's proxy.
Cubemap captureProbe(const Case& testCase, const Probe& probe);

// The mirror of a planar probe as its capture takes it.
PlanarCaptureSettings makePlanarSettings(const Probe& probe);

} // namespace crossray
