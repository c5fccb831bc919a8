#include "harness/mutate/equivalent.h"

#include "harness/case/node.h"

#include <fmt/format.h>

#include <algorithm>

namespace crossray {

namespace {

constexpr std::string_view kAllowed = "file, function, reason, edits";

const std::string& textOf(const Node& table, std::string_view key)
{
    const Node* const node = table.find(key);
    if (node == nullptr) {
        throw InputError(table.place.position(),
                         fmt::format("[[equivalent]] lacks \"{}\"; required are {}", key, kAllowed));
    }
    if (node->kind != NodeKind::kString) {
        throw InputError(node->place.position(),
                         fmt::format("\"{}\" is {}; a string is allowed", key, describeKind(node->kind)));
    }
    return node->text;
}

void readEdits(const Node& table, EquivalentMutant entry, std::vector<EquivalentMutant>& found)
{
    const Node* const edits = table.find("edits");
    if (edits == nullptr || edits->kind != NodeKind::kList || edits->items.empty()) {
        throw InputError((edits == nullptr ? table : *edits).place.position(),
                         "edits is a list of [\"line before\", \"line after\"]");
    }
    for (const Node& edit : edits->items) {
        const bool isPair = edit.kind == NodeKind::kList && edit.items.size() == 2 &&
                            edit.items[0].kind == NodeKind::kString && edit.items[1].kind == NodeKind::kString;
        if (!isPair) throw InputError(edit.place.position(), "an edit is [\"line before\", \"line after\"]");
        entry.before = edit.items[0].text;
        entry.after = edit.items[1].text;
        entry.position = edit.items[0].place.position();
        found.push_back(entry);
    }
}

} // namespace

bool EquivalentMutant::matches(const Mutation& mutation) const
{
    return file == mutation.file && function == mutation.function && before == mutation.before &&
           after == mutation.after;
}

std::vector<EquivalentMutant> readEquivalents(const std::filesystem::path& file)
{
    const Node root = readTomlFile(file);
    std::vector<EquivalentMutant> found;
    for (const NodeEntry& entry : root.entries) {
        if (entry.key != "equivalent" || entry.value.kind != NodeKind::kList) {
            throw InputError(entry.keyPlace.position(),
                             fmt::format("unknown key \"{}\"; allowed: [[equivalent]]", entry.key));
        }
        for (const Node& table : entry.value.items) {
            for (const NodeEntry& own : table.entries) {
                if ((", " + std::string(kAllowed) + ",").find(", " + own.key + ",") == std::string::npos) {
                    throw InputError(
                        own.keyPlace.position(),
                        fmt::format("unknown key \"{}\" in [[equivalent]]; allowed: {}", own.key, kAllowed));
                }
            }
            EquivalentMutant mutant{
                textOf(table, "file"), textOf(table, "function"), {}, {}, textOf(table, "reason"), {}};
            if (mutant.reason.empty()) throw InputError(table.place.position(), "the reason is empty");
            readEdits(table, std::move(mutant), found);
        }
    }
    return found;
}

void checkEquivalents(std::span<const EquivalentMutant> equivalents, std::span<const Mutation> mutations)
{
    for (const EquivalentMutant& entry : equivalents) {
        const bool isPlanted = std::any_of(mutations.begin(), mutations.end(),
                                           [&](const Mutation& mutation) { return mutation.file == entry.file; });
        const bool isFound = std::any_of(mutations.begin(), mutations.end(),
                                         [&](const Mutation& mutation) { return entry.matches(mutation); });
        if (!isPlanted || isFound) continue;
        throw InputError(entry.position,
                         fmt::format("no mutant of {} in {} is that any more: the entry is to be removed", entry.file,
                                     entry.function));
    }
}

} // namespace crossray
