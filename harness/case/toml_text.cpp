// A tree of values as TOML, and two trees against each other.
#include "harness/case/case_tree.h"

#include <fmt/format.h>

#include <algorithm>

namespace crossray {

namespace {

std::string quote(std::string_view text)
{
    std::string quoted = "\"";
    for (const char c : text) {
        const auto code = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\')
            quoted += fmt::format("\\{}", c);
        else if (code < 0x20 || code == 0x7f)
            quoted += fmt::format("\\u{:04x}", code);
        else
            quoted += c;
    }
    return quoted + "\"";
}

std::string formatKey(std::string_view key)
{
    const bool isBare = !key.empty() && std::all_of(key.begin(), key.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
    });
    return isBare ? std::string(key) : quote(key);
}

// A float stays one: 1.0 is not 1.
std::string formatFloat(double value)
{
    std::string text = fmt::format("{}", value);
    if (text.find_first_of(".en") == std::string::npos) text += ".0";
    return text;
}

std::string formatInline(const Node& node)
{
    switch (node.kind) {
    case NodeKind::kString:
        return quote(node.text);
    case NodeKind::kDate:
        return node.text;
    case NodeKind::kInteger:
        return fmt::format("{}", node.integer);
    case NodeKind::kNumber:
        return formatFloat(node.number);
    case NodeKind::kBoolean:
        return node.boolean ? "true" : "false";
    case NodeKind::kList:
    case NodeKind::kTable:
        break;
    }
    const bool isList = node.kind == NodeKind::kList;
    std::string text;
    for (const Node& item : node.items)
        text += (text.empty() ? "" : ", ") + formatInline(item);
    for (const NodeEntry& entry : node.entries)
        text += (text.empty() ? "" : ", ") + formatKey(entry.key) + " = " + formatInline(entry.value);
    if (isList) return "[" + text + "]";
    return text.empty() ? "{}" : "{ " + text + " }";
}

bool isListOfTables(const Node& node)
{
    return node.kind == NodeKind::kList && !node.items.empty() &&
           std::all_of(node.items.begin(), node.items.end(), [](const Node& i) { return i.kind == NodeKind::kTable; });
}

std::string formatValueOf(const Node& node)
{
    if (!isListOfTables(node)) return formatInline(node);
    std::string text = "[\n"; // one table a line
    for (const Node& item : node.items)
        text += "    " + formatInline(item) + ",\n";
    return text + "]";
}

// The keys of a table that are no tables themselves, then those that are.
std::string formatTable(const Node& table, const std::string& path)
{
    std::string text;
    for (const NodeEntry& entry : table.entries) {
        if (entry.value.kind == NodeKind::kTable || (path.empty() && isListOfTables(entry.value))) continue;
        text += formatKey(entry.key) + " = " + formatValueOf(entry.value) + "\n";
    }
    for (const NodeEntry& entry : table.entries) {
        const std::string inner = path + (path.empty() ? "" : ".") + formatKey(entry.key);
        if (entry.value.kind == NodeKind::kTable) {
            text += fmt::format("\n[{}]\n{}", inner, formatTable(entry.value, inner));
        } else if (path.empty() && isListOfTables(entry.value)) {
            for (const Node& item : entry.value.items)
                text += fmt::format("\n[[{}]]\n{}", inner, formatTable(item, inner));
        }
    }
    return text;
}

} // namespace

std::string formatToml(const Node& root)
{
    return formatTable(root, "");
}

bool saysTheSame(const Node& a, const Node& b)
{
    if (a.kind != b.kind) return false;
    switch (a.kind) {
    case NodeKind::kString:
    case NodeKind::kDate:
        return a.text == b.text;
    case NodeKind::kInteger:
        return a.integer == b.integer;
    case NodeKind::kNumber:
        return a.number == b.number;
    case NodeKind::kBoolean:
        return a.boolean == b.boolean;
    case NodeKind::kList:
        return std::equal(a.items.begin(), a.items.end(), b.items.begin(), b.items.end(), saysTheSame);
    case NodeKind::kTable:
        break;
    }
    return a.entries.size() == b.entries.size() &&
           std::all_of(a.entries.begin(), a.entries.end(), [&](const NodeEntry& entry) {
               const Node* const other = b.find(entry.key);
               return other != nullptr && saysTheSame(entry.value, *other);
           });
}

} // namespace crossray
