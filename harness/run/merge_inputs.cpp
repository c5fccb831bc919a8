#include "harness/run/merge_inputs.h"

#include "harness/run/run_plan.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>

namespace crossray {

namespace fs = std::filesystem;

namespace {

constexpr size_t kNamesInError = 10;

// "a, b and 3 more".
std::string listSome(const std::vector<std::string>& items)
{
    const size_t shown = std::min(items.size(), kNamesInError);
    std::string text = fmt::format("{}", fmt::join(items.begin(), items.begin() + static_cast<ptrdiff_t>(shown), ", "));
    if (shown < items.size()) text += fmt::format(" and {} more", items.size() - shown);
    return text;
}

// What the arguments mean: the shards in a folder, where it has some, else the run that the folder or file is.
std::vector<fs::path> listAttempts(std::span<const fs::path> inputs)
{
    std::vector<fs::path> attempts;
    for (const fs::path& input : inputs) {
        std::error_code failure;
        const fs::path named = input.filename().empty() ? input.parent_path() : input;
        const bool isAttempt = parseAttemptFolder(named.filename().string()).has_value();
        std::vector<fs::path> found;
        if (!isAttempt && fs::is_directory(named, failure)) found = findAttemptFolders(named);
        if (found.empty()) {
            if (!fs::exists(findRunJson(named), failure)) {
                throw InputError({named.string(), 0, 0},
                                 "there is neither a run.json nor a shard-I-of-N.NAME folder; allowed are folders that "
                                 "hold shards, runs' folders and run.json files");
            }
            found.push_back(named);
        }
        for (const fs::path& path : found) {
            const fs::path canonical = fs::weakly_canonical(path, failure);
            const auto isSame = [&](const fs::path& other) {
                return fs::weakly_canonical(other, failure) == canonical;
            };
            if (std::none_of(attempts.begin(), attempts.end(), isSame)) attempts.push_back(path);
        }
    }
    return attempts;
}

// Inputs are left out: on another kind of processor their last bits may be others.
uint64_t hashVerdicts(const CaseResult& testCase)
{
    std::string text;
    for (const BackendResult& result : testCase.backends)
        text += fmt::format("{}={} ", result.backend, nameOf(result.verdict));
    return computeStableHash(text);
}

void readCases(ShardRun& shard)
{
    shard.cases.reserve(shard.file->cases().size());
    for (const std::string_view text : shard.file->cases()) {
        CaseResult bare = shard.file->parseBare(text);
        addToCounts(shard.counts, bare);
        const bool hasFailed =
            std::any_of(bare.backends.begin(), bare.backends.end(),
                        [](const BackendResult& backend) { return tallyOf(backend.verdict) == Tally::kFailed; });
        const uint64_t verdicts = hashVerdicts(bare);
        const bool hasFiles = !listFilesOf(bare).empty();
        shard.cases.push_back({std::move(bare.name), text, verdicts, hasFailed, hasFiles});
        if (shard.cases.size() % kCasesBetweenReleases == 0) shard.file->release();
    }
    std::sort(shard.cases.begin(), shard.cases.end(),
              [](const ShardCase& a, const ShardCase& b) { return a.name < b.name; });
    shard.file->release();
}

class Reader {
  public:
    explicit Reader(bool isPartial) : isPartial_(isPartial) {}

    MergeInputs read(std::span<const fs::path> inputs)
    {
        for (const fs::path& attempt : listAttempts(inputs))
            addAttempt(attempt);
        if (attempts_.empty()) {
            throw InputError(fmt::format("no shard is whole: {}", listSome(result_.notes)));
        }
        checkPlans();
        chooseAttempts();
        checkUnion();
        return std::move(result_);
    }

  private:
    const RunResult& headOf(const ShardRun& shard) const { return shard.file->head(); }

    void leaveOut(const fs::path& folder, const std::string& reason)
    {
        result_.notes.push_back(fmt::format("{} is left out: {}", folder.string(), reason));
    }

    void addAttempt(const fs::path& folder)
    {
        const auto named = parseAttemptFolder(folder.filename().string());
        if (named && named->isPart) return leaveOut(folder, "it has not ended, or not well");
        ShardRun shard;
        shard.folder = findRunJson(folder).parent_path();
        shard.file = std::make_unique<RunFile>(folder);
        const RunResult& head = headOf(shard);
        if (const std::string reason = whyNotWhole(head); !reason.empty()) return leaveOut(folder, reason);
        if (!head.missingParts.empty()) return leaveOut(folder, "it was merged without all of its shards");
        if (head.plan.hash.empty()) return leaveOut(folder, "it has no plan: an older version wrote it");
        if (!head.shard.empty()) shard.shard = Shard::parse(head.shard);
        attempts_.push_back(std::move(shard));
    }

    // All must be parts of one run; the first decides which.
    void checkPlans() const
    {
        const ShardRun& first = attempts_.front();
        for (const ShardRun& other : attempts_) {
            const std::vector<std::string> differences = comparePlans(headOf(first).plan, headOf(other).plan);
            if (differences.empty() && other.shard.count == first.shard.count) continue;
            throw InputError(fmt::format("{} is no part of the run of {}: {}", other.folder.string(),
                                         first.folder.string(), fmt::join(differences, "; ")));
        }
    }

    void chooseAttempts()
    {
        // Of several whole ones the first that was started; their names decide where the second is the same.
        std::stable_sort(attempts_.begin(), attempts_.end(), [&](const ShardRun& a, const ShardRun& b) {
            const RunResult &headA = headOf(a), &headB = headOf(b);
            return std::tie(a.shard.index, headA.started, headA.attempt) <
                   std::tie(b.shard.index, headB.started, headB.attempt);
        });
        const int count = attempts_.front().shard.count;
        for (ShardRun& attempt : attempts_) {
            readCases(attempt);
            if (!result_.shards.empty() && result_.shards.back().shard == attempt.shard) {
                checkSame(result_.shards.back(), attempt);
                leaveOut(attempt.folder,
                         fmt::format("{} is the same shard, and agrees", result_.shards.back().folder.string()));
                continue;
            }
            checkNumber(attempt);
            result_.shards.push_back(std::move(attempt));
        }
        std::set<int> there;
        for (const ShardRun& shard : result_.shards)
            there.insert(shard.shard.index);
        for (int index = 1; index <= count; ++index) {
            if (!there.contains(index)) result_.missing.push_back(Shard{index, count}.format());
        }
        if (!result_.missing.empty() && !isPartial_) {
            std::string text = fmt::format("{} of {} shards {} missing: {}", result_.missing.size(), count,
                                           result_.missing.size() == 1 ? "is" : "are", listSome(result_.missing));
            for (const std::string& note : result_.notes)
                text += "; " + note;
            throw InputError(text + "; --partial merges the others");
        }
    }

    void checkNumber(const ShardRun& shard) const
    {
        const RunResult& head = headOf(shard);
        const uint64_t held = shard.cases.size() + head.unchanged.size();
        if (held == head.plan.ownCases) return;
        throw InputError({shard.file->name(), 0, 0}, fmt::format("has {} of its {} cases", held, head.plan.ownCases));
    }

    void checkSame(const ShardRun& taken, const ShardRun& other) const
    {
        std::map<std::string_view, const ShardCase*> byName;
        for (const ShardCase& testCase : taken.cases)
            byName[testCase.name] = &testCase;
        std::vector<std::string> conflicts;
        for (const ShardCase& testCase : other.cases) {
            const auto found = byName.find(testCase.name);
            if (found == byName.end() || found->second->verdicts != testCase.verdicts)
                conflicts.push_back(testCase.name);
            if (found != byName.end()) byName.erase(found);
        }
        for (const auto& [name, testCase] : byName)
            conflicts.emplace_back(name);
        if (conflicts.empty()) return;
        throw InputError(fmt::format("{} and {} are attempts of shard {} and differ in the verdicts of {}; "
                                     "name the one that counts, or remove the other",
                                     taken.folder.string(), other.folder.string(), taken.shard.format(),
                                     listSome(conflicts)));
    }

    // Each case once, and all of them.
    void checkUnion() const
    {
        std::vector<std::string> names;
        for (const ShardRun& shard : result_.shards) {
            for (const ShardCase& testCase : shard.cases)
                names.push_back(testCase.name);
            const auto& unchanged = headOf(shard).unchanged;
            names.insert(names.end(), unchanged.begin(), unchanged.end());
        }
        std::sort(names.begin(), names.end());
        std::vector<std::string> doubled;
        for (size_t i = 1; i < names.size(); ++i) {
            if (names[i] == names[i - 1] && (doubled.empty() || doubled.back() != names[i]))
                doubled.push_back(names[i]);
        }
        if (!doubled.empty()) throw InputError(fmt::format("several shards hold {}", listSome(doubled)));
        if (!result_.missing.empty()) return;
        const RunPlan& plan = headOf(result_.shards.front()).plan;
        if (names.size() != plan.cases || hashNames(names) != plan.names) {
            throw InputError(
                fmt::format("the shards hold {} cases that are not the {} of the plan", names.size(), plan.cases));
        }
    }

    bool isPartial_;
    std::vector<ShardRun> attempts_; // whole ones
    MergeInputs result_;
};

} // namespace

std::vector<std::string> listFilesOf(const CaseResult& testCase)
{
    std::vector<std::string> files{testCase.expectedFile};
    if (testCase.conditioning) files.push_back(testCase.conditioning->file);
    for (const BackendResult& result : testCase.backends) {
        files.push_back(result.planesFile);
        files.push_back(result.traceFile);
    }
    std::erase(files, "");
    return files;
}

MergeInputs readMergeInputs(std::span<const fs::path> inputs, bool isPartial)
{
    return Reader(isPartial).read(inputs);
}

} // namespace crossray
