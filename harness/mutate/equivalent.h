// Mutants that no case can catch, each with its reason: a committed list (tests/mutation/equivalent.toml).
#pragma once

#include "harness/base/error.h"
#include "harness/mutate/mutation.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace crossray {

// Keyed by file, function and the lines before and after, so that it stays when lines move and ends when they change.
struct EquivalentMutant {
    std::string file, function, before, after, reason;
    SourcePosition position;
    bool matches(const Mutation& mutation) const;
};

// [[equivalent]] with file, function, reason, and edits: lists of two lines, before and after. Throws InputError.
std::vector<EquivalentMutant> readEquivalents(const std::filesystem::path& file);

// Throws InputError with the place of the first entry that matches none of the mutations; entries of files that
// have no mutation among them are passed over.
void checkEquivalents(std::span<const EquivalentMutant> equivalents, std::span<const Mutation> mutations);

} // namespace crossray
