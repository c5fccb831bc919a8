// Which functions a variant can call, read off the module before anything is optimised.
#pragma once

#include "harness/compile/spirv_function.h"

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace crossray {

// A parsed module with its names, for several questions.
class SpirvReach {
  public:
    explicit SpirvReach(const std::vector<uint32_t>& spirv);

    // Functions by their names in SPIR-V ("saturate(f1;") that the first entry point reaches with these specialization
    // constants: branches that whole numbers and bools decide are followed on their one side. Never too few.
    std::set<std::string> find(const std::map<std::string, double>& specialization) const;
    // The module with these functions alone: what they call beside each other keeps an empty body, which is only there
    // to be dropped with the branch that calls it. Of the names those of specialization constants stay, and the lines
    // if asked.
    std::vector<uint32_t> keepOnly(const std::set<std::string>& kept, bool withLines) const;

  private:
    bool isAmong(const std::set<std::string>& names, const SpirvFunction& function) const;

    using Values = std::map<uint32_t, int64_t>;
    Values evaluateConstants(const std::map<std::string, double>& specialization) const;
    // Ids of the functions that one calls.
    std::set<uint32_t> findCalls(const SpirvFunction& function, Values& values) const;

    SpirvModule module_;
    std::map<uint32_t, std::string> names_;
    std::map<uint32_t, size_t> functions_; // by id
    uint32_t entry_ = 0;
};

} // namespace crossray
