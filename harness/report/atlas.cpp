#include "harness/report/atlas.h"

#include "harness/report/plane_data.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <stdexcept>

namespace crossray {

namespace {

// Empty for a text.
std::string_view pictureTypeOf(std::string_view name)
{
    if (name.ends_with(".svg")) return "image/svg+xml";
    if (name.ends_with(".png")) return "image/png";
    if (name.ends_with(".md")) return "";
    throw std::logic_error(fmt::format("the atlas shows no such file: {}", name));
}

} // namespace

std::set<std::string> findAtlasCases(std::span<const AtlasFile> files)
{
    constexpr std::string_view kOpen = "](../cases/", kClose = ".toml)";
    std::set<std::string> names;
    const std::string_view text = files.empty() ? "" : files.front().content;
    for (size_t at = text.find(kOpen); at != std::string_view::npos; at = text.find(kOpen, at)) {
        at += kOpen.size();
        names.emplace(text.substr(at, text.find(kClose, at) - at));
    }
    return names;
}

PageData makeAtlasTexts(std::span<const AtlasFile> files)
{
    nlohmann::ordered_json texts = nlohmann::ordered_json::array();
    for (const AtlasFile& file : files) {
        if (pictureTypeOf(file.name).empty()) texts.push_back({{"name", file.name}, {"text", file.content}});
    }
    return {"atlas", texts.dump()};
}

PageData makeAtlasPictures(std::span<const AtlasFile> files)
{
    nlohmann::ordered_json pictures = nlohmann::ordered_json::object();
    for (const AtlasFile& file : files) {
        const std::string_view type = pictureTypeOf(file.name);
        if (type.empty()) continue;
        pictures[std::string(file.name)] = {{"type", type}, {"data", encodeBase64(deflateBytes(file.content))}};
    }
    return {"atlas-pictures", pictures.dump()};
}

} // namespace crossray
