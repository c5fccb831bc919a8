// Golden expectations: recorded only when a person accepts what a run computed.
#pragma once

#include "harness/backend/device.h"
#include "harness/case/case.h"
#include "harness/run/results.h"

#include <filesystem>
#include <string>
#include <vector>

namespace crossray {

// A golden expectation that a run found failed or without its file.
struct GoldenFailure {
    std::string caseName;
    std::string output;
    std::filesystem::path caseFile;
    SourcePosition position;
    std::vector<std::string> backends; // that failed
    std::string reason;                // of the first
    bool missing = false;
};
std::vector<GoldenFailure> listGoldenFailures(const RunResult& run);

// Records the goldens of one case from the planes that the run kept, by the backend named (empty: the first of the run
// that kept its planes), with a JSON sidecar that says which driver, version and CPU computed them, and when. Returns
// the files written. Throws InputError when the run kept no planes of the case or the case has no golden expectation.
std::vector<std::filesystem::path> acceptGoldens(const Case& testCase, const RunResult& run,
                                                 const std::filesystem::path& runFolder, const std::string& backend);

// In words, where a golden was recorded, if that was not under this fingerprint: by its sidecar. Empty where it was.
std::string describeGoldenOrigin(const std::filesystem::path& golden, const Fingerprint& here);

} // namespace crossray
