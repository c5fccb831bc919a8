// A first look at an OpenEXR file's header, before the library sees it: what the file claims to hold, held against our
// bounds. Layout: "OpenEXR File Layout", the OpenEXR project's technical documents.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace crossray {

// Throws InputError when `bytes` do not begin with the headers of flat scan-line images whose sides, channel count and
// total size are within the bounds of exr.h and could be held by a file of this length.
void checkExrHeader(const std::filesystem::path& file, std::string_view bytes);

} // namespace crossray
