// What `crossray show` says of absorption and of the previous frame.
#pragma once

#include "harness/case/case.h"

#include <string_view>

namespace crossray {

// Nothing where the surface lets through all light at the thickness that the effect's line has named.
void printAbsorption(const Material& material);
void printHistory(const History& history, std::string_view camera); // the previous camera, in words

} // namespace crossray
