#include "harness/inspector/routes.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace crossray {

namespace {

std::string onOneLine(std::string_view text)
{
    std::string line(text.substr(0, text.find_last_not_of('\n') + 1));
    std::replace(line.begin(), line.end(), '\n', ' ');
    return line;
}

} // namespace

Reply makeErrorReply(int status, std::string_view text)
{
    using Json = nlohmann::ordered_json;
    return {status, Json{{"error", onOneLine(text)}}.dump(-1, ' ', false, Json::error_handler_t::replace)};
}

} // namespace crossray
