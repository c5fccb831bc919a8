// OpenEXR files as planes: multi-part, 32-bit float, one part a plane; part name = plane name, channels "Y" for 1,
// "X","Y" for 2, "R","G","B" for 3, "R","G","B","A" for 4. Readers trust nothing: the header's sizes are checked
// against these bounds before any image is allocated, and every complaint is an InputError that begins with the file's
// name.
#pragma once

#include "harness/base/plane.h"

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace crossray {

inline constexpr int kMaxExrSide = 16384;           // pixels
inline constexpr int kMaxExrChannels = 128;         // of all parts together
inline constexpr long long kMaxExrValues = 1 << 28; // pixels times channels, of all parts together

// Writes beside the target and renames, so that a file is whole or absent. Values are rounded to float. The attributes
// are strings of the first part. Throws InputError on planes that cannot be a file (no plane, equal names, a shape
// beyond the bounds, 5 channels) and EnvironmentError when the folder cannot be written.
void writeExr(const std::filesystem::path& file, std::span<const Plane> planes,
              const std::map<std::string, std::string>& attributes = {});
// Planes of a file that writeExr wrote, in its order. Throws InputError (file: what is wrong) on a missing, truncated
// or foreign file.
std::vector<Plane> readExr(const std::filesystem::path& file);
// Any flat scan-line EXR's channels by full name, each as a one-channel plane: the channel's own name
// ("ViewLayer.Depth.Z"), behind the part's name and a dot where the part has a name ("Color.R"). Half and uint become
// doubles. Throws InputError as readExr.
std::map<std::string, Plane> readExrChannels(const std::filesystem::path& file);

} // namespace crossray
