#include "harness/case/case_files.h"

#include "harness/case/presets.h"

#include <algorithm>

namespace crossray {

namespace fs = std::filesystem;

namespace {

void addFile(const fs::path& file, std::vector<fs::path>& files)
{
    if (!file.empty() && std::find(files.begin(), files.end(), file) == files.end()) files.push_back(file);
}

void addFiles(const Environment& environment, std::vector<fs::path>& files)
{
    if (const auto* own = std::get_if<CubemapFile>(&environment.content)) addFile(own->file, files);
    if (const auto* capture = std::get_if<SceneCapture>(&environment.content)) addFile(capture->bakedFile, files);
}

} // namespace

std::vector<fs::path> listFiles(const Case& testCase)
{
    std::vector<fs::path> files;
    addFile(testCase.file, files);
    addFile(findPresetsFile(testCase.file.parent_path()), files);
    for (const fs::path& file : listNamedFiles(testCase))
        addFile(file, files);
    return files;
}

std::vector<fs::path> listNamedFiles(const Case& testCase)
{
    std::vector<fs::path> files;
    if (testCase.recorded) {
        addFile(testCase.recorded->file, files);
        addFile(testCase.recorded->cameraFile, files);
        addFile(testCase.recorded->truthFile, files);
    }
    if (testCase.material.thicknessMap) addFile(testCase.material.thicknessMap->file, files);
    addFile(testCase.projection.own.tracer, files);
    for (const Probe& probe : testCase.probes)
        addFiles(probe.environment, files);
    if (testCase.sky.environment) addFiles(*testCase.sky.environment, files);
    for (const Expectation& expectation : testCase.expectations) {
        if (const auto* golden = std::get_if<GoldenSource>(&expectation.source)) addFile(golden->file, files);
    }
    return files;
}

} // namespace crossray
