#include "harness/run/environment.h"

#include "harness/base/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sched.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <memory>

namespace crossray {

namespace fs = std::filesystem;

namespace {

std::string readVariable(const char* name)
{
    const char* const value = std::getenv(name);
    return value == nullptr ? "" : value;
}

fs::path findInstalled(const std::string& name)
{
    std::error_code failure;
    const fs::path program = fs::read_symlink("/proc/self/exe", failure);
    return program.parent_path().parent_path() / "share" / "crossray" / name;
}

fs::path findFolder(const std::string& given, const char* variable, const std::string& name)
{
    const std::string chosen = given.empty() ? readVariable(variable) : given;
    std::error_code failure;
    if (!chosen.empty()) {
        if (fs::is_directory(chosen, failure)) return chosen;
        throw InputError(
            fmt::format("{}: there is no such folder; --{} or {} names the folder {}/", chosen, name, variable, name));
    }
    // An installed program takes what was installed with it, though the tree that it was built from may still be there.
    for (const fs::path& candidate : {findInstalled(name), fs::path(CROSSRAY_SOURCE_DIR) / name}) {
        if (fs::is_directory(candidate, failure)) return candidate;
    }
    throw EnvironmentError(fmt::format(
        "the folder {}/ is neither in the source tree nor installed; name it by --{} or {}", name, name, variable));
}

fs::path findCache(const std::string& given)
{
    if (!given.empty()) return given;
    if (const std::string chosen = readVariable("CROSSRAY_CACHE"); !chosen.empty()) return chosen;
    if (const std::string base = readVariable("XDG_CACHE_HOME"); !base.empty()) return fs::path(base) / "crossray";
    if (const std::string home = readVariable("HOME"); !home.empty()) return fs::path(home) / ".cache" / "crossray";
    return fs::temp_directory_path() / "crossray-cache";
}

} // namespace

std::string_view toolVersion()
{
    return CROSSRAY_VERSION;
}

Folders findFolders(const std::string& shaders, const std::string& cases, const std::string& cache)
{
    return {findFolder(shaders, "CROSSRAY_SHADERS", "shaders"), findFolder(cases, "CROSSRAY_CASES", "cases"),
            findCache(cache)};
}

Commit findCommit(const fs::path& folder)
{
    std::string quoted = "'";
    for (const char character : folder.string())
        quoted += character == '\'' ? "'\\''" : std::string(1, character);
    const std::string command =
        fmt::format("git -C {}' describe --always --dirty --abbrev=40 --exclude '*' 2>/dev/null", quoted);
    const auto close = [](FILE* stream) { pclose(stream); };
    const std::unique_ptr<FILE, decltype(close)> pipe(popen(command.c_str(), "r"), close);
    std::array<char, 256> line{};
    if (!pipe || fgets(line.data(), static_cast<int>(line.size()), pipe.get()) == nullptr) return {};
    std::string text(line.data());
    while (!text.empty() && text.back() == '\n')
        text.pop_back();
    const bool modified = text.ends_with("-dirty");
    return {text.substr(0, text.find('-')), modified};
}

int countAvailableCores()
{
    cpu_set_t set;
    CPU_ZERO(&set);
    if (sched_getaffinity(0, sizeof(set), &set) != 0) return 1;
    return std::max(1, CPU_COUNT(&set));
}

bool isRequired(const std::string& backend, std::span<const BackendInfo> known)
{
    if (backend == "lavapipe" || backend == "cpu32" || backend == "cpu64") return true;
    if (backend != "osmesa") return false;
    return std::none_of(known.begin(), known.end(),
                        [](const BackendInfo& info) { return info.name == "egl" && info.found; });
}

namespace {

EnvironmentError makeMissingError(const BackendInfo& info)
{
    return EnvironmentError(fmt::format("the backend {} is missing: {}", info.name, info.missing));
}

BackendChoice chooseDefault(std::span<const BackendInfo> known)
{
    // Where OSMesa has gone, surfaceless EGL is the GL.
    const bool lacksOsmesa =
        std::any_of(known.begin(), known.end(), [](const auto& info) { return info.name == "osmesa" && !info.found; });
    BackendChoice choice;
    for (const BackendInfo& info : known) {
        const bool wanted = info.byDefault || (info.name == "egl" && lacksOsmesa);
        if (!wanted) continue;
        if (info.found) {
            choice.names.push_back(info.name);
        } else if (isRequired(info.name, known)) {
            throw makeMissingError(info);
        } else {
            choice.notes.push_back(fmt::format("without {}: {}", info.name, info.missing));
        }
    }
    return choice;
}

} // namespace

BackendChoice chooseBackends(std::span<const std::string> wanted, std::span<const BackendInfo> known)
{
    if (wanted.empty()) return chooseDefault(known);
    BackendChoice choice;
    auto add = [&](const std::string& name) {
        if (std::find(choice.names.begin(), choice.names.end(), name) == choice.names.end())
            choice.names.push_back(name);
    };
    std::vector<std::string> all;
    for (const BackendInfo& info : known)
        all.push_back(info.name);
    for (const std::string& name : wanted) {
        const auto info =
            std::find_if(known.begin(), known.end(), [&](const BackendInfo& other) { return other.name == name; });
        if (name == "all") {
            for (const BackendInfo& each : known) {
                if (each.found) add(each.name);
            }
        } else if (info != known.end()) {
            if (!info->found) throw makeMissingError(*info);
            add(name);
        } else if (name.starts_with("vulkan:") && name.size() > 7) {
            add(name);
        } else {
            throw InputError(fmt::format("--backend {}: there is no such backend; allowed are {}, vulkan:NAME and all",
                                         name, fmt::join(all, ", ")));
        }
    }
    // In one order, whatever the order on the command line, so that reports line up.
    std::stable_sort(choice.names.begin(), choice.names.end(), [&](const std::string& a, const std::string& b) {
        return std::find(all.begin(), all.end(), a) < std::find(all.begin(), all.end(), b);
    });
    return choice;
}

} // namespace crossray
