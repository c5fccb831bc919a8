#include "harness/mutate/hunt.h"

#include "harness/base/error.h"
#include "harness/base/stopwatch.h"
#include "harness/mutate/asked_case.h"
#include "harness/mutate/case_odds.h"
#include "harness/run/case_flight.h"

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <deque>
#include <map>
#include <set>
#include <thread>

#include <sys/types.h>

namespace crossray {

std::string_view nameOf(MutantEnd end)
{
    switch (end) {
    case MutantEnd::kCaught:
        return "caught";
    case MutantEnd::kSurvived:
        return "survived";
    case MutantEnd::kEquivalent:
        return "equivalent";
    case MutantEnd::kSameCode:
        return "same code";
    case MutantEnd::kUnreached:
        return "unreached";
    case MutantEnd::kNoCompile:
        return "does not compile";
    }
    return "";
}

namespace {

// A worker keeps programs, and a driver's code for them: after so many it is replaced.
constexpr size_t kProgramsAWorker = 250;
constexpr size_t kSeenKept = 3;
// Groups of programs that are compiled, the likeliest first, for a function that left no line in any.
constexpr int kMostWithoutLines = 12;
// Mutants that leave a case's code as it was, for each that it may be asked about, before its others are given up.
constexpr int kUnchangedATry = 8;

// Programs of one mutant, each made on first need.
class MutantPrograms {
  public:
    // `functions`: those that the change is in; `isInside`: in their own bodies, not in what they use.
    MutantPrograms(MutantLibrary& library, ChangedFile change, std::set<std::string> functions, bool isInside)
        : library_(library), name_(change.name), functions_(std::move(functions)), isInside_(isInside),
          mutant_(library, std::move(change))
    {
    }

    bool reaches(const ProgramKey& program)
    {
        if (!library_.closureOf(program).contains(name_)) return false;
        const std::set<std::string>& reach = library_.reachOf(program);
        return std::any_of(functions_.begin(), functions_.end(),
                           [&](const std::string& function) { return reach.contains(function); });
    }

    bool reachesAny(const std::vector<ProgramKey>& programs)
    {
        return std::any_of(programs.begin(), programs.end(), [&](const ProgramKey& one) { return reaches(one); });
    }

    // Nothing when none of the programs differs from the library's own.
    const std::vector<std::vector<uint32_t>>* of(size_t group, const std::vector<ProgramKey>& programs)
    {
        Made& made = made_[group];
        if (!made.done) {
            made.done = true;
            for (const ProgramKey& program : programs) {
                const std::vector<uint32_t>& own = library_.compile(program);
                const bool isHeld =
                    reaches(program) && (!trustsLines_ || !isInside_ || library_.holds(program, name_, functions_));
                isHeld_ = isHeld_ || isHeld;
                made.code.push_back(isHeld ? compile(program) : own);
                made.isChanged = made.isChanged || made.code.back() != own;
            }
        }
        return made.isChanged ? &made.code : nullptr;
    }
    bool isKnown(size_t group) const { return made_.contains(group); }
    // From now on the lines of the optimised code do not say what it holds: a function that only calls another leaves
    // none of its own.
    void distrustLines()
    {
        trustsLines_ = false;
        std::erase_if(made_, [](const auto& made) { return !made.second.isChanged; });
    }
    bool trustsLines() const { return trustsLines_; }
    // Whether the optimised code of any program so far holds what the change is in.
    bool isHeld() const { return isHeld_; }
    size_t count() const { return made_.size(); }

  private:
    const std::vector<uint32_t>& compile(const ProgramKey& program)
    {
        std::vector<uint32_t>& code = code_[program];
        if (code.empty()) code = mutant_.compile(program);
        return code;
    }

    struct Made {
        bool done = false, isChanged = false;
        std::vector<std::vector<uint32_t>> code;
    };
    MutantLibrary& library_;
    std::string name_;
    std::set<std::string> functions_;
    bool isInside_;
    bool isHeld_ = false;
    bool trustsLines_ = true;
    MutantLibrary::Mutant mutant_;
    std::map<ProgramKey, std::vector<uint32_t>> code_;
    std::map<size_t, Made> made_; // by group
};

class Hunt {
  public:
    Hunt(MutantLibrary& library, const std::vector<Case>& cases, const std::vector<Mutation>& mutations,
         const HuntOptions& options)
        : library_(library), mutations_(mutations), options_(options), pool_(makeWorkers(options)),
          programsMade_(static_cast<size_t>(options.threads), 0)
    {
        chooseCases(cases);
        result_.mutants.resize(mutations.size());
        result_.cases.resize(cases_.size());
        for (size_t i = 0; i < cases_.size(); ++i)
            result_.cases[i].name = cases_[i]->testCase().name;
        for (const std::string& name : library_.fileNames())
            texts_.push_back(library_.textOf(name));
        odds_ = std::make_unique<CaseOdds>(cases_.size());
    }

    HuntResult run()
    {
        Stopwatch watch;
        result_.fingerprint = pool_.fingerprint(options_.backend);
        onAllThreads(mutations_.size(), [&](size_t index, int core) { huntOne(index, core); });
        if (options_.idleTries > 0)
            onAllThreads(groups_.size(), [&](size_t group, int core) { findIdle(group, core); });
        result_.seconds = watch.lap() / 1000;
        return std::move(result_);
    }

  private:
    static WorkerOptions makeWorkers(const HuntOptions& options)
    {
        WorkerOptions workers; // without the driver's cache on disk: no mutant comes twice
        workers.cores = options.threads;
        return workers;
    }

    void chooseCases(const std::vector<Case>& cases)
    {
        std::vector<Case> used;
        for (const Case& testCase : cases) {
            if (runsOn(testCase, options_.backend)) used.push_back(testCase);
        }
        std::vector<Case> shared = shareOutputs(used);
        cases_.resize(used.size());
        onAllThreads(used.size(), [&](size_t i, int) {
            cases_[i] = std::make_unique<AskedCase>(used[i], std::move(shared[i]), library_);
        });
        for (const auto& asked : cases_) {
            const auto found = std::find(groups_.begin(), groups_.end(), asked->programs());
            groupOf_.push_back(static_cast<size_t>(found - groups_.begin()));
            if (found == groups_.end()) groups_.push_back(asked->programs());
        }
    }

    void onAllThreads(size_t count, const std::function<void(size_t, int)>& work)
    {
        std::atomic<size_t> next{0};
        std::exception_ptr failure;
        {
            std::vector<std::jthread> threads;
            for (int core = 0; core < options_.threads; ++core) {
                threads.emplace_back([&, core] {
                    try {
                        for (size_t index = next++; index < count; index = next++)
                            work(index, core);
                    } catch (...) {
                        const std::lock_guard lock(mutex_);
                        if (!failure) failure = std::current_exception();
                        next = count;
                    }
                });
            }
        }
        if (failure) std::rethrow_exception(failure);
    }

    // The functions whose code a mutation changes.
    std::set<std::string> functionsOf(const Mutation& mutation)
    {
        if (!mutation.function.empty()) return {mutation.function};
        const std::string constant = constantAt(library_.textOf(mutation.file), mutation);
        const std::lock_guard lock(usersMutex_);
        auto& users = users_[constant];
        if (users.empty()) {
            const std::vector<std::string> found = findUsers(texts_, constant);
            users.insert(found.begin(), found.end());
        }
        return users;
    }

    MutantPrograms makePrograms(const Mutation& mutation)
    {
        const std::string& text = library_.textOf(mutation.file);
        return {library_,
                {mutation.file, applyMutation(text, mutation)},
                functionsOf(mutation),
                !mutation.function.empty()};
    }

    std::vector<size_t> findCandidates(MutantPrograms& mutant)
    {
        std::vector<bool> groups;
        for (const auto& programs : groups_)
            groups.push_back(mutant.reachesAny(programs));
        std::vector<size_t> candidates;
        for (size_t i = 0; i < cases_.size(); ++i) {
            if (groups[groupOf_[i]]) candidates.push_back(i);
        }
        return candidates;
    }

    void huntOne(size_t index, int core)
    {
        Stopwatch watch;
        MutantResult& result = result_.mutants[index];
        result.mutation = mutations_[index];
        const bool isEquivalent = options_.isEquivalent && options_.isEquivalent(result.mutation);
        const MutantResult* const earlier =
            options_.findCaught && !isEquivalent ? options_.findCaught(result.mutation) : nullptr;
        if (isEquivalent) {
            result.end = MutantEnd::kEquivalent;
        } else if (earlier != nullptr) {
            takeOver(result, *earlier);
        } else {
            try {
                askCases(result, core);
            } catch (const ShaderError& error) {
                result.end = MutantEnd::kNoCompile;
                result.reason = withoutFolder(error.what());
            }
        }
        if (!result.isOld) result.seconds = watch.lap() / 1000;
        const std::lock_guard lock(mutex_);
        ++done_;
        if (options_.report) options_.report(result, done_, mutations_.size());
    }

    // The first line of a compiler's complaint, with files named from the folder that the shaders lie in: a table that
    // is published says nothing of the machine that made it.
    std::string withoutFolder(std::string_view complaint) const
    {
        std::string line(complaint.substr(0, complaint.find('\n')));
        const std::string folder =
            std::filesystem::absolute(library_.root()).lexically_normal().parent_path().string() + "/";
        for (size_t at = 0; (at = line.find(folder, at)) != std::string::npos;)
            line.erase(at, folder.size());
        return line;
    }

    void takeOver(MutantResult& result, const MutantResult& earlier)
    {
        const Mutation mutation = result.mutation;
        result = earlier;
        result.mutation = mutation;
        result.isOld = true;
        const auto by = std::find_if(result_.cases.begin(), result_.cases.end(),
                                     [&](const CaseScore& score) { return score.name == earlier.caughtBy; });
        if (by != result_.cases.end()) note(static_cast<size_t>(by - result_.cases.begin()), true);
    }

    void askCases(MutantResult& result, int core)
    {
        MutantPrograms programs = makePrograms(result.mutation);
        const std::vector<size_t> candidates = findCandidates(programs);
        result.reached = candidates.size();
        result.end = MutantEnd::kUnreached;
        if (candidates.empty()) return;
        std::set<size_t> likely;
        for (const size_t candidate : candidates) {
            if (cases_[candidate]->isAbout(result.mutation.file)) likely.insert(candidate);
        }
        askLikely(result, core, programs, candidates, likely);
        if (result.end == MutantEnd::kUnreached) {
            programs.distrustLines();
            askLikely(result, core, programs, candidates, likely);
            // A call that a constant decides, or that is left out, is in nobody's code.
            if (result.end == MutantEnd::kSameCode) result.end = MutantEnd::kUnreached;
        }
        replaceWorker(core, programs.count());
    }

    void askLikely(MutantResult& result, int core, MutantPrograms& programs, const std::vector<size_t>& candidates,
                   const std::set<size_t>& likely)
    {
        CaseOdds::Choice choice = odds_->start(result.mutation.file, result.mutation.function, candidates, likely);
        int unchanged = 0;
        while (const std::optional<size_t> next =
                   choice.next([&](size_t index) { return estimate(index, programs); })) {
            AskedCase& testCase = *cases_[*next];
            const auto* code = programs.of(groupOf_[*next], testCase.programs());
            if (code == nullptr) {
                if (result.end == MutantEnd::kUnreached && programs.isHeld()) result.end = MutantEnd::kSameCode;
                if (!programs.trustsLines() && ++unchanged == kMostWithoutLines) break;
                choice.dropIf([&](size_t index) { return groupOf_[index] == groupOf_[*next]; });
                continue;
            }
            result.end = MutantEnd::kSurvived;
            if (!isReady(*next, core)) continue;
            AskedCase::Finding finding = testCase.ask(*code, pool_, options_.backend, core);
            ++result.asked;
            note(*next, finding.isCaught);
            choice.note(*next, finding.isCaught);
            if (finding.isCaught) {
                result.end = MutantEnd::kCaught;
                result.caughtBy = testCase.testCase().name;
                result.how = finding.how;
                result.reason = finding.reason;
                result.seen.clear();
                break;
            }
            keepSeen(result.seen, std::move(finding.seen));
            if (result.asked == options_.askAtMost) break;
        }
    }

    // Milliseconds that asking the case is likely to take.
    double estimate(size_t index, const MutantPrograms& programs) const
    {
        constexpr double kCompileMs = 350, kPixelMs = 0.002, kSmallMs = 4;
        const double compile = programs.isKnown(groupOf_[index]) ? 0 : kCompileMs;
        return compile + kSmallMs + kPixelMs * cases_[index]->pixels();
    }

    bool isReady(size_t index, int core)
    {
        const std::string& why = cases_[index]->prepare(library_, pool_, options_.backend, core);
        if (why.empty()) return true;
        const std::lock_guard lock(mutex_);
        result_.cases[index].leftOut = why;
        return false;
    }

    void note(size_t index, bool isCaught)
    {
        const std::lock_guard lock(mutex_);
        ++result_.cases[index].asked;
        if (isCaught) ++result_.cases[index].kills;
    }

    static void keepSeen(std::vector<SeenDifference>& kept, std::vector<SeenDifference> more)
    {
        kept.insert(kept.end(), more.begin(), more.end());
        std::stable_sort(kept.begin(), kept.end(),
                         [](const SeenDifference& a, const SeenDifference& b) { return a.pixels > b.pixels; });
        if (kept.size() > kSeenKept) kept.resize(kSeenKept);
    }

    // Each thread has a worker of its own, so that it is at rest now.
    void replaceWorker(int core, size_t programs)
    {
        size_t& made = programsMade_[static_cast<size_t>(core)];
        made += programs;
        if (made < kProgramsAWorker) return;
        made = 0;
        pool_.restart(options_.backend, core);
    }

    // A case that was never the first to catch a mutant may catch one all the same. Those with the same programs are
    // asked together, since most of the time goes into making a mutant's.
    void findIdle(size_t group, int core)
    {
        std::vector<size_t> waiting;
        for (size_t i = 0; i < cases_.size(); ++i) {
            if (groupOf_[i] == group && result_.cases[i].kills == 0 && isReady(i, core)) waiting.push_back(i);
        }
        int tries = 0, unchanged = 0;
        for (size_t i = 0; i < result_.mutants.size() && !waiting.empty(); ++i) {
            if (tries == options_.idleTries || unchanged == options_.idleTries * kUnchangedATry) break;
            // Spread over the files.
            const MutantResult& mutant = result_.mutants[(i * 7919 + group * 104729) % result_.mutants.size()];
            if (mutant.end != MutantEnd::kCaught || mutant.how == "timeout") continue;
            MutantPrograms programs = makePrograms(mutant.mutation);
            if (!programs.reachesAny(groups_[group])) continue;
            const auto* code = programs.of(group, groups_[group]);
            if (code == nullptr) {
                ++unchanged;
                continue;
            }
            ++tries;
            std::erase_if(waiting, [&](size_t index) {
                const bool isCaught = cases_[index]->ask(*code, pool_, options_.backend, core).isCaught;
                note(index, isCaught);
                return isCaught;
            });
            replaceWorker(core, 1);
        }
        for (const size_t index : waiting)
            result_.cases[index].isIdle = tries > 0;
        const std::lock_guard lock(mutex_);
        ++groupsDone_;
        if (options_.reportIdle) options_.reportIdle(groupsDone_, groups_.size());
    }

    MutantLibrary& library_;
    const std::vector<Mutation>& mutations_;
    const HuntOptions& options_;
    WorkerPool pool_;
    std::vector<std::unique_ptr<AskedCase>> cases_;
    std::vector<size_t> groupOf_; // of each case: those with the same programs
    std::vector<std::vector<ProgramKey>> groups_;
    std::vector<size_t> programsMade_; // by core
    std::vector<std::string> texts_;
    std::mutex usersMutex_;
    std::map<std::string, std::set<std::string>> users_; // functions by the constant that they use
    std::unique_ptr<CaseOdds> odds_;
    std::mutex mutex_; // guards the cases' scores, and the reports
    size_t done_ = 0, groupsDone_ = 0;
    HuntResult result_;
};

} // namespace

HuntResult hunt(MutantLibrary& library, const std::vector<Case>& cases, const std::vector<Mutation>& mutations,
                const HuntOptions& options)
{
    return Hunt(library, cases, mutations, options).run();
}

} // namespace crossray
