// The atlas of where methods fail (docs/stability.md), which the build puts into the program with what it shows.
#pragma once

#include "harness/report/page.h"

#include <set>
#include <span>
#include <string>
#include <string_view>

namespace crossray {

struct AtlasFile {
    std::string_view name; // below the repository: "docs/stability.md"
    std::string_view content;
};

// The document, the sentences of the published sweeps, and the pictures that the document links, in that order.
std::span<const AtlasFile> atlasFiles();

// The cases that the document links, by their files' names: what a file expands to has its name and more.
std::set<std::string> findAtlasCases(std::span<const AtlasFile> files);

// What a report's page takes of them: the two texts as they are, which the page itself reads, and the pictures packed.
PageData makeAtlasTexts(std::span<const AtlasFile> files);
PageData makeAtlasPictures(std::span<const AtlasFile> files);

} // namespace crossray
