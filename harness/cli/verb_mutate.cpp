#include "harness/cli/verbs.h"
#include "harness/mutate/earlier_hunt.h"
#include "harness/mutate/equivalent.h"
#include "harness/mutate/hunt_report.h"
#include "harness/run/environment.h"
#include "harness/run/plane_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <random>

namespace crossray {

namespace {

namespace fs = std::filesystem;

// The files that the options mean; those of the library without one.
std::vector<std::string> chooseFiles(const MutantLibrary& library, const std::vector<std::string>& wanted)
{
    std::vector<std::string> files;
    for (const std::string& given : wanted.empty() ? std::vector<std::string>{"crossray"} : wanted) {
        // As the library has it, or as a path that leads there.
        const fs::path absolute = fs::absolute(given).lexically_normal().lexically_relative(library.root());
        const bool isPath = !absolute.empty() && *absolute.begin() != "..";
        std::string name = isPath ? absolute.generic_string() : fs::path(given).lexically_normal().generic_string();
        while (name.ends_with('/'))
            name.pop_back();
        const size_t before = files.size();
        for (const std::string& file : library.fileNames()) {
            if (file == name || file.starts_with(name + "/")) files.push_back(file);
        }
        if (files.size() == before) {
            throw InputError({given}, fmt::format("there is no such file or folder of .glsl files below {}",
                                                  library.root().string()));
        }
    }
    std::sort(files.begin(), files.end());
    files.erase(std::unique(files.begin(), files.end()), files.end());
    return files;
}

// Some of them, drawn from the seed, in their own order.
void drawSample(std::vector<Mutation>& mutations, size_t sample, uint64_t seed)
{
    if (sample == 0 || sample >= mutations.size()) return;
    std::mt19937_64 generator(seed);
    std::vector<size_t> places(mutations.size());
    for (size_t i = 0; i < places.size(); ++i)
        places[i] = i;
    for (size_t i = places.size(); i > 1; --i) // std::shuffle may differ from library to library
        std::swap(places[i - 1], places[generator() % i]);
    places.resize(sample);
    std::sort(places.begin(), places.end());
    std::vector<Mutation> drawn;
    for (const size_t place : places)
        drawn.push_back(std::move(mutations[place]));
    mutations = std::move(drawn);
}

// The list beside the shader folder, in a source tree; empty where there is none.
fs::path findEquivalents(const MutateOptions& options, const fs::path& shaderRoot)
{
    if (!options.equivalents.empty()) return options.equivalents;
    fs::path file = fs::absolute(shaderRoot).lexically_normal().parent_path() / "tests/mutation/equivalent.toml";
    std::error_code ignored;
    if (fs::exists(file, ignored)) return file;
    return {};
}

void printList(const std::vector<Mutation>& mutations)
{
    for (const Mutation& mutation : mutations)
        fmt::print("{}\n", mutation.id());
    fmt::print("{} mutants\n", mutations.size());
}

void printResults(const HuntResult& hunt, const MutateOptions& options)
{
    fmt::print("{}\n{}\n", formatSurvivors(hunt), formatHuntTable(hunt));
    size_t leftOut = 0;
    for (const CaseScore& score : hunt.cases) {
        leftOut += score.leftOut.empty() ? 0 : 1;
        if (options.verbose && !score.leftOut.empty()) fmt::print("left out: {}: {}\n", score.name, score.leftOut);
        if (score.isIdle) fmt::print("catches none of {} mutants: {}\n", score.asked, score.name);
    }
    fmt::print("{} cases, {} left out; {:.1f} s on {}\n", hunt.cases.size(), leftOut, hunt.seconds,
               hunt.fingerprint.device);
}

void writeResults(const HuntResult& hunt, const HuntChoice& choice, const MutateOptions& options)
{
    if (!options.json.empty()) {
        if (const fs::path folder = fs::path(options.json).parent_path(); !folder.empty())
            fs::create_directories(folder);
        writeFileWhole(options.json, formatHuntJson(hunt, choice));
    }
    if (options.output.empty()) return;
    fs::create_directories(options.output);
    writeFileWhole(fs::path(options.output) / "mutation.md", formatHuntMarkdown(hunt, choice));
    writeFileWhole(fs::path(options.output) / "mutation.csv", formatHuntCsv(hunt));
    writeFileWhole(fs::path(options.output) / "mutation.json", formatHuntJson(hunt, choice));
}

// True once every ten seconds.
class Beat {
  public:
    bool isDue()
    {
        const auto now = std::chrono::steady_clock::now();
        if (now - last_ <= std::chrono::seconds(10)) return false;
        last_ = now;
        return true;
    }

  private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

// A line a mutant, or every ten seconds.
auto makeReporter(const MutateOptions& options, std::chrono::steady_clock::time_point start)
{
    return [&options, start, beat = Beat()](const MutantResult& result, size_t done, size_t all) mutable {
        if (options.verbose) {
            fmt::print(stderr, "{:<10} {:5.1f} s {:3} asked  {}  {}\n", nameOf(result.end), result.seconds,
                       result.asked, result.mutation.id(), result.caughtBy);
        } else if (beat.isDue()) {
            const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
            fmt::print(stderr, "{} of {} mutants, {:.0f} s\n", done, all, taken.count());
        }
    };
}

auto makeIdleReporter()
{
    return [beat = Beat()](size_t done, size_t all) mutable {
        if (beat.isDue()) fmt::print(stderr, "idle cases: {} of {} sets of programs\n", done, all);
    };
}

} // namespace

int mutateShaders(const GlobalOptions& global, const MutateOptions& options)
{
    // The others run translations, or the library as this program was built with it.
    if (options.backend != "lavapipe" && options.backend != "swiftshader" && !options.backend.starts_with("vulkan:")) {
        throw InputError(
            fmt::format("--backend {}: allowed are lavapipe, swiftshader and vulkan:NAME", options.backend));
    }
    const Folders folders = findFolders(global.shaders, global.cases, global.cache);
    MutantLibrary library(folders.shaders);
    std::vector<Mutation> mutations;
    for (const std::string& file : chooseFiles(library, options.shaders)) {
        for (Mutation& mutation : findMutations(file, library.textOf(file)))
            mutations.push_back(std::move(mutation));
    }
    const fs::path equivalentsFile = findEquivalents(options, folders.shaders);
    std::vector<EquivalentMutant> equivalents;
    if (!equivalentsFile.empty()) equivalents = readEquivalents(equivalentsFile);
    checkEquivalents(equivalents, mutations);
    const EarlierHunt earlier = options.again.empty() ? EarlierHunt{} : EarlierHunt(options.again);
    HuntChoice choice;
    choice.planted = mutations.size();
    choice.seed = options.seed;
    choice.commit = findCommit(folders.shaders).hash;
    choice.command =
        fmt::format("crossray {}", fmt::join(global.commandLine.begin() + 1, global.commandLine.end(), " "));
    std::erase_if(mutations, [&](const Mutation& mutation) {
        return std::none_of(options.mutants.begin(), options.mutants.end(),
                            [&](const std::string& text) { return mutation.id().find(text) != std::string::npos; }) &&
               !options.mutants.empty();
    });
    drawSample(mutations, options.sample, options.seed);
    if (mutations.empty()) {
        fmt::print(stderr, "crossray: no mutant is selected\n");
        return static_cast<int>(ExitCode::kNothingSelected);
    }
    if (options.list) {
        printList(mutations);
        return static_cast<int>(ExitCode::kAsExpected);
    }
    SelectedCases selected = selectCases(options.selection, folders.cases, "out/last", false);
    if (selected.exitCode) return static_cast<int>(*selected.exitCode);

    HuntOptions hunting;
    hunting.backend = options.backend;
    hunting.threads = options.jobs > 0 ? options.jobs : countAvailableCores();
    hunting.idleTries = options.idleTries;
    hunting.askAtMost = options.askAtMost;
    choice.askAtMost = options.askAtMost;
    if (!options.tryEquivalents) {
        hunting.isEquivalent = [&](const Mutation& mutation) {
            return std::any_of(equivalents.begin(), equivalents.end(),
                               [&](const EquivalentMutant& entry) { return entry.matches(mutation); });
        };
    }
    if (!options.again.empty())
        hunting.findCaught = [&](const Mutation& mutation) { return earlier.findCaught(mutation); };
    hunting.report = makeReporter(options, std::chrono::steady_clock::now());
    hunting.reportIdle = makeIdleReporter();
    const HuntResult result = hunt(library, selected.cases, mutations, hunting);
    writeResults(result, choice, options);
    printResults(result, options);
    const HuntCounts all = countAll(result);
    fmt::print("{} caught, {} survived, {} not counted, score {}\n", all.caught, all.survived,
               all.planted - all.caught - all.survived, formatScore(all));
    const bool isBelow = options.minScore > 0 && all.score().value_or(0) * 100 < options.minScore;
    return static_cast<int>(isBelow ? ExitCode::kFailed : ExitCode::kAsExpected);
}

} // namespace crossray
