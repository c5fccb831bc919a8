#include "harness/run/plane_files.h"

#include "harness/base/error.h"
#include "harness/run/run_json.h"
#include "harness/scene/exr.h"

#include <fmt/format.h>

#include <unistd.h>

#include <cmath>
#include <fstream>

namespace crossray {

namespace fs = std::filesystem;

namespace {

void createFolder(const fs::path& folder)
{
    std::error_code failure;
    fs::create_directories(folder, failure);
    if (failure) {
        throw EnvironmentError(fmt::format("{}: the folder cannot be made: {}", folder.string(), failure.message()));
    }
}

bool areSame(double a, double b)
{
    return a == b || (std::isnan(a) && std::isnan(b));
}

} // namespace

fs::path PlaneFiles::makePlace(const std::string& caseName, const std::string& stem, std::string_view extension) const
{
    // "vulkan:NAME" is a backend, and no good file name on every system.
    std::string safeStem = stem;
    for (char& character : safeStem) {
        if (character == ':' || character == '/' || character == ' ') character = '_';
    }
    fs::path relative = fs::path("planes") / caseName / (safeStem + std::string(extension));
    createFolder((runFolder_ / relative).parent_path());
    return relative;
}

std::string PlaneFiles::write(const std::string& caseName, const std::string& stem, std::span<const Plane> planes) const
{
    const fs::path relative = makePlace(caseName, stem, ".exr");
    writeExr(runFolder_ / relative, planes, {{"case", caseName}, {"source", stem}});
    return relative.generic_string();
}

std::string PlaneFiles::writeTrace(const std::string& caseName, const std::string& backend, std::string_view json) const
{
    const fs::path relative = makePlace(caseName, backend, ".trace.json");
    writeFileWhole(runFolder_ / relative, json);
    return relative.generic_string();
}

void startRunFolder(const fs::path& folder, bool resume)
{
    if (resume) {
        const RunResult last = readRun(folder);
        if (!last.interrupted) {
            throw InputError(
                fmt::format("--resume: the run in {} has ended; allowed is one that was interrupted", folder.string()));
        }
        return;
    }
    createFolder(folder);
    const fs::path json = folder / "run.json", planes = folder / "planes";
    std::error_code failure;
    if (!fs::exists(json, failure) && fs::exists(planes, failure)) {
        throw InputError(
            fmt::format("{}: holds a folder \"planes\" and no run.json: no run has written it; choose another --output",
                        folder.string()));
    }
    RunResult begun;
    begun.interrupted = true;
    writeFileWhole(json, formatRunJson(begun));
    fs::remove(folder / "report" / "index.html", failure); // pages of the last run would be taken for this one's
    fs::remove_all(planes, failure);
    if (failure) {
        throw EnvironmentError(
            fmt::format("{}: the planes of the last run cannot be removed: {}", planes.string(), failure.message()));
    }
}

std::string describeDifference(std::span<const Plane> first, std::span<const Plane> again, int repeat)
{
    for (size_t i = 0; i < first.size(); ++i) {
        const Plane& a = first[i];
        const Plane& b = again[i];
        size_t count = 0, firstIndex = 0;
        for (size_t j = 0; j < a.values.size(); ++j) {
            if (areSame(a.values[j], b.values[j])) continue;
            if (count++ == 0) firstIndex = j;
        }
        if (count == 0) continue;
        const size_t pixel = firstIndex / static_cast<size_t>(a.channels), width = static_cast<size_t>(a.width);
        return fmt::format("repeat {} differs: {} in {} values, first at ({}, {})", repeat, a.name, count,
                           pixel % width, pixel / width);
    }
    return {};
}

void writeFileWhole(const fs::path& file, std::string_view content)
{
    fs::path aside = file;
    aside += fmt::format(".{}.tmp", getpid());
    std::ofstream stream(aside, std::ios::binary);
    stream.write(content.data(), static_cast<std::streamsize>(content.size()));
    stream.close();
    std::error_code failure;
    if (stream) fs::rename(aside, file, failure);
    if (!stream || failure) {
        fs::remove(aside, failure);
        throw EnvironmentError(fmt::format("{}: cannot be written", file.string()));
    }
}

} // namespace crossray
