// [expand] of a case file: lists of values for keys, multiplied out into sub-cases.
#pragma once

#include "harness/case/node.h"

#include <string>
#include <vector>

namespace crossray {

// One key of [expand] with its values.
struct Parameter {
    std::string path;
    Place keyPlace;
    std::vector<Node> values;
};

// Takes [expand] out of a case's tree. Throws InputError.
std::vector<Parameter> takeParameters(Node& root);

// One combination: the place of each parameter's value among its values.
using Combination = std::vector<size_t>;
// The next one, the first parameter slowest; false when there is none, and all are 0 again.
bool advance(const std::vector<Parameter>& parameters, Combination& combination);
// "[ior=1.2,size=5x7]", which a sub-case's name ends with; empty without parameters.
std::string formatLabel(const std::vector<Parameter>& parameters, const Combination& combination);

} // namespace crossray
