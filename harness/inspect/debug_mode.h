// The debug modes by name: which plane each shows, of which march, and how it is drawn.
#pragma once

#include "harness/case/case.h"
#include "harness/inspect/encodings.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace crossray {

struct DebugMode {
    std::string_view name;
    std::string_view output; // the raw plane; empty: None, the scene as it is
    Encoding encoding = Encoding::kColor;
    enum class March { kAny, kPyramid, kLinear } march = March::kAny; // that records it
};

// In the order of the documents.
std::span<const DebugMode> debugModes();

// Throws InputError with the names that are allowed.
const DebugMode& findDebugMode(const std::string& name);

// Throws InputError where the case's projection does not record what the mode shows.
void requireRecorded(const DebugMode& mode, const Case& testCase);

// What a count is divided by: the case's iterations, or its coarsest level.
int maximumOf(const DebugMode& mode, const Case& testCase);

// The plane in the mode's encoding, pixel after pixel.
std::vector<EncodedColor> encodePlane(const DebugMode& mode, const Plane& plane, const Case& testCase);

} // namespace crossray
