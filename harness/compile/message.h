// Compiler messages in the form that editors read: "path:line:column: error: text".
#pragma once

#include "harness/compile/source.h"

#include <string>

namespace crossray {

// Rewrites glslang's log, which speaks of "ERROR: name:line: 'token' : text". The column is where the token first
// stands in that line; it is left out where it does not. Lines that only count errors are dropped.
std::string rewriteMessages(const std::string& log, const SourceSet& sources, const SourceFile& entry);

// What an include reports that was not even tried because another one had failed; rewriteMessages drops it.
inline constexpr const char* kAfterFailure = "not read after the first failure";

// Column (from 1) where `token` first stands in `line` as a whole word, or 0.
int findColumn(std::string_view line, std::string_view token);

} // namespace crossray
