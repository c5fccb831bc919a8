// What a hunt found, as text.
#pragma once

#include "harness/mutate/hunt.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace crossray {

struct HuntCounts {
    std::string name; // of a file, or of an operation; "" for all
    size_t planted = 0;
    size_t caught = 0, survived = 0, equivalent = 0, sameCode = 0, unreached = 0, noCompile = 0;
    // Caught among the caught and the survivors; nothing where there are none.
    std::optional<double> score() const;
};
HuntCounts countAll(const HuntResult& hunt);
std::vector<HuntCounts> countByFile(const HuntResult& hunt);
std::vector<HuntCounts> countByOperation(const HuntResult& hunt);
// "97.3 %" or "-". Rounded down, so that 100.0 % is all of them.
std::string formatScore(const HuntCounts& counts);

// How the mutants were chosen, for the record.
struct HuntChoice {
    std::string command, commit;
    size_t planted = 0; // all that there are; those of the result are a part of them
    uint64_t seed = 0;
    size_t askAtMost = 0; // HuntOptions
};

std::string formatHuntTable(const HuntResult& hunt);
// Each with its diff, and what the cases saw of it.
std::string formatSurvivors(const HuntResult& hunt);
std::string formatHuntMarkdown(const HuntResult& hunt, const HuntChoice& choice);
std::string formatHuntCsv(const HuntResult& hunt);
// Schema crossray-mutation/1 (docs/mutation.md).
std::string formatHuntJson(const HuntResult& hunt, const HuntChoice& choice);

} // namespace crossray
