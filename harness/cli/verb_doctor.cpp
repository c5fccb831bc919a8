#include "harness/cli/verbs.h"
#include "harness/run/environment.h"

#include <fmt/format.h>

#include <unistd.h>

namespace crossray {

namespace {

namespace fs = std::filesystem;

bool isWritable(const fs::path& folder)
{
    std::error_code failure;
    fs::create_directories(folder, failure);
    return !failure && access(folder.c_str(), W_OK | X_OK) == 0;
}

// Prints one line about a backend; false when it is needed and does not work.
bool diagnoseBackend(const BackendInfo& info, std::span<const BackendInfo> known, WorkerPool& pool, const Style& style)
{
    const bool required = isRequired(info.name, known);
    const std::string role = required ? "needed" : info.byDefault ? "where found" : "on request";
    std::string problem = info.found ? "" : info.missing;
    Fingerprint print;
    if (info.found) {
        try {
            print = pool.fingerprint(info.name);
        } catch (const EnvironmentError& error) {
            problem = error.what();
        }
    }
    if (problem.empty()) {
        fmt::print("{} {:<12} {:<12} {}, {}, {}\n", style.paint(Ink::kGreen, "ok     "), info.name, role, print.device,
                   print.driver, print.api);
        return true;
    }
    fmt::print("{} {:<12} {:<12} {}\n", style.paint(required ? Ink::kRed : Ink::kYellow, "missing"), info.name, role,
               problem);
    return !required;
}

} // namespace

int diagnose(const GlobalOptions& global)
{
    const Style style = Style::choose(global.color, STDOUT_FILENO);
    const Folders folders = findFolders(global.shaders, global.cases, global.cache);
    const Commit commit = findCommit(folders.shaders);
    fmt::print("crossray {}{}{}\n", toolVersion(), commit.hash.empty() ? "" : ", commit " + commit.hash.substr(0, 12),
               commit.modified ? " and changes" : "");
    for (const auto& [name, version] : ShaderCompiler::versions())
        fmt::print("        {:<12} {}\n", name, version);
    fmt::print("        {:<12} {} available\n", "processors", countAvailableCores());

    bool healthy = true;
    fmt::print("\nfolders\n");
    fmt::print("ok      {:<12} {}\n", "shaders", folders.shaders.string());
    fmt::print("ok      {:<12} {}\n", "cases", folders.cases.string());
    for (const char* part : {"spirv", "mesa"}) {
        const fs::path folder = folders.cache / part;
        const bool writable = isWritable(folder);
        fmt::print(
            "{} {:<12} {}{}\n", writable ? "ok     " : style.paint(Ink::kYellow, "slow   "), "cache", folder.string(),
            writable ? "" : " cannot be written: everything is compiled anew each time; choose another --cache-dir");
    }

    fmt::print("\nbackends\n");
    const std::vector<BackendInfo> known = listBackends();
    WorkerOptions workers;
    workers.mesaCacheFolder = folders.cache / "mesa";
    WorkerPool pool(workers);
    for (const BackendInfo& info : known)
        healthy = diagnoseBackend(info, known, pool, style) && healthy;
    return static_cast<int>(healthy ? ExitCode::kAsExpected : ExitCode::kEnvironment);
}

} // namespace crossray
