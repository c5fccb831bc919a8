// What surrounds a run: folders, the commit, the processors.
#pragma once

#include "harness/run/worker_pool.h"

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace crossray {

std::string_view toolVersion();

struct Folders {
    std::filesystem::path shaders;
    std::filesystem::path cases;
    std::filesystem::path cache; // has spirv/ and mesa/
};

// Each empty argument falls back to the environment (CROSSRAY_SHADERS, CROSSRAY_CASES, CROSSRAY_CACHE), then to the
// source tree that the tool was built from, then to the installed share/crossray. The cache's fallback is
// XDG_CACHE_HOME or ~/.cache, and then a folder below the temporary one. Throws EnvironmentError when there is no such
// folder; the cache is made later, on need.
Folders findFolders(const std::string& shaders, const std::string& cases, const std::string& cache);

struct Commit {
    std::string hash; // empty when there is no git, or no repository
    bool modified = false;
};
// Of the source tree that the shaders come from.
Commit findCommit(const std::filesystem::path& folder);

// Processors that this process may use.
int countAvailableCores();

// The backends that a run shall use, in the order of listBackends(). `wanted`: names, "all" for every one that is
// there, or empty for the default ones. `notes` says which optional ones are not there. Throws InputError for an
// unknown name and EnvironmentError when one that was asked for, or that every plain run needs, is missing.
struct BackendChoice {
    std::vector<std::string> names;
    std::vector<std::string> notes;
};
BackendChoice chooseBackends(std::span<const std::string> wanted, std::span<const BackendInfo> known);
// A plain run needs lavapipe, cpu32, cpu64, and either osmesa or egl.
bool isRequired(const std::string& backend, std::span<const BackendInfo> known);

} // namespace crossray
