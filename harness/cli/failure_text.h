// What a person reads of a failure: the worst thing first, and the next command to type.
#pragma once

#include "harness/cli/terminal.h"
#include "harness/run/results.h"

#include <filesystem>
#include <string>

namespace crossray {

// Several lines, the last with a line break. `all`: every failed expectation, else the worst three. The command at the
// end names the case, and one outside `caseFolder` by its file.
std::string formatFailure(const CaseResult& testCase, const BackendResult& result, const Style& style, bool all,
                          const std::filesystem::path& caseFolder = {});

// One word for one shell argument.
std::string quoteForShell(const std::string& text);

// "31" and the like: a number as people read it, and a vector in brackets.
std::string formatValues(const std::vector<double>& values, int digits);
// The same of an output: a hit class or reason by its name too, "miss (2)".
std::string formatValues(std::string_view output, const std::vector<double>& values, int digits);

} // namespace crossray
