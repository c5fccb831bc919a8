#include "harness/run/merge.h"

#include "harness/run/junit.h"
#include "harness/run/merge_inputs.h"
#include "harness/run/plane_files.h"
#include "harness/run/run_json.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <queue>
#include <set>

namespace crossray {

namespace fs = std::filesystem;

namespace {

std::map<std::string, std::string> describeDevices(const RunResult& head)
{
    std::map<std::string, std::string> devices;
    for (const auto& [name, record] : head.backends) {
        const Fingerprint& print = record.fingerprint;
        devices[name] = fmt::format("{}, {}, {}, {}", print.device, print.driver, print.api, print.cpu);
    }
    return devices;
}

void addCounts(RunCounts& sum, const RunCounts& counts)
{
    for (const auto& [verdict, count] : counts.byVerdict)
        sum.byVerdict[verdict] += count;
    sum.passed += counts.passed;
    sum.failed += counts.failed;
    sum.skipped += counts.skipped;
}

void addBackends(RunResult& run, const RunResult& head)
{
    for (const auto& [name, record] : head.backends) {
        const auto [place, isNew] = run.backends.try_emplace(name, record);
        if (!isNew) place->second.startMs = std::max(place->second.startMs, record.startMs);
    }
}

// The head of the whole run: what all shards have in common, and sums, where sums mean something.
RunResult mergeHeads(const MergeInputs& inputs)
{
    RunResult run = inputs.shards.front().file->head();
    run.shard.clear();
    run.attempt.clear();
    run.parts.clear();
    run.backends.clear();
    run.cores = 0;
    run.plan.ownCases = 0;
    run.plan.partition = "whole";
    run.missingParts = inputs.missing;
    std::set<std::string> broken, unchanged;
    RunCounts counts;
    for (const ShardRun& shard : inputs.shards) {
        const RunResult& head = shard.file->head();
        if (head.commit != run.commit) run.commit.clear();
        if (head.seed != run.seed) run.seed.reset();
        run.modified = run.modified || head.modified;
        run.started = std::min(run.started, head.started);
        run.seconds = std::max(run.seconds, head.seconds);
        if (run.firstVerdictMs < 0 || (head.firstVerdictMs >= 0 && head.firstVerdictMs < run.firstVerdictMs))
            run.firstVerdictMs = head.firstVerdictMs;
        run.cores += head.cores;
        run.toolPeakBytes = std::max(run.toolPeakBytes, head.toolPeakBytes);
        run.workersPeakBytes = std::max(run.workersPeakBytes, head.workersPeakBytes);
        run.plan.ownCases += head.plan.ownCases;
        broken.insert(head.brokenFiles.begin(), head.brokenFiles.end());
        unchanged.insert(head.unchanged.begin(), head.unchanged.end());
        addBackends(run, head);
        addCounts(counts, shard.counts);
        run.parts.push_back({shard.shard.format(), head.attempt, head.started, head.seconds, shard.cases.size(),
                             describeDevices(head)});
    }
    run.brokenFiles.assign(broken.begin(), broken.end());
    run.unchanged.assign(unchanged.begin(), unchanged.end());
    run.countsOfAll = counts;
    run.exitCode = static_cast<int>(computeExitCode(run));
    return run;
}

// Arithmetic may differ in last bits between kinds of processors and drivers, and a verdict with it.
std::vector<std::string> describeMixture(const RunResult& run)
{
    std::map<std::string, std::set<std::string>> kinds;
    for (const MergedPart& part : run.parts) {
        for (const auto& [backend, device] : part.devices)
            kinds[backend].insert(device);
    }
    std::vector<std::string> notes;
    for (const auto& [backend, devices] : kinds) {
        if (devices.size() > 1)
            notes.push_back(
                fmt::format("{} ran on {} kinds of machine: {}", backend, devices.size(), fmt::join(devices, "; ")));
    }
    return notes;
}

class Merger {
  public:
    Merger(const MergeOptions& options, const MergeInputs& inputs) : options_(options), inputs_(inputs) {}

    MergedRun merge(const std::vector<std::string>& commandLine)
    {
        merged_.run = mergeHeads(inputs_);
        merged_.run.commandLine = commandLine;
        merged_.notes = inputs_.notes;
        for (std::string& note : describeMixture(merged_.run))
            merged_.notes.push_back(std::move(note));
        for (const ShardRun& shard : inputs_.shards)
            merged_.cases += shard.cases.size();
        startRunFolder(options_.output);
        JunitWriter junit(merged_.run.started);
        writeRunJson(junit);
        if (!options_.junit.empty()) writeFileWhole(options_.junit, junit.finish());
        return std::move(merged_);
    }

  private:
    // The shards are in order of name each; the least of their next cases is the next of all.
    template <typename Visit>
    void visitInOrder(const Visit& visit) const
    {
        struct Next {
            const ShardRun* shard;
            size_t index;
            const ShardCase& testCase() const { return shard->cases[index]; }
            bool operator>(const Next& other) const { return testCase().name > other.testCase().name; }
        };
        std::priority_queue<Next, std::vector<Next>, std::greater<>> queue;
        for (const ShardRun& shard : inputs_.shards) {
            if (!shard.cases.empty()) queue.push({&shard, 0});
        }
        while (!queue.empty()) {
            const Next next = queue.top();
            queue.pop();
            visit(*next.shard, next.testCase());
            if (next.index + 1 < next.shard->cases.size()) queue.push({next.shard, next.index + 1});
        }
    }

    void writeRunJson(JunitWriter& junit)
    {
        const fs::path file = options_.output / "run.json";
        fs::path aside = file;
        aside += fmt::format(".{}.tmp", getpid());
        std::ofstream stream(aside, std::ios::binary);
        try {
            writeCases(stream, junit);
        } catch (...) {
            fs::remove(aside);
            throw;
        }
        stream.close();
        std::error_code failure;
        if (stream) fs::rename(aside, file, failure);
        if (!stream || failure) {
            fs::remove(aside, failure);
            throw EnvironmentError(fmt::format("{}: cannot be written", file.string()));
        }
    }

    void writeCases(std::ostream& stream, JunitWriter& junit)
    {
        const RunJsonFrame frame = formatRunJsonFrame(merged_.run);
        stream << frame.before;
        size_t written = 0;
        visitInOrder([&](const ShardRun& shard, const ShardCase& testCase) {
            stream << (written++ == 0 ? "\n  " : ",\n  ") << testCase.text;
            useCase(shard, testCase, junit);
            if (written % kCasesBetweenReleases == 0) releaseFiles();
        });
        if (written > 0) stream << "\n ";
        stream << frame.after;
    }

    // What else is made of a case; it is parsed once more only where something is.
    void useCase(const ShardRun& shard, const ShardCase& testCase, JunitWriter& junit)
    {
        const bool isAtHand = merged_.cases <= options_.casesAtHand ||
                              (testCase.hasFailed && merged_.run.cases.size() < options_.casesAtHand);
        if (!isAtHand && !testCase.hasFiles && options_.junit.empty()) return;
        const bool needsAll = isAtHand || testCase.hasFailed;
        CaseResult result = needsAll ? shard.file->parse(testCase.text) : shard.file->parseBare(testCase.text);
        if (!options_.junit.empty()) junit.add(result);
        for (const std::string& file : listFilesOf(result))
            takeFile(shard, file);
        if (isAtHand) merged_.run.cases.push_back(std::move(result));
    }

    // Names of cases are names of folders, so the files of shards never meet.
    void takeFile(const ShardRun& shard, const std::string& file)
    {
        const fs::path relative = fs::path(file).lexically_normal();
        if (relative.is_absolute() || *relative.begin() == "..") {
            throw InputError({shard.file->name(), 0, 0}, fmt::format("names a file outside its folder: {}", file));
        }
        const fs::path source = shard.folder / relative, target = options_.output / relative;
        std::error_code failure;
        fs::create_directories(target.parent_path(), failure);
        // A second name costs no bytes; on another disk it takes a copy.
        fs::create_hard_link(source, target, failure);
        if (failure) fs::copy_file(source, target, fs::copy_options::overwrite_existing, failure);
        if (failure) {
            throw EnvironmentError(
                fmt::format("{}: cannot be copied to {}: {}", source.string(), target.string(), failure.message()));
        }
        const auto bytes = fs::file_size(target, failure);
        merged_.planesBytes += failure ? 0 : bytes;
    }

    void releaseFiles() const
    {
        for (const ShardRun& shard : inputs_.shards)
            shard.file->release();
    }

    const MergeOptions& options_;
    const MergeInputs& inputs_;
    MergedRun merged_;
};

// A run's folder is cleared before it is written to.
void checkOutput(const MergeOptions& options, const MergeInputs& inputs)
{
    for (const ShardRun& shard : inputs.shards) {
        std::error_code failure;
        if (!fs::equivalent(shard.folder, options.output, failure) || failure) continue;
        throw InputError(fmt::format("-o {}: is one of the runs to be merged", options.output.string()));
    }
}

} // namespace

MergedRun mergeRuns(const MergeOptions& options, const std::vector<std::string>& commandLine)
{
    const MergeInputs inputs = readMergeInputs(options.inputs, options.isPartial);
    checkOutput(options, inputs);
    return Merger(options, inputs).merge(commandLine);
}

} // namespace crossray
