#include "harness/run/plan.h"

#include "harness/expect/expect.h"
#include "harness/run/content_hashes.h"
#include "harness/run/run_plan.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

namespace crossray {

namespace fs = std::filesystem;

namespace {

// Reads each file once, however many arguments mean it.
class CaseFiles {
  public:
    struct Entry {
        std::vector<Case> cases;
        std::optional<BrokenFile> broken;
    };

    const Entry& read(const fs::path& file)
    {
        const fs::path key = fs::weakly_canonical(file);
        const auto [place, isNew] = entries_.try_emplace(key);
        if (!isNew) return place->second;
        try {
            std::vector<Case> cases = readCaseFile(file);
            for (const Case& testCase : cases)
                checkSources(testCase);
            place->second.cases = std::move(cases);
        } catch (const InputError& error) {
            place->second.broken = BrokenFile{file, error.what()};
        }
        return place->second;
    }

    // What follows is not likely to need it, and its cases take memory.
    void forget(const fs::path& file) { entries_.erase(fs::weakly_canonical(file)); }

  private:
    std::map<fs::path, Entry> entries_;
};

// Paths are shown, and matched by globs, as a person would type them here.
fs::path shortenPath(const fs::path& path)
{
    std::error_code failure;
    const fs::path relative = fs::proximate(path, failure);
    const bool leavesHere = relative.begin() != relative.end() && *relative.begin() == "..";
    return failure || relative.empty() || leavesHere ? path : relative;
}

bool matchesName(const std::string& argument, const Case& testCase)
{
    const std::string& name = testCase.name;
    if (name == argument) return true;
    if (isGlob(argument) && matchesGlob(argument, name)) return true;
    if (!name.starts_with(argument)) return false;
    return argument.ends_with('/') || name[argument.size()] == '/' || name[argument.size()] == '[';
}

// Of "path/a.toml[ior=1.5]" where the path ends, which is a file; else 0.
size_t findFileOfSubCase(const std::string& argument)
{
    const size_t end = argument.find(".toml[") + 5;
    std::error_code failure;
    if (end == std::string::npos + 5 || !argument.ends_with(']')) return 0;
    return fs::is_regular_file(argument.substr(0, end), failure) ? end : 0;
}

size_t computeEditDistance(std::string_view a, std::string_view b)
{
    std::vector<size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), size_t{0});
    for (size_t i = 0; i < a.size(); ++i) {
        size_t diagonal = row[0];
        row[0] = i + 1;
        for (size_t j = 0; j < b.size(); ++j) {
            const size_t substituted = diagonal + (a[i] == b[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({substituted, row[j] + 1, diagonal + 1});
        }
    }
    return row[b.size()];
}

std::string describeUnmatched(const std::string& argument, const std::vector<std::string>& names)
{
    if (isGlob(argument)) return fmt::format("no case matches \"{}\"", argument);
    std::string nearest;
    size_t smallest = std::max<size_t>(3, argument.size() / 2);
    for (const std::string& name : names) {
        const std::string_view lastPart = std::string_view(name).substr(name.rfind('/') + 1);
        const size_t distance = std::min(computeEditDistance(argument, name), computeEditDistance(argument, lastPart));
        if (distance < smallest) {
            smallest = distance;
            nearest = name;
        }
    }
    if (nearest.empty()) return fmt::format("no case is called \"{}\"; crossray list shows all", argument);
    return fmt::format("no case is called \"{}\"; the nearest is \"{}\"", argument, nearest);
}

class Planner {
  public:
    Planner(const Selection& selection, fs::path caseRoot) : selection_(selection), caseRoot_(std::move(caseRoot)) {}

    PlanResult make()
    {
        if (selection_.arguments.empty()) {
            addFolder(caseRoot_);
        } else {
            for (const std::string& argument : selection_.arguments)
                addArgument(argument);
        }
        result_.plan.common = describeSelection(selected_);
        result_.plan.common.partition = "whole";
        return std::move(result_);
    }

  private:
    void addArgument(const std::string& argument)
    {
        std::error_code failure;
        if (fs::is_directory(argument, failure)) return addFolder(argument);
        if (fs::exists(argument, failure)) return addFile(argument);
        if (const size_t end = findFileOfSubCase(argument); end > 0) {
            return addSubCase(argument.substr(0, end), argument.substr(end));
        }
        if (argument.ends_with(".toml") && !isGlob(argument)) {
            throw InputError(
                fmt::format("{}: there is no such file; allowed are case files, folders, names and globs", argument));
        }
        addName(argument);
    }

    void addFolder(const fs::path& folder)
    {
        for (const fs::path& file : findCaseFiles(folder))
            addFile(file);
    }

    void addFile(const fs::path& file)
    {
        const CaseFiles::Entry& entry = files_.read(shortenPath(file));
        if (entry.broken) addBroken(*entry.broken);
        for (const Case& testCase : entry.cases)
            addCase(testCase);
        files_.forget(shortenPath(file));
    }

    void addSubCase(const fs::path& file, const std::string& parameters)
    {
        const CaseFiles::Entry& entry = files_.read(shortenPath(file));
        if (entry.broken) return addBroken(*entry.broken);
        std::vector<std::string> names;
        for (const Case& testCase : entry.cases) {
            const size_t bracket = testCase.name.find('[');
            const std::string own = bracket == std::string::npos ? "" : testCase.name.substr(bracket);
            if (own == parameters) return addCase(testCase);
            names.push_back(file.string() + own);
        }
        result_.unmatched.push_back(
            fmt::format("no case of {} has {}; it has {}", file.string(), parameters, fmt::join(names, ", ")));
    }

    void addName(const std::string& argument)
    {
        bool found = false;
        std::vector<std::string> names;
        std::vector<const BrokenFile*> broken;
        for (const fs::path& path : findCaseFiles(caseRoot_)) {
            const fs::path file = shortenPath(path);
            const CaseFiles::Entry& entry = files_.read(file);
            if (entry.broken) broken.push_back(&*entry.broken);
            const bool fileMatches = isGlob(argument) && matchesGlob(argument, file.generic_string());
            for (const Case& testCase : entry.cases) {
                names.push_back(testCase.name);
                if (!fileMatches && !matchesName(argument, testCase)) continue;
                found = true;
                addCase(testCase);
            }
            if (fileMatches && entry.broken) {
                found = true;
                addBroken(*entry.broken);
            }
        }
        if (found) return;
        // The name may be in a file that cannot be read.
        for (const BrokenFile* file : broken)
            addBroken(*file);
        result_.unmatched.push_back(describeUnmatched(argument, names));
    }

    void addBroken(const BrokenFile& broken)
    {
        const auto same = [&](const BrokenFile& other) { return other.file == broken.file; };
        auto& list = result_.plan.broken;
        if (std::none_of(list.begin(), list.end(), same)) list.push_back(broken);
    }

    void addCase(const Case& testCase)
    {
        const fs::path* const file = &*filesOfCases_.insert(testCase.file).first;
        const auto [place, isNew] = fileOfName_.try_emplace(testCase.name, file);
        if (!isNew) {
            if (place->second == file) return; // meant by two arguments
            throw InputError(testCase.position, fmt::format("the name \"{}\" is taken by {}; names are unique",
                                                            testCase.name, place->second->string()));
        }
        if (!passesFilters(testCase)) return;
        selected_.emplace(testCase.name, contents_.hashFilesOf(testCase));
        if (!isForeign(testCase)) result_.plan.cases.push_back(testCase);
    }

    // Of another part: its name and hash are all that this one needs, and of millions of cases all that it holds.
    bool isForeign(const Case& testCase) const
    {
        return selection_.shard && !selection_.timings &&
               findPartByName(testCase.name, selection_.shard->count) != selection_.shard->index;
    }

    bool passesFilters(const Case& testCase) const
    {
        if (selection_.names && !selection_.names->contains(testCase.name)) return false;
        if (selection_.expression && !selection_.expression->matches(testCase)) return false;
        if (selection_.tags.empty()) return true;
        return std::any_of(selection_.tags.begin(), selection_.tags.end(), [&](const std::string& tag) {
            return std::find(testCase.tags.begin(), testCase.tags.end(), tag) != testCase.tags.end();
        });
    }

    const Selection& selection_;
    fs::path caseRoot_;
    CaseFiles files_;
    std::set<fs::path> filesOfCases_;
    std::map<std::string, const fs::path*> fileOfName_;
    ContentHashes contents_;
    std::map<std::string, Hash128> selected_; // and what their files say
    PlanResult result_;
};

} // namespace

namespace {

// Leaves the shard's part of the cases. All shards see the same cases, and so find the same parts.
void takePart(Plan& plan, const Shard& shard, const std::optional<Timings>& timings)
{
    std::vector<std::string> names;
    std::vector<int> parts;
    if (timings) {
        for (const Case& testCase : plan.cases)
            names.push_back(testCase.name);
        parts = findPartsByTime(names, *timings, shard.count);
        std::vector<Case> own;
        for (size_t i = 0; i < parts.size(); ++i) {
            if (parts[i] == shard.index) own.push_back(std::move(plan.cases[i]));
        }
        plan.cases = std::move(own);
    }
    plan.common.partition = describePartition(names, parts, shard.count, timings.has_value());
    plan.common.ownCases = plan.cases.size();
}

} // namespace

PlanResult makePlan(const Selection& selection, const fs::path& caseRoot)
{
    PlanResult result = Planner(selection, caseRoot).make();
    if (selection.shard) takePart(result.plan, *selection.shard, selection.timings);
    return result;
}

} // namespace crossray
