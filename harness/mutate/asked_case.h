// A case that is asked whether it notices a change of the shaders.
#pragma once

#include "harness/mutate/hunt.h"
#include "harness/run/case_judge.h"

#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace crossray {

// Cases that differ in their outputs alone share their programs when all of them write all of those outputs.
std::vector<Case> shareOutputs(const std::vector<Case>& cases);

class AskedCase {
  public:
    // `widened` writes what `original` does, and more. Throws InputError for a broken case.
    AskedCase(const Case& original, Case widened, MutantLibrary& library);

    const Case& testCase() const { return original_; }
    const std::vector<ProgramKey>& programs() const { return programs_; }
    double pixels() const;
    // Whether it was written for this file of the library: its own tracer includes it.
    bool isAbout(const std::string& file) const { return included_.contains(file); }

    // Builds the job and asks for the answer of the library as it is: once, whoever comes first. Returns why the case
    // takes no part; empty where it does.
    const std::string& prepare(MutantLibrary& library, WorkerPool& pool, const std::string& backend, int core);
    double usualMs() const { return usualMs_; }

    struct Finding {
        bool isCaught = false;
        std::string how, reason;
        std::vector<SeenDifference> seen;
        double milliseconds = 0;
    };
    // The answer with other programs, in the order of programs(). Only after prepare().
    Finding ask(const std::vector<std::vector<uint32_t>>& programs, WorkerPool& pool, const std::string& backend,
                int core);

  private:
    struct Answer {
        std::string how; // empty: planes came back
        std::string reason;
        std::vector<Plane> planes;
        double milliseconds = 0;
    };
    Answer run(const Job& job, WorkerPool& pool, const std::string& backend, int core, double seconds) const;
    BackendResult judge(const std::string& backend, const std::vector<Plane>& planes);
    std::vector<SeenDifference> compare(const BackendResult& result, const std::vector<Plane>& planes) const;
    std::string makeReady(MutantLibrary& library, WorkerPool& pool, const std::string& backend, int core);

    Case original_, widened_;
    std::vector<ProgramKey> programs_;
    std::set<std::string> included_; // by its own tracer itself
    std::mutex making_;
    bool isReady_ = false;
    std::string leftOut_;
    std::shared_ptr<const CaseData> data_;
    std::optional<CaseJudge> judge_;
    Job job_;
    std::vector<Plane> planes_; // of the library as it is
    BackendResult result_;
    double usualMs_ = 0;
};

} // namespace crossray
