#include "harness/run/content_hashes.h"

#include "harness/base/text.h"
#include "harness/case/case_files.h"
#include "harness/case/presets.h"

#include <optional>

namespace crossray {

namespace fs = std::filesystem;

Hash128 ContentHashes::find(const fs::path& file)
{
    {
        const std::lock_guard lock(mutex_);
        if (const auto known = hashes_.find(file.native()); known != hashes_.end()) return known->second;
    }
    const std::optional<std::string> text = readText(file);
    const Hash128 hash = text ? hashBytes(std::string_view(*text)) : Hasher().addString("absent").finish();
    const std::lock_guard lock(mutex_);
    return hashes_.emplace(file.native(), hash).first->second;
}

Hash128 ContentHashes::hashFilesOf(const Case& testCase)
{
    Hasher hasher;
    const auto add = [&](const fs::path& file) { hasher.addString(file.filename().native()).addHash(find(file)); };
    add(testCase.file);
    if (const fs::path presets = findPresetsOf(testCase.file.parent_path()); !presets.empty()) add(presets);
    for (const fs::path& file : listNamedFiles(testCase))
        add(file);
    return hasher.finish();
}

fs::path ContentHashes::findPresetsOf(const fs::path& folder)
{
    const std::lock_guard lock(mutex_);
    const auto [place, isNew] = presets_.try_emplace(folder.native());
    if (isNew) place->second = findPresetsFile(folder);
    return place->second;
}

} // namespace crossray
