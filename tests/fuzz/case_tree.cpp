#include "tests/fuzz/case_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

namespace crossray {

namespace {

std::string formatInline(const Node& node)
{
    switch (node.kind) {
    case NodeKind::kString:
    case NodeKind::kDate:
        return fmt::format("\"{}\"", node.text);
    case NodeKind::kInteger:
        return fmt::format("{}", node.integer);
    case NodeKind::kNumber:
        return fmt::format("{}", node.number);
    case NodeKind::kBoolean:
        return node.boolean ? "true" : "false";
    case NodeKind::kList: {
        std::string text;
        for (const Node& item : node.items)
            text += (text.empty() ? "" : ", ") + formatInline(item);
        return "[" + text + "]";
    }
    case NodeKind::kTable:
        break;
    }
    std::string text;
    for (const NodeEntry& entry : node.entries)
        text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", entry.key, formatInline(entry.value));
    return "{ " + text + " }";
}

bool isTableList(const Node& node)
{
    return node.kind == NodeKind::kList && !node.items.empty() && node.items.front().kind == NodeKind::kTable;
}

// A list of tables has a line for each.
std::string formatValueOf(const Node& node)
{
    if (!isTableList(node)) return formatInline(node);
    std::string text = "[\n";
    for (const Node& item : node.items)
        text += "    " + formatInline(item) + ",\n";
    return text + "]";
}

void formatTable(const Node& table, const std::string& path, std::string& text)
{
    for (const NodeEntry& entry : table.entries) {
        if (entry.value.kind != NodeKind::kTable)
            text += fmt::format("{} = {}\n", entry.key, formatValueOf(entry.value));
    }
    for (const NodeEntry& entry : table.entries) {
        if (entry.value.kind != NodeKind::kTable) continue;
        const std::string inner = path.empty() ? entry.key : path + "." + entry.key;
        text += fmt::format("\n[{}]\n", inner);
        formatTable(entry.value, inner, text);
    }
}

} // namespace

Node makeString(std::string_view text)
{
    Node node;
    node.kind = NodeKind::kString;
    node.text = text;
    return node;
}

Node makeInteger(int64_t value)
{
    Node node;
    node.kind = NodeKind::kInteger;
    node.integer = value;
    node.number = static_cast<double>(value);
    return node;
}

Node makeNumber(double value)
{
    Node node;
    node.kind = NodeKind::kNumber;
    node.number = value;
    return node;
}

Node makeList(std::vector<Node> items)
{
    Node node;
    node.kind = NodeKind::kList;
    node.items = std::move(items);
    return node;
}

void setKey(Node& table, std::string_view key, Node value)
{
    if (NodeEntry* entry = table.findEntry(key)) {
        entry->value = std::move(value);
        return;
    }
    table.entries.push_back({std::string(key), {}, std::move(value)});
}

std::string subTableName(std::string_view table, std::string_view key)
{
    if (key == "environment") return "environment";
    if (key == "gradient") return "scene.sky";
    if (table == "scene" && key == "primitive") return "scene.primitives";
    return table.empty() ? std::string(key) : fmt::format("{}.{}", table, key);
}

std::string formatCase(const Node& root)
{
    std::string text;
    formatTable(root, "", text);
    return text;
}

Case readTree(const Node& root, const std::filesystem::path& file)
{
    {
        std::ofstream out(file);
        out << formatCase(root);
    }
    return readCaseFile(file).at(0);
}

} // namespace crossray
