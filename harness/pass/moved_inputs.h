// The inputs of a job moved by one unit in the last place of a float, as they reach the shader: how much an answer
// follows them says whether a pixel can be decided at all.
//
// Moved are: depth and normals of the G-buffer; the camera (matrices, slopes, depth terms); settings (material,
// thickness map, proxy, bias, stride, fade, caution); probes (volumes, places, blends); the previous frame (view,
// motion). Left alone are whole numbers, flags and sizes, which have no last place; exact zeros; a cleared depth, which
// says that nothing is there; and colours, which an answer follows one to one.
#pragma once

#include "harness/backend/device.h"
#include "harness/case/case.h"

#include <cstdint>
#include <string_view>
#include <vector>

namespace crossray {

enum class InputGroup : int {
    kNone = 0,
    kDepth = 1,
    kNormal = 2,
    kCamera = 3,
    kSettings = 4,
    kProbes = 5,
    kHistory = 6,
    kAll = 7, // of a move: every group at once
};
inline constexpr int kInputGroups = 8;
std::string_view nameOf(InputGroup group); // "depth", "normal", ..., "all inputs at once"

// Each number of the group goes one unit up or down: all up for pattern 0, by a hash of its place for the others;
// `isOpposite` turns all of them round.
struct InputMove {
    InputGroup group = InputGroup::kAll;
    uint32_t pattern = 0;
    bool isOpposite = false;
};

// The moves that are worth making on the case: those of groups that its job has.
std::vector<InputMove> listInputMoves(const Case& testCase);

// The job with those inputs moved. Doubles move by the last place of a float, too: that is what a float device loses of
// them. `precision` is the job's own.
Job moveInputs(const Case& testCase, const Job& job, Precision precision, const InputMove& move);

// Distance from a number to the next float above its magnitude; 0 for 0 and what is not finite.
double floatSpacing(double value);

} // namespace crossray
