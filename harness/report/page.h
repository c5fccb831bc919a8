// The one HTML file of a report: style, modules and data put into the template harness/report/web/index.html.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace crossray {

// A piece of the report's data by the name under which the page asks for it.
struct PageData {
    std::string name;
    std::string json;
};

// JSON that may stand in a script element and in a script: no "<" is left, so that a name like </script> ends nothing.
std::string escapeForScript(std::string_view json);
// What stands in DATA.js of the folder form.
std::string formatDataScript(const PageData& data);
// `inlined` is part of the file. Modules find each other by an import map of data: URLs, because a page that was opened
// from disk may not load its siblings as modules.
std::string formatPage(std::string_view title, std::span<const PageData> inlined);

std::string encodeBase64(std::string_view bytes);

} // namespace crossray
