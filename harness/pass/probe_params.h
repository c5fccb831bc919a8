// What the pass knows of a case's probes and sky: one parameter block, and one image with all their cubemaps.
#pragma once

#include "harness/backend/device.h"
#include "harness/expect/expect.h"

#include <cstddef>
#include <vector>

namespace crossray {

// Texels a side of an image that holds all captures: what every device has.
inline constexpr int kLargestAtlas = 16384;

// True where the case's passes read probes or the sky.
bool usesProbes(const Case& testCase);

// The places of the case's probes in the order in which its profile asks them. HDRP: by the sort key of
// crossray/probe/hdrp_order.glsl in doubles, equal keys by their places; that code is the shader library's own, and one
// order serves all devices. Those of the other profiles stay where they are: their order is found by the shader.
std::vector<size_t> orderProbes(const Case& testCase);

// The block ProbeParams of crossray/shared/probe_params.glsl, laid out by std140 (float) or as its mirror in doubles.
std::vector<std::byte> makeProbeParams(const CaseData& data, Precision precision);

// The cubemaps that the block points to. Each level lies below the one before, its faces beside one another.
ImageDesc makeProbeAtlas(const CaseData& data);

} // namespace crossray
