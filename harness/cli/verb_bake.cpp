#include "harness/cli/verbs.h"
#include "harness/expect/captures.h"
#include "harness/run/environment.h"

#include <fmt/format.h>

#include <filesystem>
#include <map>

namespace crossray {

namespace {

struct BakeTask {
    const Case* testCase;
    const Probe* probe;
    size_t number; // of the [[probe]], from 1
};

const SceneCapture* bakedCapture(const Probe& probe)
{
    const auto* capture = std::get_if<SceneCapture>(&probe.environment.content);
    return capture != nullptr && capture->mode == SceneCapture::Mode::kBaked ? capture : nullptr;
}

std::vector<BakeTask> findBakedProbes(const std::vector<Case>& cases)
{
    std::vector<BakeTask> tasks;
    for (const Case& testCase : cases) {
        for (size_t i = 0; i < testCase.probes.size(); ++i) {
            const Probe& probe = testCase.probes[i];
            if (probe.kind == ProbeKind::kReflection && bakedCapture(probe))
                tasks.push_back({&testCase, &probe, i + 1});
        }
    }
    return tasks;
}

std::filesystem::path targetOf(const BakeTask& task, const std::string& output)
{
    return output.empty() ? bakedCapture(*task.probe)->bakedFile : std::filesystem::path(output);
}

void makeFolderOf(const std::filesystem::path& file)
{
    if (!file.has_parent_path()) return;
    std::error_code error;
    std::filesystem::create_directories(file.parent_path(), error);
    if (error) throw EnvironmentError(fmt::format("{}: {}", file.parent_path().string(), error.message()));
}

} // namespace

int bakeProbes(const GlobalOptions& global, const BakeOptions& options)
{
    const Folders folders = findFolders(global.shaders, global.cases, global.cache);
    const SelectedCases selected = selectCases({{options.testCase}, {}, {}, {}, false}, folders.cases, {}, false);
    if (selected.exitCode) return static_cast<int>(*selected.exitCode);
    const std::vector<BakeTask> tasks = findBakedProbes(selected.cases);
    if (tasks.empty()) {
        fmt::print(stderr, "crossray: {} has nothing to bake: no [[probe]] with capture = \"baked\"\n",
                   options.testCase);
        return static_cast<int>(ExitCode::kNothingSelected);
    }
    // Sub-cases may share a file, as long as they see the same.
    std::map<std::filesystem::path, Cubemap> baked;
    for (const BakeTask& task : tasks) {
        const std::filesystem::path target = targetOf(task, options.output);
        Cubemap cubemap = captureProbe(*task.testCase, *task.probe);
        const auto [entry, isNew] = baked.try_emplace(target, cubemap);
        if (isNew) continue;
        if (entry->second.levels != cubemap.levels) {
            throw InputError(bakedCapture(*task.probe)->position,
                             fmt::format("{}, probe {}, shows something else than another probe that is baked to {}; "
                                         "a \"file\" for each is allowed",
                                         task.testCase->name, task.number, target.string()));
        }
    }
    for (const auto& [target, cubemap] : baked) {
        makeFolderOf(target);
        writeCubemap(target, cubemap);
        fmt::print("{}: six faces of {}x{}, {} levels\n", target.string(), cubemap.size, cubemap.size,
                   cubemap.levelCount());
    }
    return static_cast<int>(ExitCode::kAsExpected);
}

} // namespace crossray
