// What an earlier hunt found of the same mutants: only what it did not catch need be asked again.
#pragma once

#include "harness/mutate/hunt.h"

#include <filesystem>
#include <map>
#include <tuple>
#include <vector>

namespace crossray {

class EarlierHunt {
  public:
    EarlierHunt() = default; // knows nothing
    // Reads mutation.json, schema crossray-mutation/1. Throws InputError on what is none.
    explicit EarlierHunt(const std::filesystem::path& file);

    // How the mutant was caught; nullptr for one that was not, or is unknown. Mutants are told by file, function and
    // the lines that they touch, so they are found where lines have moved. Of those that are alike all must have been
    // caught.
    const MutantResult* findCaught(const Mutation& mutation) const;

  private:
    using Key = std::tuple<std::string, std::string, std::string, std::string>;
    static Key keyOf(const Mutation& mutation);

    std::map<Key, std::vector<MutantResult>> results_;
};

} // namespace crossray
