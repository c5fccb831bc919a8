// A folder for `ctest --test-dir`: one test a case, its tags as labels.
#pragma once

#include "harness/cli/verbs.h"

#include <string>

namespace crossray {

// Writes DIR/CTestTestfile.cmake. Each test starts workers of its own, which is the price of being separate.
int writeCtestFolder(const GlobalOptions& global, const SelectionOptions& selection, const std::string& folder);

} // namespace crossray
