// The command line: verbs, options, exit codes. docs/cli.md describes it; a test holds the two against each other.
#pragma once

#include "harness/cli/manual.h"

#include <string>
#include <vector>

namespace crossray {

// Runs one command line and returns its exit code. Prints errors to standard error, one line each.
int runCommandLine(int argc, const char* const* argv);

// All that the command line takes; hidden verbs are left out.
CommandDescription describeCommandLine();

// Every verb and option, as "run --backend", for the test of the document.
std::vector<std::string> listOptions();

} // namespace crossray
