// Which of a library's planted bugs do the cases catch? Each mutant's programs are made in memory and run by the cases
// that reach it, until one of them fails.
#pragma once

#include "harness/case/case.h"
#include "harness/mutate/library.h"
#include "harness/mutate/mutation.h"
#include "harness/run/worker_pool.h"

#include <atomic>
#include <functional>
#include <string>
#include <vector>

namespace crossray {

enum class MutantEnd {
    kCaught,
    kSurvived,
    kEquivalent, // listed as such, with a reason
    kSameCode,   // the optimised SPIR-V of every variant that reaches it is the same
    kUnreached,  // no variant of any case has code of the function
    kNoCompile,  // is no program
};
std::string_view nameOf(MutantEnd end);

// A case whose output a surviving mutant changed, though not beyond the tolerance.
struct SeenDifference {
    std::string testCase, output, tolerance, unit;
    size_t pixels = 0;            // that differ in any bit
    double before = 0, after = 0; // the largest error against the expectation
};

struct MutantResult {
    Mutation mutation;
    MutantEnd end = MutantEnd::kSurvived;
    std::string caughtBy;             // case
    std::string how;                  // "fail", "timeout", "crash", "error"
    std::string reason;               // one line
    std::vector<SeenDifference> seen; // of a survivor: the three cases with the most pixels
    size_t asked = 0;                 // cases that ran
    size_t reached = 0;               // cases whose variants reach the function
    double seconds = 0;
    bool isOld = false; // caught by an earlier hunt, and not asked again
};

struct CaseScore {
    std::string name;
    size_t kills = 0, asked = 0;
    std::string leftOut; // why it takes no part; empty where it does
    bool isIdle = false; // catches none of the mutants that it was asked about; only where that was looked for
};

struct HuntOptions {
    std::string backend = "lavapipe";
    int threads = 1;
    // For cases that were never the first to catch anything: so many caught mutants are tried on each before it counts
    // as idle. 0: not looked for.
    int idleTries = 0;
    size_t askAtMost =
        0; // cases a mutant, the likeliest first, after which it counts as survived; 0: all that reach it
    std::function<bool(const Mutation&)> isEquivalent; // empty: none is
    // What an earlier hunt tells of a mutant that it caught; empty or nullptr: it is asked about.
    std::function<const MutantResult*(const Mutation&)> findCaught;
    // One at a time, from any thread: each mutant; then each set of programs whose cases have been looked at for idle
    // ones.
    std::function<void(const MutantResult&, size_t done, size_t all)> report;
    std::function<void(size_t done, size_t all)> reportIdle;
};

struct HuntResult {
    std::vector<MutantResult> mutants; // in the order in which they were given
    std::vector<CaseScore> cases;
    double seconds = 0;
    Fingerprint fingerprint;
};

// Only expectations with data of their own count: an agreement of backends says nothing about a bug that all of them
// run. Throws EnvironmentError where the backend has no device.
HuntResult hunt(MutantLibrary& library, const std::vector<Case>& cases, const std::vector<Mutation>& mutations,
                const HuntOptions& options);

} // namespace crossray
