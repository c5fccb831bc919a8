// TOML as a tree of values that can be copied without losing where each one stands: toml++ drops positions on a copy,
// and presets, parameter lists and overrides are all copies.
#pragma once

#include "harness/base/error.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace crossray {

struct Place {
    std::shared_ptr<const std::string> file;
    int line = 0;
    int column = 0;

    SourcePosition position() const { return {file ? *file : std::string{}, line, column}; }
};

enum class NodeKind { kString, kInteger, kNumber, kBoolean, kDate, kList, kTable };

struct NodeEntry;

struct Node {
    NodeKind kind = NodeKind::kTable;
    Place place;
    std::string text; // string; date as YYYY-MM-DD
    int64_t integer = 0;
    double number = 0; // also of an integer
    bool boolean = false;
    std::vector<Node> items;        // list
    std::vector<NodeEntry> entries; // table, in the order of the file

    bool isNumber() const { return kind == NodeKind::kInteger || kind == NodeKind::kNumber; }
    const NodeEntry* findEntry(std::string_view key) const;
    NodeEntry* findEntry(std::string_view key);
    const Node* find(std::string_view key) const; // null when this is no table or lacks the key
    void erase(std::string_view key);
};

struct NodeEntry {
    std::string key;
    Place keyPlace;
    Node value;
};

// Throws InputError with file:line:column on a syntax error, and on inf, nan and times, which no key allows.
Node parseToml(std::string_view text, const std::string& fileName);
Node readTomlFile(const std::filesystem::path& file);

// "a string", "a number", "a list", ... for messages.
std::string_view describeKind(NodeKind kind);
// A value as a sub-case's name shows it: 1.5, hiz, 63x65.
std::string formatValue(const Node& node);

// Lays `base` under `top`: tables are merged key by key, a list of tables is appended to one of the same key, and of
// every other value `top`'s wins.
void mergeUnder(Node& top, const Node& base);

// Sets a value by its dotted path ("material.ior", "scene.primitives.0.radius"), making the tables on its way. A number
// in the path is an index from 0 into a list. Throws InputError at `keyPlace` when the path leads through what is no
// table or list.
void setByPath(Node& root, std::string_view dottedPath, const Place& keyPlace, const Node& value);

} // namespace crossray
