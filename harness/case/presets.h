// presets.toml: what cases share by name. [tolerance.NAME] holds the keys of an expectation's tolerance; [preset.NAME]
// holds keys of a case and is laid under each case that names it in `use`.
#pragma once

#include "harness/case/node.h"

#include <filesystem>
#include <memory>

namespace crossray {

// presets.toml of the nearest folder, from `folder` upwards, that holds one; empty when none does.
std::filesystem::path findPresetsFile(const std::filesystem::path& folder);

// The presets of the nearest folder, from `folder` upwards, that holds a presets.toml; null when none does. Read once
// and again when the file changes. Throws InputError.
std::shared_ptr<const Node> findPresets(const std::filesystem::path& folder);

// A named table of the presets ("preset" or "tolerance"); throws InputError at `name` when it is not there.
const Node& findPreset(const Node* presets, std::string_view kind, const Node& name);

// Lays the presets that a case names in `use` under it; of two that set one key the later wins. Throws InputError.
void applyPresets(Node& root, const Node* presets);

} // namespace crossray
