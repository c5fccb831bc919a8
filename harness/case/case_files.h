// Files that a case refers to.
#pragma once

#include "harness/case/case.h"

#include <filesystem>
#include <vector>

namespace crossray {

// Of listFiles(testCase) those that it names itself: sub-cases of one file share the file and the presets.
std::vector<std::filesystem::path> listNamedFiles(const Case& testCase);

} // namespace crossray
