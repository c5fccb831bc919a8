// The planes of a run on disk: OUT/planes/CASE/BACKEND.exr, one part an output, and CASE/expected.exr; and the
// traces beside them.
#pragma once

#include "harness/base/plane.h"

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace crossray {

class PlaneFiles {
  public:
    explicit PlaneFiles(std::filesystem::path runFolder) : runFolder_(std::move(runFolder)) {}
    // Returns the file's path relative to the run's folder. Throws EnvironmentError when it cannot be written.
    std::string write(const std::string& caseName, const std::string& stem, std::span<const Plane> planes) const;

    // The same for the trace of a pixel: OUT/planes/CASE/BACKEND.trace.json.
    std::string writeTrace(const std::string& caseName, const std::string& backend, std::string_view json) const;

  private:
    // Relative to the run's folder; its own folder is there.
    std::filesystem::path makePlace(const std::string& caseName, const std::string& stem,
                                    std::string_view extension) const;

    std::filesystem::path runFolder_;
};

// Makes the folder ready for a new run: what an earlier run left there is removed, and a run.json that says
// "interrupted" stands until the run has ended. Throws InputError when the folder holds anything that no run has
// written, EnvironmentError when it cannot be written to.
// With `resume` what is there stays. InputError then when no run was interrupted there.
void startRunFolder(const std::filesystem::path& folder, bool resume = false);

// Where two answers differ, bit by bit (a NaN equals a NaN): "repeat 2 differs: HitDepth at 3 values, first at (4, 5)".
// Empty when they do not.
std::string describeDifference(std::span<const Plane> first, std::span<const Plane> again, int repeat);

// Writes beside the target and renames, so that a file is whole or absent. Throws EnvironmentError.
void writeFileWhole(const std::filesystem::path& file, std::string_view content);

} // namespace crossray
