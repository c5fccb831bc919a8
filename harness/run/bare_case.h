// A case of a run.json as far as a list of cases needs it, in a small part of the time that all of it takes.
#pragma once

#include "harness/run/results.h"

#include <string_view>

namespace crossray {

// Of the case: name, position, expectedFile, conditioning's file; of its backends: name, verdict, reason, times.worker,
// planesFile, traceFile.
// All else is checked to be JSON, and left as a new CaseResult has it. Throws InputError with what is wrong and at
// which byte.
CaseResult parseBareCase(std::string_view text);

} // namespace crossray
