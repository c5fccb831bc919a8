// What must hold of any case on any backend, and the smallest case of which it does not.
#pragma once

#include "tests/fuzz/case_generator.h"

#include "harness/base/temporary_folder.h"
#include "harness/compile/compile.h"
#include "harness/run/worker_pool.h"

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace crossray {

enum class FindingKind {
    kNotFinite,  // an output holds a NaN, or what no float holds
    kRange,      // a weight or a share outside of [0, 1], a class or count that is none
    kIterations, // more than the settings allow
    kClass,      // hit, miss or unknown by backend, where the question can be decided (harness/run/conditioning.h)
    kNoAnswer,   // a crash, a time-out, a shader that a driver refuses
};

struct Finding {
    FindingKind kind = FindingKind::kNotFinite;
    std::string backend;
    std::string output;
    std::string text; // one line with backend, output, pixel and value
    double bound = 0; // of iterations
};

struct CaseOutcome {
    std::string refused;          // what the harness said about an input that it does not take; empty where it ran
    size_t pixels = 0;            // that trace
    size_t differingPixels = 0;   // whose class is not cpu64's on some backend
    size_t undecidablePixels = 0; // of those: the ones whose class an ulp of input changes, too
    std::vector<std::pair<std::string, double>> asked; // backends that answered, seconds
    std::optional<Finding> finding;
};

class CaseFuzzer {
  public:
    struct Options {
        std::filesystem::path shaders, cache;
        std::string executable; // of the workers
        int cores = 1;
    };
    explicit CaseFuzzer(Options options);

    // One file and one set of workers a core; the file is no other process's, so that several may run side by side.
    std::filesystem::path scratchFile(int core) const;
    // `backends` are asked beside cpu64 and cpu32.
    CaseOutcome check(const Node& root, int core, std::span<const std::string> backends);
    // Follows the shrinks for as long as one fails in the same way, `budget` checks at most.
    // `finding` becomes that of the smallest.
    Node minimize(const rc::Shrinkable<Node>& failing, Finding& finding, int core,
                  std::span<const std::string> backends, int budget);

  private:
    struct Subject { // one case on its way through the backends
        const CaseData& data;
        Job floatJob, doubleJob;
        int core;
    };
    struct Classes { // HitSuccess by pixel
        std::string backend;
        std::vector<double> values;
    };

    std::vector<Plane> ask(const Subject& subject, const std::string& backend, const Job& job); // throws Error
    std::vector<Classes> askAll(const Subject& subject, std::span<const std::string> backends, CaseOutcome& outcome);
    void compareClasses(const Subject& subject, const std::vector<Classes>& classes, CaseOutcome& outcome);

    Options options_;
    TemporaryFolder scratch_{"fuzz"};
    ShaderCompiler compiler_;
    WorkerPool pool_;
};

// The case held to what was found, as `crossray run` takes it; classes are compared on `backends`, the last one's
// counting.
std::string formatFinding(const Node& root, const Finding& finding, const std::string& name,
                          const std::vector<std::string>& backends);

} // namespace crossray
