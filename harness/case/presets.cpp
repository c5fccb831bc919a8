#include "harness/case/presets.h"

#include "harness/case/schema.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <mutex>
#include <system_error>

namespace crossray {

namespace {

namespace fs = std::filesystem;

// What is a case's own and cannot be shared.
constexpr std::array<std::string_view, 5> kOwnKeys{"schema", "name", "summary", "use", "expand"};

void checkPresets(const Node& root)
{
    for (const NodeEntry& group : root.entries) {
        const bool known = group.key == "tolerance" || group.key == "preset";
        const bool isSchema =
            group.key == "schema" && group.value.kind == NodeKind::kInteger && group.value.integer == 1;
        if (isSchema) continue;
        if (!known || group.value.kind != NodeKind::kTable) {
            throw InputError(
                group.keyPlace.position(),
                fmt::format("\"{}\" is not allowed in presets; schema = 1, [tolerance.NAME] and [preset.NAME] are",
                            group.key));
        }
        for (const NodeEntry& preset : group.value.entries) {
            if (preset.value.kind != NodeKind::kTable) {
                throw InputError(
                    preset.value.place.position(),
                    fmt::format("\"{}\" is {}; a table is allowed", preset.key, describeKind(preset.value.kind)));
            }
            if (group.key == "tolerance") checkTable(preset.value, "expect.tolerance");
            for (const std::string_view own : kOwnKeys) {
                if (const NodeEntry* entry = preset.value.findEntry(own)) {
                    throw InputError(entry->keyPlace.position(),
                                     fmt::format("\"{}\" is not allowed in a preset; it is the case's own", own));
                }
            }
        }
    }
}

struct CachedPresets {
    fs::file_time_type time;
    std::shared_ptr<const Node> root;
};

} // namespace

fs::path findPresetsFile(const fs::path& folder)
{
    std::error_code error;
    for (fs::path at = fs::absolute(folder.empty() ? "." : folder, error); !at.empty(); at = at.parent_path()) {
        if (fs::exists(at / "presets.toml", error)) return at / "presets.toml";
        if (at == at.parent_path()) break;
    }
    return {};
}

std::shared_ptr<const Node> findPresets(const fs::path& folder)
{
    static std::mutex mutex;
    static std::map<fs::path, CachedPresets> cache;

    const fs::path file = findPresetsFile(folder);
    std::error_code error;
    const fs::file_time_type time = fs::last_write_time(file, error);
    if (file.empty() || error) return nullptr;
    const std::lock_guard lock(mutex);
    CachedPresets& cached = cache[file];
    if (!cached.root || cached.time != time) {
        Node root = readTomlFile(file);
        checkPresets(root);
        cached = {time, std::make_shared<const Node>(std::move(root))};
    }
    return cached.root;
}

const Node& findPreset(const Node* presets, std::string_view kind, const Node& name)
{
    if (!presets) {
        throw InputError(
            name.place.position(),
            fmt::format("\"{}\" names a preset; a presets.toml in the case's folder or above it is required",
                        name.text));
    }
    const Node* group = presets->find(kind);
    if (const Node* preset = group ? group->find(name.text) : nullptr) return *preset;
    std::vector<std::string> names;
    for (const NodeEntry& entry : group ? group->entries : std::vector<NodeEntry>{})
        names.push_back(entry.key);
    throw InputError(name.place.position(), fmt::format("\"{}\" is no [{}.NAME] of the presets{}", name.text, kind,
                                                        suggest(name.text, names)));
}

void applyPresets(Node& root, const Node* presets)
{
    const Node* use = root.find("use");
    if (!use) return;
    const std::vector<Node> names = use->items;
    for (auto name = names.rbegin(); name != names.rend(); ++name) {
        if (name->kind != NodeKind::kString) {
            throw InputError(name->place.position(),
                             fmt::format("\"use\" holds {}; names are allowed", describeKind(name->kind)));
        }
        mergeUnder(root, findPreset(presets, "preset", *name));
    }
}

} // namespace crossray
