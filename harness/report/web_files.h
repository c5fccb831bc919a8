// The sources of the report's pages (harness/report/web), which the build puts into the program.
#pragma once

#include <span>
#include <string_view>

namespace crossray {

struct WebFile {
    std::string_view name; // "main.js"
    std::string_view content;
};

// In order of name.
std::span<const WebFile> webFiles();

} // namespace crossray
