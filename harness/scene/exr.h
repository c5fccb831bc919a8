// OpenEXR files as planes: multi-part, 32-bit float, one part a plane; part name = plane name, channels "R","G","B" for 3,
// "Y" for 1, "X","Y" for 2, "R","G","B","A" for 4.
#pragma once

#include "harness/base/plane.h"

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace crossray {

// Writes beside the target and renames, so that a file is whole or absent. Values are rounded to float.
void writeExr(const std::filesystem::path& file, std::span<const Plane> planes,
              const std::map<std::string, std::string>& attributes = {});
// Planes of a file that writeExr wrote. Throws InputError (file: what is wrong) on a missing, truncated or foreign file.
std::vector<Plane> readExr(const std::filesystem::path& file);
// Any EXR's channels by full name ("ViewLayer.Depth.Z"), each as a one-channel plane; half and uint become doubles. Bounded to
// 16384 pixels a side and 64 channels; throws InputError beyond.
std::map<std::string, Plane> readExrChannels(const std::filesystem::path& file);

} // namespace crossray
