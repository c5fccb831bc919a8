// The list of sweeps that are made again by one command.
#include "harness/base/error.h"
#include "harness/case/node.h"
#include "harness/sweep/sweep.h"

#include <fmt/format.h>

#include <set>

namespace crossray {

namespace {

constexpr std::string_view kKeys = "id, title, case, parameter, range, set, shows, why";

const std::string& textOf(const Node& table, std::string_view key)
{
    const Node* const node = table.find(key);
    if (node == nullptr) {
        throw InputError(table.place.position(),
                         fmt::format("[[sweep]] lacks \"{}\"; required are id, title, case, parameter, range, shows, "
                                     "why",
                                     key));
    }
    if (node->kind != NodeKind::kString) {
        throw InputError(node->place.position(),
                         fmt::format("\"{}\" is {}; a string is allowed", key, describeKind(node->kind)));
    }
    return node->text;
}

void readOverrides(const Node& set, std::map<std::string, std::string>& overrides)
{
    for (const NodeEntry& entry : set.entries) {
        if (entry.value.kind != NodeKind::kString) {
            throw InputError(entry.value.place.position(),
                             fmt::format("\"{}\" of set is {}; a string is allowed, with the value as a case file has "
                                         "it",
                                         entry.key, describeKind(entry.value.kind)));
        }
        overrides[entry.key] = entry.value.text;
    }
}

ListedSweep readSweep(const Node& table)
{
    for (const NodeEntry& entry : table.entries) {
        if ((", " + std::string(kKeys) + ",").find(", " + entry.key + ",") == std::string::npos) {
            throw InputError(entry.keyPlace.position(),
                             fmt::format("unknown key \"{}\" in [[sweep]]; allowed: {}", entry.key, kKeys));
        }
    }
    ListedSweep sweep{textOf(table, "id"),        textOf(table, "title"), textOf(table, "case"),
                      textOf(table, "parameter"), textOf(table, "range"), {},
                      textOf(table, "shows"),     textOf(table, "why")};
    if (const Node* const set = table.find("set")) readOverrides(*set, sweep.overrides);
    SweepKeys::parse(sweep.parameter); // a list is refused as a whole, before minutes are spent
    SweepRange::parse(sweep.range);
    return sweep;
}

} // namespace

std::vector<ListedSweep> readSweepList(const std::filesystem::path& file)
{
    const Node root = readTomlFile(file);
    std::vector<ListedSweep> sweeps;
    std::set<std::string> ids;
    for (const NodeEntry& entry : root.entries) {
        if (entry.key != "sweep" || entry.value.kind != NodeKind::kList) {
            throw InputError(entry.keyPlace.position(),
                             fmt::format("unknown key \"{}\"; allowed: [[sweep]]", entry.key));
        }
        for (const Node& table : entry.value.items) {
            sweeps.push_back(readSweep(table));
            if (!ids.insert(sweeps.back().id).second) {
                throw InputError(table.place.position(),
                                 fmt::format("the id \"{}\" is there twice; each once is allowed", sweeps.back().id));
            }
        }
    }
    return sweeps;
}

} // namespace crossray
