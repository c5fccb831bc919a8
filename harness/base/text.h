// Text in and out of files and markup.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace crossray {

// A file's bytes; nothing when it cannot be read.
std::optional<std::string> readText(const std::filesystem::path& file);

// For text and for attributes in double quotes, in HTML, XML and SVG.
std::string escapeMarkup(std::string_view text);

} // namespace crossray
