// The case format as a table in code: the parser checks every file against it, takes its defaults from it, and
// docs/case-format.md is held to it by a test.
#pragma once

#include "harness/case/node.h"

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace crossray {

enum class KeyType {
    kString,
    kChoice, // one of a list of names
    kNumber,
    kInteger,
    kBoolean,
    kDate, // YYYY-MM-DD, quoted or bare
    kSize, // [width, height]
    kVec3,
    kVec3List, // lists of 3 numbers, as many as the builder wants
    kExtents,  // 2 or 3 numbers, infinity is expressed by leaving the key out
    kRotation, // Euler degrees, or a table of axis and degrees
    kStringList,
    kChoiceList,
    kTable,
    kTableList,
    kTableOrPreset, // a table, or the name of one in presets.toml
    kConstant,      // number, list of numbers, or the name of a hit class
    kExpansion,     // list of values for another key
};

// Of a number, of each number of a list, and of a list's length where the type has none of its own.
struct Range {
    double min = -std::numeric_limits<double>::infinity();
    double max = std::numeric_limits<double>::infinity();
    bool minIsOut = false;
    bool maxIsOut = false;

    bool holds(double value) const;
    std::string describe() const; // "above 0, at most 10"; empty when there is no bound
};

struct KeySpec {
    std::string table; // dotted path, "" for the top level
    std::string key;
    KeyType type = KeyType::kString;
    Range range;
    std::vector<std::string> choices;
    std::string allowedWords; // beyond range and choices
    bool required = false;
    std::string defaultWords;
    std::optional<Node> defaultValue;
    std::string summary;

    std::string path() const { return table.empty() ? key : table + "." + key; }
    std::string allowed() const;
};

std::span<const KeySpec> keySpecs();
const KeySpec* findKeySpec(std::string_view table, std::string_view key);

// Unknown keys, wrong types, values out of range or not among the choices, and missing required keys, here and in all
// tables below. Throws InputError that says what is allowed, with the nearest name for a mistyped one.
void checkTable(const Node& node, std::string_view table);

// The name of `names` that a mistyped one most likely stands for; empty when none is near.
std::string_view nearestName(std::string_view mistyped, std::span<const std::string> names);
// The end of a message about it: "; did you mean "ior"? Allowed: ...".
std::string suggest(std::string_view mistyped, std::span<const std::string> names);

// Values of one table after checkTable: what the file has, else the schema's default.
class TableReader {
  public:
    TableReader(const Node* table, std::string_view name) : node_(table), name_(name) {} // null: all defaults
    bool has(std::string_view key) const { return node_ && node_->find(key); }
    // Of the key where it is given, else of the table, for messages about how keys fit together.
    SourcePosition position(std::string_view key) const;
    const Node* find(std::string_view key) const; // null when neither file nor schema has a value
    double number(std::string_view key) const { return value(key).number; }
    int integer(std::string_view key) const { return static_cast<int>(value(key).integer); }
    bool boolean(std::string_view key) const { return value(key).boolean; }
    const std::string& text(std::string_view key) const { return value(key).text; }
    // Position of the value in the spec's choices: enums are listed in order.
    int choice(std::string_view key) const;
    std::vector<std::string> texts(std::string_view key) const; // empty when there is no value
    std::vector<double> numbers(std::string_view key) const;
    TableReader table(std::string_view key) const;

  private:
    const Node& value(std::string_view key) const;
    const Node* node_;
    std::string name_;
};

} // namespace crossray
