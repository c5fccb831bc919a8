#include "harness/case/key_path.h"

#include <algorithm>
#include <charconv>

namespace crossray {

std::vector<std::string> splitPath(std::string_view path, char separator)
{
    std::vector<std::string> parts;
    for (size_t begin = 0;;) {
        const size_t end = path.find(separator, begin);
        parts.emplace_back(path.substr(begin, end == std::string_view::npos ? end : end - begin));
        if (end == std::string_view::npos) return parts;
        begin = end + 1;
    }
}

bool isIndex(std::string_view part)
{
    return !part.empty() && std::all_of(part.begin(), part.end(), [](char c) { return c >= '0' && c <= '9'; });
}

std::string schemaPath(const std::vector<std::string>& parts)
{
    std::string path;
    for (const std::string& part : parts) {
        if (isIndex(part)) continue;
        if (part == "rotation" && &part != &parts.back() && !isIndex(parts.back()))
            path = part;
        else if (part == "environment")
            path = part;
        else if (part == "gradient")
            path = "scene.sky";
        else
            path += (path.empty() ? "" : ".") + (part == "primitive" && path == "scene" ? "primitives" : part);
    }
    return path;
}

bool isNumberList(const KeySpec& spec)
{
    return spec.type == KeyType::kSize || spec.type == KeyType::kVec3 || spec.type == KeyType::kExtents ||
           spec.type == KeyType::kRotation;
}

PathTarget findPathTarget(std::string_view path)
{
    const std::vector<std::string> parts = splitPath(path);
    const std::string wanted = schemaPath(parts);
    for (const KeySpec& spec : keySpecs()) {
        if (spec.path() != wanted) continue;
        const bool isComponent = isIndex(parts.back());
        if (isComponent && !isNumberList(spec)) return {};
        return {&spec, isComponent};
    }
    return {};
}

const Node* findByPath(const Node& root, std::string_view path)
{
    const Node* node = &root;
    for (const std::string& part : splitPath(path)) {
        if (node->kind == NodeKind::kList) {
            size_t index = 0;
            const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), index);
            const bool isPlace = error == std::errc{} && end == part.data() + part.size();
            if (!isPlace || index >= node->items.size()) return nullptr;
            node = &node->items[index];
        } else {
            node = node->find(part);
            if (node == nullptr) return nullptr;
        }
    }
    return node;
}

} // namespace crossray
