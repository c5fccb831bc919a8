#include "harness/report/page.h"

#include "harness/base/text.h"
#include "harness/report/web_files.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <stdexcept>

namespace crossray {

namespace {

std::string_view findWebFile(std::string_view name)
{
    for (const WebFile& file : webFiles()) {
        if (file.name == name) return file.content;
    }
    throw std::logic_error(fmt::format("harness/report/web has no {}", name));
}

std::string formatImportMap()
{
    nlohmann::ordered_json imports = nlohmann::ordered_json::object();
    for (const WebFile& file : webFiles()) {
        if (!file.name.ends_with(".js")) continue;
        imports[fmt::format("crossray/{}", file.name)] = "data:text/javascript;base64," + encodeBase64(file.content);
    }
    return nlohmann::ordered_json{{"imports", imports}}.dump();
}

// The template's places are comments, so that it is a page by itself. What is put in is not searched again.
std::string fillTemplate(std::string_view text, std::span<const std::pair<std::string_view, std::string>> places)
{
    std::string page;
    for (const auto& [place, content] : places) {
        const size_t at = text.find(place);
        if (at == std::string_view::npos) throw std::logic_error(fmt::format("index.html has no place {}", place));
        page += text.substr(0, at);
        page += content;
        text.remove_prefix(at + place.size());
    }
    page += text;
    return page;
}

} // namespace

std::string encodeBase64(std::string_view bytes)
{
    static constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (size_t i = 0; i < bytes.size(); i += 3) {
        const size_t count = std::min<size_t>(3, bytes.size() - i);
        uint32_t group = 0;
        for (size_t j = 0; j < 3; ++j)
            group = group << 8 | (j < count ? static_cast<unsigned char>(bytes[i + j]) : 0u);
        for (size_t j = 0; j < 4; ++j)
            text += j <= count ? kDigits[group >> (18 - 6 * j) & 63] : '=';
    }
    return text;
}

std::string escapeForScript(std::string_view json)
{
    std::string safe;
    safe.reserve(json.size());
    for (const char c : json) {
        // "<" stands in JSON's strings alone.
        if (c == '<')
            safe += "\\u003c";
        else
            safe += c;
    }
    return safe;
}

std::string formatDataScript(const PageData& data)
{
    return fmt::format("crossrayData({}, {});\n", nlohmann::json(data.name).dump(), escapeForScript(data.json));
}

std::string formatPage(std::string_view title, std::span<const PageData> inlined)
{
    std::string data;
    for (const PageData& item : inlined) {
        data += fmt::format("<script type=\"application/json\" id=\"data-{}\">{}</script>\n", escapeMarkup(item.name),
                            escapeForScript(item.json));
    }
    const std::pair<std::string_view, std::string> places[] = {
        {"<!--title-->", escapeMarkup(title)},
        {"/*style*/", std::string(findWebFile("style.css"))},
        {"<!--data-->", data},
        {"/*imports*/", formatImportMap()},
    };
    return fillTemplate(findWebFile("index.html"), places);
}

} // namespace crossray
