#include "harness/case/schema.h"

#include "harness/case/case.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <unordered_map>

namespace crossray {

namespace {

std::string_view nameOf(KeyType type)
{
    switch (type) {
    case KeyType::kString:
        return "string";
    case KeyType::kChoice:
        return "name";
    case KeyType::kNumber:
        return "number";
    case KeyType::kInteger:
        return "integer";
    case KeyType::kBoolean:
        return "boolean";
    case KeyType::kDate:
        return "date";
    case KeyType::kSize:
        return "list of 2 integers";
    case KeyType::kVec3:
        return "list of 3 numbers";
    case KeyType::kVec3List:
        return "list of lists of 3 numbers";
    case KeyType::kExtents:
        return "list of 2 or 3 numbers";
    case KeyType::kRotation:
        return "list of 3 numbers, or table";
    case KeyType::kStringList:
        return "list of strings";
    case KeyType::kChoiceList:
        return "list of names";
    case KeyType::kTable:
        return "table";
    case KeyType::kTableList:
        return "list of tables";
    case KeyType::kTableOrPreset:
        return "table, or name";
    case KeyType::kConstant:
        return "number, list of numbers, or name";
    case KeyType::kExpansion:
        return "list of values";
    }
    return "";
}

// The keys of one table by name, their names in order, and those that must be there.
struct TableSpec {
    std::unordered_map<std::string_view, const KeySpec*> keys;
    std::vector<std::string> names;
    std::vector<const KeySpec*> required;
};

const TableSpec* findTableSpec(std::string_view table)
{
    static const auto tables = [] {
        std::unordered_map<std::string_view, TableSpec> result;
        for (const KeySpec& spec : keySpecs()) {
            TableSpec& entry = result[spec.table];
            entry.keys.emplace(spec.key, &spec);
            entry.names.push_back(spec.key);
            if (spec.required) entry.required.push_back(&spec);
        }
        return result;
    }();
    const auto found = tables.find(table);
    return found == tables.end() ? nullptr : &found->second;
}

// [[scene.primitive]] and `primitives` hold the same tables; a rotation's, an environment's and a gradient's table is
// one format wherever it stands.
std::string subTableOf(const KeySpec& spec)
{
    if (spec.type == KeyType::kRotation) return "rotation";
    if (spec.key == "environment") return "environment";
    if (spec.key == "gradient") return "scene.sky";
    return spec.path() == "scene.primitive" ? "scene.primitives" : spec.path();
}

std::string withArticle(std::string_view name)
{
    return fmt::format("{} {}", name.starts_with('i') ? "an" : "a", name);
}

[[noreturn]] void refuse(const Node& node, const std::string& text)
{
    throw InputError(node.place.position(), text);
}

[[noreturn]] void refuseType(const Node& node, const KeySpec& spec)
{
    refuse(node, fmt::format("\"{}\" is {}; {} is allowed{}", spec.key, describeKind(node.kind),
                             withArticle(nameOf(spec.type)), spec.allowed().empty() ? "" : ": " + spec.allowed()));
}

void checkRange(const Node& node, const KeySpec& spec)
{
    if (!spec.range.holds(node.number)) {
        refuse(node, fmt::format("\"{}\" is {}; {} is allowed", spec.key, formatValue(node), spec.range.describe()));
    }
}

void checkNumbers(const Node& node, const KeySpec& spec, size_t fewest, size_t most, bool integers)
{
    if (node.kind != NodeKind::kList) refuseType(node, spec);
    for (const Node& item : node.items) {
        if (integers ? item.kind != NodeKind::kInteger : !item.isNumber()) refuseType(item, spec);
        checkRange(item, spec);
    }
    if (node.items.size() < fewest || node.items.size() > most) {
        refuse(node, fmt::format("\"{}\" has {} value{}; a {} is allowed", spec.key, node.items.size(),
                                 node.items.size() == 1 ? "" : "s", nameOf(spec.type)));
    }
}

bool isVulkanDevice(std::string_view name)
{
    return name.starts_with("vulkan:") && name.size() > 7;
}

void checkChoice(const Node& node, const KeySpec& spec)
{
    if (node.kind != NodeKind::kString) refuseType(node, spec);
    const auto& choices = spec.choices;
    const bool known =
        std::find(choices.begin(), choices.end(), node.text) != choices.end() && node.text != "vulkan:NAME";
    if (known || (choices.back() == "vulkan:NAME" && isVulkanDevice(node.text))) return;
    refuse(node, fmt::format("\"{}\" is no name for \"{}\"{}", node.text, spec.key, suggest(node.text, choices)));
}

void checkList(const Node& node, const KeySpec& spec)
{
    if (node.kind != NodeKind::kList) refuseType(node, spec);
    for (size_t i = 0; i < node.items.size(); ++i) {
        const Node& item = node.items[i];
        if (item.kind != NodeKind::kString) refuseType(item, spec);
        if (spec.type == KeyType::kChoiceList) checkChoice(item, spec);
        const bool twice = std::any_of(node.items.begin(), node.items.begin() + static_cast<std::ptrdiff_t>(i),
                                       [&](const Node& before) { return before.text == item.text; });
        if (twice) refuse(item, fmt::format("\"{}\" is twice in \"{}\"; once is allowed", item.text, spec.key));
    }
}

void checkValue(const Node& node, const KeySpec& spec)
{
    const NodeKind kind = node.kind;
    switch (spec.type) {
    case KeyType::kString:
        if (kind != NodeKind::kString) refuseType(node, spec);
        if (node.text.empty()) refuse(node, fmt::format("\"{}\" is empty; some text is allowed", spec.key));
        break;
    case KeyType::kChoice:
        checkChoice(node, spec);
        break;
    case KeyType::kNumber:
        if (!node.isNumber()) refuseType(node, spec);
        checkRange(node, spec);
        break;
    case KeyType::kInteger:
        if (kind != NodeKind::kInteger) refuseType(node, spec);
        checkRange(node, spec);
        break;
    case KeyType::kBoolean:
        if (kind != NodeKind::kBoolean) refuseType(node, spec);
        break;
    case KeyType::kDate:
        if (kind != NodeKind::kString && kind != NodeKind::kDate) refuseType(node, spec);
        break;
    case KeyType::kSize:
        checkNumbers(node, spec, 2, 2, true);
        break;
    case KeyType::kVec3:
        checkNumbers(node, spec, 3, 3, false);
        break;
    case KeyType::kVec3List:
        if (kind != NodeKind::kList) refuseType(node, spec);
        for (const Node& item : node.items)
            checkNumbers(item, spec, 3, 3, false);
        break;
    case KeyType::kExtents:
        checkNumbers(node, spec, 2, 3, false);
        break;
    case KeyType::kRotation:
        if (kind == NodeKind::kTable) return checkTable(node, subTableOf(spec));
        checkNumbers(node, spec, 3, 3, false);
        break;
    case KeyType::kStringList:
    case KeyType::kChoiceList:
        checkList(node, spec);
        break;
    case KeyType::kTable:
        if (kind != NodeKind::kTable) refuseType(node, spec);
        checkTable(node, subTableOf(spec));
        break;
    case KeyType::kTableList:
        if (kind != NodeKind::kList) refuseType(node, spec);
        for (const Node& item : node.items) {
            if (item.kind != NodeKind::kTable) refuseType(item, spec);
            checkTable(item, subTableOf(spec));
        }
        break;
    case KeyType::kTableOrPreset:
        if (kind == NodeKind::kTable) return checkTable(node, subTableOf(spec));
        if (kind != NodeKind::kString) refuseType(node, spec);
        break;
    case KeyType::kConstant:
        if (kind == NodeKind::kString || node.isNumber()) break;
        checkNumbers(node, spec, 1, 4, false);
        break;
    case KeyType::kExpansion:
        break; // checked where the values land
    }
}

// Distance between two words by insertions, deletions, replacements and swaps of neighbours.
size_t editDistance(std::string_view a, std::string_view b)
{
    std::vector<std::vector<size_t>> d(a.size() + 1, std::vector<size_t>(b.size() + 1));
    for (size_t i = 0; i <= a.size(); ++i)
        d[i][0] = i;
    for (size_t j = 0; j <= b.size(); ++j)
        d[0][j] = j;
    for (size_t i = 1; i <= a.size(); ++i) {
        for (size_t j = 1; j <= b.size(); ++j) {
            d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
                d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
            }
        }
    }
    return d[a.size()][b.size()];
}

} // namespace

bool Range::holds(double value) const
{
    return (minIsOut ? value > min : value >= min) && (maxIsOut ? value < max : value <= max);
}

std::string Range::describe() const
{
    const bool hasMin = std::isfinite(min), hasMax = std::isfinite(max);
    if (hasMin && hasMax && min == max) return fmt::format("{}", min);
    if (hasMin && hasMax && !minIsOut && !maxIsOut) return fmt::format("{} to {}", min, max);
    std::string text;
    if (hasMin) text = fmt::format("{} {}", minIsOut ? "above" : "at least", min);
    if (hasMax) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", maxIsOut ? "below" : "at most", max);
    return text;
}

std::string KeySpec::allowed() const
{
    std::string text = range.describe();
    if (!choices.empty()) text = fmt::format("{}", fmt::join(choices, ", "));
    if (!allowedWords.empty()) text += (text.empty() ? "" : "; ") + allowedWords;
    return text;
}

const KeySpec* findKeySpec(std::string_view table, std::string_view key)
{
    const TableSpec* spec = findTableSpec(table);
    if (!spec) return nullptr;
    const auto found = spec->keys.find(key);
    return found == spec->keys.end() ? nullptr : found->second;
}

std::string_view nearestName(std::string_view mistyped, std::span<const std::string> names)
{
    std::string_view nearest;
    size_t best = std::max<size_t>(1, (mistyped.size() + 1) / 3) + 1;
    for (const std::string& name : names) {
        const size_t distance = editDistance(mistyped, name);
        if (distance < best) {
            best = distance;
            nearest = name;
        }
    }
    return nearest;
}

std::string suggest(std::string_view mistyped, std::span<const std::string> names)
{
    const std::string_view near = nearestName(mistyped, names);
    return near.empty() ? fmt::format("; allowed: {}", fmt::join(names, ", "))
                        : fmt::format("; did you mean \"{}\"? Allowed: {}", near, fmt::join(names, ", "));
}

void checkTable(const Node& node, std::string_view table)
{
    const TableSpec* spec = findTableSpec(table);
    assert(spec);
    if (table == "expand") return; // its keys are paths; each value is checked in the sub-case that it makes
    const auto where = [&] { return table.empty() ? "at the top level" : fmt::format("in [{}]", table); };
    for (const NodeEntry& entry : node.entries) {
        const auto found = spec->keys.find(entry.key);
        if (found == spec->keys.end()) {
            throw InputError(entry.keyPlace.position(), fmt::format("unknown key \"{}\" {}{}", entry.key, where(),
                                                                    suggest(entry.key, spec->names)));
        }
        checkValue(entry.value, *found->second);
    }
    for (const KeySpec* key : spec->required) {
        if (node.find(key->key)) continue;
        refuse(node, fmt::format("\"{}\" is missing {}; {} is required{}", key->key, where(),
                                 withArticle(nameOf(key->type)), key->allowed().empty() ? "" : ": " + key->allowed()));
    }
}

SourcePosition TableReader::position(std::string_view key) const
{
    if (!node_) return {};
    const Node* node = node_->find(key);
    return node ? node->place.position() : node_->place.position();
}

const Node* TableReader::find(std::string_view key) const
{
    if (const Node* own = node_ ? node_->find(key) : nullptr) return own;
    const KeySpec* spec = findKeySpec(name_, key);
    assert(spec);
    return spec->defaultValue ? &*spec->defaultValue : nullptr;
}

const Node& TableReader::value(std::string_view key) const
{
    const Node* node = find(key);
    assert(node);
    return *node;
}

int TableReader::choice(std::string_view key) const
{
    const std::vector<std::string>& choices = findKeySpec(name_, key)->choices;
    return static_cast<int>(std::find(choices.begin(), choices.end(), text(key)) - choices.begin());
}

std::vector<std::string> TableReader::texts(std::string_view key) const
{
    std::vector<std::string> result;
    if (const Node* list = find(key)) {
        for (const Node& item : list->items)
            result.push_back(item.text);
    }
    return result;
}

std::vector<double> TableReader::numbers(std::string_view key) const
{
    std::vector<double> result;
    if (const Node* list = find(key)) {
        for (const Node& item : list->items)
            result.push_back(item.number);
    }
    return result;
}

TableReader TableReader::table(std::string_view key) const
{
    const KeySpec* spec = findKeySpec(name_, key);
    assert(spec);
    return {node_ ? node_->find(key) : nullptr, subTableOf(*spec)};
}

std::vector<CaseKey> caseSchema()
{
    std::vector<CaseKey> result;
    for (const KeySpec& spec : keySpecs()) {
        result.push_back({spec.table, spec.key, std::string(nameOf(spec.type)), spec.allowed(),
                          spec.required ? "required" : spec.defaultWords, spec.summary});
    }
    return result;
}

} // namespace crossray
