// Whole files in and out.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace crossray {

// Throws InputError when the file is missing, is no regular file, cannot be read, or is larger than 4 GiB.
std::string readWholeFile(const std::filesystem::path& file);

// Writes beside the target, then renames: the file is whole or absent, also when several processes write it. Throws
// EnvironmentError.
void writeWholeFile(const std::filesystem::path& file, std::string_view bytes);

} // namespace crossray
