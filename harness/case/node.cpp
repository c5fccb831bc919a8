#include "harness/case/node.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>
#include <system_error>

namespace crossray {

namespace {

constexpr uintmax_t kLargestFile = 1 << 20; // bytes; a case is a page of text

using FileName = std::shared_ptr<const std::string>;

Place placeOf(const toml::source_region& region, const FileName& file)
{
    return {file, static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}

Node convert(const toml::node& node, const FileName& file);

Node convertTable(const toml::table& table, const FileName& file)
{
    Node result;
    result.kind = NodeKind::kTable;
    for (auto&& [key, value] : table) {
        result.entries.push_back({std::string(key.str()), placeOf(key.source(), file), convert(value, file)});
    }
    // toml++ sorts by key; the file's own order is the order of sub-cases and of messages.
    std::stable_sort(result.entries.begin(), result.entries.end(), [](const NodeEntry& a, const NodeEntry& b) {
        return std::pair(a.keyPlace.line, a.keyPlace.column) < std::pair(b.keyPlace.line, b.keyPlace.column);
    });
    return result;
}

Node convertNumber(double value, const Place& place)
{
    if (!std::isfinite(value)) {
        throw InputError(place.position(),
                         fmt::format("{} is not allowed; a finite number is", std::isnan(value) ? "nan" : "inf"));
    }
    Node result;
    result.kind = NodeKind::kNumber;
    result.number = value;
    return result;
}

Node convertDate(const toml::date& date)
{
    Node result;
    result.kind = NodeKind::kDate;
    result.text = fmt::format("{:04}-{:02}-{:02}", date.year, date.month, date.day);
    return result;
}

Node convert(const toml::node& node, const FileName& file)
{
    const Place place = placeOf(node.source(), file);
    Node result;
    if (const auto* table = node.as_table()) {
        result = convertTable(*table, file);
    } else if (const auto* list = node.as_array()) {
        result.kind = NodeKind::kList;
        result.items.reserve(list->size());
        for (const toml::node& item : *list)
            result.items.push_back(convert(item, file));
    } else if (const auto* text = node.as_string()) {
        result.kind = NodeKind::kString;
        result.text = text->get();
    } else if (const auto* integer = node.as_integer()) {
        result.kind = NodeKind::kInteger;
        result.integer = integer->get();
        result.number = static_cast<double>(integer->get());
    } else if (const auto* number = node.as_floating_point()) {
        result = convertNumber(number->get(), place);
    } else if (const auto* boolean = node.as_boolean()) {
        result.kind = NodeKind::kBoolean;
        result.boolean = boolean->get();
    } else if (const auto* date = node.as_date()) {
        result = convertDate(date->get());
    } else {
        throw InputError(place.position(), "a time of day is not allowed; a date alone is, as YYYY-MM-DD");
    }
    result.place = place;
    return result;
}

// toml++ ends its sentences without a stop and may put line breaks into them.
std::string oneLine(std::string_view text)
{
    std::string result(text);
    std::replace(result.begin(), result.end(), '\n', ' ');
    return result;
}

bool isListOfTables(const Node& node)
{
    return node.kind == NodeKind::kList && !node.items.empty() &&
           std::all_of(node.items.begin(), node.items.end(), [](const Node& i) { return i.kind == NodeKind::kTable; });
}

} // namespace

const NodeEntry* Node::findEntry(std::string_view key) const
{
    const auto found = std::find_if(entries.begin(), entries.end(), [&](const NodeEntry& e) { return e.key == key; });
    return found == entries.end() ? nullptr : &*found;
}

NodeEntry* Node::findEntry(std::string_view key)
{
    const auto found = std::find_if(entries.begin(), entries.end(), [&](const NodeEntry& e) { return e.key == key; });
    return found == entries.end() ? nullptr : &*found;
}

const Node* Node::find(std::string_view key) const
{
    const NodeEntry* entry = findEntry(key);
    return entry ? &entry->value : nullptr;
}

void Node::erase(std::string_view key)
{
    std::erase_if(entries, [&](const NodeEntry& entry) { return entry.key == key; });
}

Node parseToml(std::string_view text, const std::string& fileName)
{
    const FileName file = std::make_shared<const std::string>(fileName);
    try {
        const toml::table table = toml::parse(text, std::string_view(fileName));
        Node root = convertTable(table, file);
        root.place = {file, 1, 1}; // where the top level begins: what it lacks is told of there
        return root;
    } catch (const toml::parse_error& error) {
        throw InputError(placeOf(error.source(), file).position(), "not valid TOML: " + oneLine(error.description()));
    }
}

Node readTomlFile(const std::filesystem::path& file)
{
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) {
        throw InputError({file.string()}, std::filesystem::exists(file, error) ? "is not a file; a case is a TOML file"
                                                                               : "the file does not exist");
    }
    const uintmax_t size = std::filesystem::file_size(file, error);
    if (!error && size > kLargestFile) {
        throw InputError({file.string()}, fmt::format("has {} bytes; at most {} are allowed", size, kLargestFile));
    }
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw InputError({file.string()}, "the file cannot be read");
    std::string text(static_cast<size_t>(error ? 0 : size), '\0');
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<size_t>(stream.gcount()));
    return parseToml(text, file.string());
}

std::string_view describeKind(NodeKind kind)
{
    switch (kind) {
    case NodeKind::kString:
        return "a string";
    case NodeKind::kInteger:
        return "an integer";
    case NodeKind::kNumber:
        return "a number";
    case NodeKind::kBoolean:
        return "a boolean";
    case NodeKind::kDate:
        return "a date";
    case NodeKind::kList:
        return "a list";
    case NodeKind::kTable:
        return "a table";
    }
    return "nothing";
}

std::string formatValue(const Node& node)
{
    switch (node.kind) {
    case NodeKind::kString:
    case NodeKind::kDate:
        return node.text;
    case NodeKind::kInteger:
        return fmt::format("{}", node.integer);
    case NodeKind::kNumber:
        return fmt::format("{}", node.number);
    case NodeKind::kBoolean:
        return node.boolean ? "true" : "false";
    case NodeKind::kList:
    case NodeKind::kTable:
        break;
    }
    std::string text;
    for (const Node& item : node.items) {
        if (!text.empty()) text += 'x';
        text += formatValue(item);
    }
    for (const NodeEntry& entry : node.entries) {
        if (!text.empty()) text += ';';
        text += entry.key + ":" + formatValue(entry.value);
    }
    return text;
}

void mergeUnder(Node& top, const Node& base)
{
    for (const NodeEntry& entry : base.entries) {
        NodeEntry* own = top.findEntry(entry.key);
        if (!own) {
            top.entries.push_back(entry);
        } else if (own->value.kind == NodeKind::kTable && entry.value.kind == NodeKind::kTable) {
            mergeUnder(own->value, entry.value);
        } else if (isListOfTables(own->value) && isListOfTables(entry.value)) {
            own->value.items.insert(own->value.items.end(), entry.value.items.begin(), entry.value.items.end());
        }
    }
}

void setByPath(Node& root, std::string_view dottedPath, const Place& keyPlace, const Node& value)
{
    Node* node = &root;
    std::string_view rest = dottedPath;
    while (true) {
        const size_t dot = rest.find('.');
        const std::string_view part = rest.substr(0, dot);
        if (node->kind == NodeKind::kList) {
            size_t index = 0;
            const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), index);
            if (error != std::errc{} || end != part.data() + part.size() || index >= node->items.size()) {
                throw InputError(keyPlace.position(),
                                 fmt::format("\"{}\" of \"{}\" is no index into a list of {} (counted from 0)", part,
                                             dottedPath, node->items.size()));
            }
            node = &node->items[index];
        } else if (node->kind == NodeKind::kTable && !part.empty()) {
            NodeEntry* entry = node->findEntry(part);
            if (!entry) {
                node->entries.push_back({std::string(part), keyPlace, Node{}});
                entry = &node->entries.back();
                entry->value.place = keyPlace;
            }
            if (dot == std::string_view::npos) entry->keyPlace = keyPlace;
            node = &entry->value;
        } else {
            throw InputError(
                keyPlace.position(),
                part.empty()
                    ? fmt::format("\"{}\" names no key; a dotted path such as material.ior is allowed", dottedPath)
                    : fmt::format("\"{}\" leads through {}; only tables and lists have keys", dottedPath,
                                  describeKind(node->kind)));
        }
        if (dot == std::string_view::npos) break;
        rest.remove_prefix(dot + 1);
    }
    *node = value;
}

} // namespace crossray
