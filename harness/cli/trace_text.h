// A traced pixel as a person reads it.
#pragma once

#include "harness/cli/terminal.h"
#include "harness/inspect/pixel_trace.h"

#include <string>

namespace crossray {

// The queried ray, then its steps; with two backends side by side, with a mark (>) where they part and a sentence that
// says it.
std::string formatTrace(const PixelTrace& trace, const Style& style);

} // namespace crossray
