// The parameter blocks of the passes, filled from a case.
#pragma once

#include "harness/backend/device.h"
#include "harness/case/case.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace crossray {

struct PyramidLevel {
    int firstCell = 0, width = 0, height = 0;
};

// Level l+1 has half the cells of level l, rounded down but never below 1; the last cell of an odd side covers three.
std::vector<PyramidLevel> layOutPyramid(int width, int height);

// The pixel that a variant with kRecordPixel records, and the steps that its record has room for.
struct PixelQuery {
    int x = 0, y = 0, stepCapacity = 0;
};

// The block PassParams of crossray/shared/pass_params.glsl, laid out by std140 (float) or as its mirror in doubles.
std::vector<std::byte> makePassParams(const Case& testCase, const std::vector<PyramidLevel>& levels,
                                      Precision precision, const std::optional<PixelQuery>& query = {});

// The block PyramidParams for the reduction that writes level `target`.
std::vector<std::byte> makePyramidParams(const Case& testCase, const std::vector<PyramidLevel>& levels, size_t target,
                                         Precision precision);

// The block SurfaceParams for the pass that builds levels `first` to `last`.
std::vector<std::byte> makeSurfaceParams(const Case& testCase, const std::vector<PyramidLevel>& levels, size_t first,
                                         size_t last, Precision precision);

} // namespace crossray
