// A bench's method by its name.
#pragma once

#include "harness/bench/bench_case.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

namespace crossray {

inline const BenchMethod& findMethod(const std::vector<BenchMethod>& methods, const std::string& name)
{
    const auto found =
        std::find_if(methods.begin(), methods.end(), [&](const BenchMethod& method) { return method.name == name; });
    if (found == methods.end()) throw std::runtime_error("no method " + name);
    return *found;
}

} // namespace crossray
