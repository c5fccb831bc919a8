// The parameter blocks of the passes, filled from a case.
#pragma once

#include "harness/backend/device.h"
#include "harness/case/case.h"

#include <cstddef>
#include <vector>

namespace crossray {

struct PyramidLevel {
    int firstCell = 0, width = 0, height = 0;
};

// Level l+1 has half the cells of level l, rounded down but never below 1; the last cell of an odd side covers three.
std::vector<PyramidLevel> layOutPyramid(int width, int height);

// The block PassParams of crossray/shared/pass_params.glsl, laid out by std140 (float) or as its mirror in doubles.
std::vector<std::byte> makePassParams(const Case& testCase, const std::vector<PyramidLevel>& levels,
                                      Precision precision);

// The block PyramidParams for the reduction that writes level `target`.
std::vector<std::byte> makePyramidParams(const Case& testCase, const std::vector<PyramidLevel>& levels, size_t target,
                                         Precision precision);

} // namespace crossray
