// A traced pixel as JSON; docs/trace-json.md documents each field.
#pragma once

#include "harness/inspect/pixel_trace.h"

#include <string>
#include <vector>

namespace crossray {

std::string formatTraceJson(const PixelTrace& trace);
// Every field, as the document names it: "backends[].steps[].level".
std::vector<std::string> listTraceJsonFields();

} // namespace crossray
