// Verdicts that are known already: of an earlier run by content, and of this run's own interrupted beginning. A kept
// result answers for a case only where all that it depends on is as it was: the program itself, the case's file, its
// presets and every file that it names, each shader file that its variants include, the devices' fingerprints, and the
// options that change an answer. Times in it are those of the run that made it.
#pragma once

#include "harness/base/hash.h"
#include "harness/case/case.h"
#include "harness/compile/cache.h"
#include "harness/run/content_hashes.h"
#include "harness/run/execute.h"
#include "harness/run/results.h"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace crossray {

// What of a run changes answers, beside cases, shaders and devices.
struct RunIdentity {
    Hash128 program; // content of the running program: harness, judge, and the shaders as C++
    bool validation = false;
    int repeat = 1;
};
Hash128 hashProgram();

// One case's results with what they depend on.
struct KeptResult {
    Hash128 key;                                // of case, options and program
    std::map<std::string, Hash128> shaders;     // by the path below the shader folder
    std::map<std::string, Fingerprint> devices; // by backend
    CaseResult result;
};
std::string encodeKept(const KeptResult& kept);              // one line of JSON
std::optional<KeptResult> decodeKept(std::string_view text); // nothing for what is no such line

// Keys and checks; shared by the two places that keep results. Thread-safe.
class KeptResults {
  public:
    KeptResults(RunIdentity identity, const std::filesystem::path& shaderRoot);

    Hash128 keyOf(const Case& testCase);
    KeptResult make(const Case& testCase, const CaseResult& result, std::span<const std::filesystem::path> shaderFiles,
                    const std::map<std::string, Fingerprint>& devices);
    // The kept result for these backends in their order, where it answers for them; a case that holds backends against
    // each other has to have been run on just these.
    std::optional<CaseResult> answer(const KeptResult& kept, const Case& testCase,
                                     std::span<const std::string> backends,
                                     const std::map<std::string, Fingerprint>& devices);

  private:
    RunIdentity identity_;
    std::filesystem::path shaderRoot_;
    ContentHashes hashes_;
};

// Results in the cache folder, for all later runs: those of cases that passed wherever they ran. What failed runs
// again, so that its planes and traces are there to be looked at.
class ResultCache {
  public:
    explicit ResultCache(const std::filesystem::path& folder) : folder_(folder), files_(folder) {}
    std::optional<KeptResult> find(const Hash128& key) const;
    void store(const KeptResult& kept) const; // only where it is to be kept
    bool isEmpty() const;

  private:
    std::filesystem::path folder_;
    FileCache files_;
};

// Results of one run as they come, OUT/finished.jsonl: what an interrupted run has finished, failures too.
class RunJournal {
  public:
    // Starts anew, or goes on after what is there. Throws EnvironmentError.
    RunJournal(const std::filesystem::path& runFolder, bool resume);
    std::optional<KeptResult> find(const std::string& caseName) const; // of the run that is resumed
    void add(const KeptResult& kept);                                  // thread-safe; on disk when it returns
    static std::filesystem::path fileOf(const std::filesystem::path& runFolder);

  private:
    std::map<std::string, KeptResult> earlier_;
    std::mutex mutex_;
    std::ofstream stream_;
};

// Where a run's results come from and go to beside its devices.
struct ResultMemory {
    KeptResults& kept;
    RunJournal& journal;
    const ResultCache* cache = nullptr; // null: neither asked nor added to
    bool recalls = true;                // false: the cache is added to and not asked, since planes are wanted
    bool resumes = false;
};
// Sets the steps' recall and keep; all that `memory` refers to outlives them.
void remember(const ResultMemory& memory, std::span<const std::string> backends, ExecuteSteps& steps);

} // namespace crossray
