// What the pass knows of a case's planar probes: one parameter block, and one image with all their captures.
#pragma once

#include "harness/backend/device.h"
#include "harness/expect/expect.h"

#include <cstddef>
#include <vector>

namespace crossray {

// True where the case's passes ask planar probes.
bool usesPlanarProbes(const Case& testCase);

// The block PlanarParams of crossray/shared/planar_params.glsl, laid out by std140 (float) or as its mirror in doubles.
std::vector<std::byte> makePlanarParams(const CaseData& data, Precision precision);

// The captures that the block points to, one below the other.
ImageDesc makePlanarAtlas(const CaseData& data);

} // namespace crossray
