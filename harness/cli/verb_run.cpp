#include "harness/cli/conditioning_text.h"
#include "harness/cli/verbs.h"
#include "harness/inspect/worst_traces.h"
#include "harness/report/report.h"
#include "harness/run/attempt.h"
#include "harness/run/cache_folder.h"
#include "harness/run/environment.h"
#include "harness/run/junit.h"
#include "harness/run/plane_files.h"
#include "harness/run/result_cache.h"
#include "harness/run/run_json.h"
#include "harness/run/run_plan.h"
#include "harness/run/steps.h"
#include "harness/run/verdict.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <future>
#include <map>
#include <random>

namespace crossray {

namespace {

std::string countOf(size_t count, std::string_view thing)
{
    return fmt::format("{} {}{}", count, thing, count == 1 ? "" : "s");
}

namespace fs = std::filesystem;

std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler writes it");

extern "C" void handleInterrupt(int)
{
    if (interrupted.exchange(true)) _exit(static_cast<int>(ExitCode::kInterrupted)); // the second time at once
}

void catchInterrupts()
{
    struct sigaction action {};
    action.sa_handler = handleInterrupt;
    sigemptyset(&action.sa_mask);
    action.sa_flags = SA_RESTART;
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
}

std::string formatNow()
{
    const auto now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
    return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(now));
}

uint64_t peakMemoryOfTool()
{
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<uint64_t>(usage.ru_maxrss) * 1024;
}

// Large cases early: one that comes last would leave the other cores idle. The first few stay in front, so that the
// first verdict comes soon.
void orderForThroughput(std::vector<Case>& cases)
{
    constexpr ptrdiff_t kFront = 4;
    if (std::ssize(cases) <= kFront) return;
    const auto pixels = [](const Case& testCase) { return int64_t{testCase.camera.width} * testCase.camera.height; };
    std::stable_sort(cases.begin(), cases.end(), [&](const Case& a, const Case& b) { return pixels(a) < pixels(b); });
    std::stable_sort(cases.begin() + kFront, cases.end(), [&](const Case& a, const Case& b) {
        constexpr int64_t kLarge = 256 * 256; // small ones keep their order
        return std::max(pixels(a), kLarge) > std::max(pixels(b), kLarge);
    });
}

void orderCases(std::vector<Case>& cases, const std::optional<uint64_t>& seed)
{
    if (!seed) return orderForThroughput(cases);
    std::mt19937_64 generator(*seed);
    for (size_t i = cases.size(); i > 1; --i) // std::shuffle may differ from library to library
        std::swap(cases[i - 1], cases[generator() % i]);
}

// Why failures have no trace, as far as they were to have one.
void printTraceNotes(const RunResult& run, const Style& style, FILE* text)
{
    std::map<std::string, size_t> notes;
    for (const CaseResult& testCase : run.cases) {
        for (const BackendResult& result : testCase.backends) {
            if (!result.traceNote.empty()) ++notes[result.traceNote];
        }
    }
    for (const auto& [note, count] : notes)
        fmt::print(text, "{} {}: {}\n", style.paint(Ink::kYellow, "not traced:"), countOf(count, "failure"), note);
}

void printSummary(const RunResult& run, const RunOptions& options, const Style& style, FILE* text)
{
    const RunCounts counts = countVerdicts(run);
    if (!options.quiet) {
        fmt::print(text, "\n");
        if (options.conditioning) fmt::print(text, "{}\n", formatConditioning(run));
        for (const auto& [name, record] : run.backends) {
            const Fingerprint& print = record.fingerprint;
            fmt::print(text, "{:<12} {}\n", name,
                       record.environmentError.empty()
                           ? fmt::format("{}, {}, {}", print.device, print.driver, print.api)
                           : style.paint(Ink::kRed, record.environmentError));
        }
        std::string others;
        for (const auto& [verdict, count] : counts.byVerdict) {
            if (verdict != Verdict::kPass) others += fmt::format(", {} {}", count, nameOf(verdict));
        }
        fmt::print(text, "{} on {} in {:.1f} s{}; results in {}/run.json{}\n", countOf(run.cases.size(), "case"),
                   countOf(run.backends.size(), "backend"), run.seconds, others, options.output,
                   options.report ? fmt::format(", pages in {}/report/index.html", options.output) : "");
    }
    if (!options.quiet) printTraceNotes(run, style, text);
    std::map<std::string, size_t> answered;
    for (const CaseResult& testCase : run.cases) {
        if (!testCase.answeredBy.empty()) ++answered[testCase.answeredBy];
    }
    for (const auto& [by, count] : answered)
        fmt::print(text, "{} answered from the {}\n", countOf(count, "case"), by);
    if (!run.unchanged.empty()) {
        fmt::print(text, "{} left out: passed with the same inputs\n", countOf(run.unchanged.size(), "case"));
    }
    for (const std::string& line : run.brokenFiles)
        fmt::print(text, "{} {}\n", style.paint(Ink::kRed, "broken:"), line);
    if (run.interrupted) fmt::print(text, "{}\n", style.paint(Ink::kYellow, "interrupted"));
    if (run.stoppedEarly) fmt::print(text, "{}\n", style.paint(Ink::kYellow, "stopped early"));
}

void writeResults(const RunResult& run, const RunOptions& options)
{
    const std::string json = formatRunJson(run);
    writeFileWhole(fs::path(options.output) / "run.json", json);
    if (!options.junit.empty()) writeFileWhole(options.junit, formatJunit(run));
}

// The run counts, and not its pages: what goes wrong with them is said and changes no exit code.
void writePages(const RunResult& run, const RunOptions& options, const fs::path& finalFolder)
{
    if (!options.report) return;
    ReportOptions report;
    report.runFolder = finalFolder.generic_string();
    try {
        writeReport(run, options.output, fs::path(options.output) / "report", report);
    } catch (const Error& error) {
        fmt::print(stderr, "crossray: no report: {}\n", error.what());
    }
}

ExecuteOptions makeExecuteOptions(const GlobalOptions& global, const RunOptions& options,
                                  const std::vector<std::string>& backends, int cores, const PassedCases& passedBefore)
{
    ExecuteOptions execution;
    execution.backends = backends;
    execution.cores = cores;
    execution.repeat = options.repeat;
    execution.maxFailures = options.maxFailures;
    execution.keepGoing = options.keepGoing;
    execution.timeoutSeconds = options.timeoutSeconds;
    execution.keepPlanes = options.planes;
    execution.conditioning = options.conditioning;
    execution.outputFolder = options.output;
    if (options.changed) execution.passedBefore = passedBefore;
    execution.today = formatToday();
    execution.processStart = global.processStart;
    return execution;
}

// Cases came in the order that suits the cores; people and diffs want one order.
void sortByName(RunResult& run)
{
    std::sort(run.cases.begin(), run.cases.end(),
              [](const CaseResult& a, const CaseResult& b) { return a.name < b.name; });
    std::sort(run.unchanged.begin(), run.unchanged.end());
}

// Variables of an engine that runs this as one of several, who each take all cases unless told otherwise.
void printIgnoredOffers()
{
    for (const ShardOffer& offer : findShardOffers(readEnvironment)) {
        if (offer.count == 1) continue;
        fmt::print(
            stderr,
            "crossray: {} names a part of several ({}), and this run takes all cases; --shard auto takes the part\n",
            offer.engine, offer.variables);
    }
}

// A shard's results go to the folder of its attempt.
void startShard(RunOptions& options, RunResult& run, const ShardChoice& choice)
{
    run.shard = choice.shard.format();
    run.attempt = options.attempt.empty() ? makeAttemptName() : options.attempt;
    options.output = chooseAttemptFolder(options.output, choice.shard, run.attempt).string();
    if (!choice.statusFile.empty() && !std::ofstream(choice.statusFile, std::ios::app)) {
        throw EnvironmentError(fmt::format("{}: the engine's file about shards cannot be written", choice.statusFile));
    }
}

// Its folder takes its final name once all of it is there. Returns the folder to tell people.
std::string finishShard(const RunResult& run, const RunOptions& options)
{
    if (run.shard.empty()) return options.output;
    const std::string reason = whyNotWhole(run);
    if (reason.empty()) return finishAttemptFolder(options.output).string();
    fmt::print(stderr, "crossray: the shard is not whole and keeps its folder {}: {}\n", options.output, reason);
    return options.output;
}

RunResult describeRun(const GlobalOptions& global, const RunOptions& options, int cores)
{
    RunResult run;
    run.version = toolVersion();
    run.started = formatNow();
    run.commandLine = global.commandLine;
    run.validation = options.validation;
    run.cores = cores;
    run.repeat = options.repeat;
    run.seed = options.seed;
    run.compilers = ShaderCompiler::versions();
    return run;
}

} // namespace

int runCases(const GlobalOptions& global, const RunOptions& given)
{
    RunOptions options = given;
    const Folders folders = findFolders(global.shaders, global.cases, global.cache);
    if (std::error_code failure;
        std::filesystem::exists(options.output, failure) && !std::filesystem::is_directory(options.output, failure)) {
        throw InputError(
            fmt::format("--output {}: that is a file; allowed is a folder, or what is not there yet", options.output));
    }
    SelectedCases selected = selectCases(options.selection, folders.cases, options.output, options.keepGoing);
    if (selected.exitCode) return static_cast<int>(*selected.exitCode);
    orderCases(selected.cases, options.seed);

    const std::vector<BackendInfo> known = listBackends();
    const BackendChoice backends = chooseBackends(options.backends, known);
    if (!options.quiet) {
        for (const std::string& note : backends.notes)
            fmt::print(stderr, "crossray: {}\n", note);
    }
    const PassedCases passedBefore = readPassedCases(options.output);
    const int cores = options.cores > 0 ? options.cores : countAvailableCores();
    RunResult run = describeRun(global, options, cores);
    if (selected.shard) {
        startShard(options, run, *selected.shard);
    } else if (!options.quiet) {
        printIgnoredOffers();
    }
    startRunFolder(options.output, options.resume);
    catchInterrupts();
    // git takes some milliseconds of its own; nobody waits for it before the end.
    std::future<Hash128> program = std::async(std::launch::async, hashProgram);
    std::future<Commit> commit = std::async(std::launch::async, [&] { return findCommit(folders.shaders); });
    std::future<std::string> shaders = std::async(std::launch::async, [&] { return hashFolder(folders.shaders); });
    FILE* const text = options.json ? stderr : stdout; // JSON stands alone on standard output
    const Style style = Style::choose(global.color, fileno(text));
    run.brokenFiles = selected.broken;
    Progress progress({chooseProgress(options.progress), options.quiet, options.verbose, text, stderr, style,
                       selected.cases.size(), selected.cases.size() * backends.names.size(), folders.cases});
    {
        WorkerOptions workers;
        workers.validation = options.validation;
        workers.mesaCacheFolder = folders.cache / "mesa";
        workers.cores = cores;
        WorkerPool pool(workers);
        ShaderCompiler compiler(folders.cache / "spirv");
        KeptResults kept({program.get(), options.validation, options.repeat}, folders.shaders);
        const ResultCache cache(folders.cache / "results");
        RunJournal journal(options.output, options.resume);
        const ExecuteOptions execution = makeExecuteOptions(global, options, backends.names, cores, passedBefore);
        ExecuteSteps steps = makeSteps(pool, compiler, folders.shaders, backends.names);
        // Nobody kept the planes of what passed, nor its conditioning; --changed leaves out what has passed here.
        const bool recalls = options.planes != KeepPlanes::kAll && !options.conditioning && !options.changed;
        remember({kept, journal, options.useCache ? &cache : nullptr, recalls, options.resume}, backends.names, steps);
        execute(selected.cases, execution, steps, progress, interrupted, run);
        if (options.planes != KeepPlanes::kNone && !run.interrupted) {
            WorstTraceLimits limits;
            limits.threads = cores;
            keepWorstTraces(run, selected.cases, options.output, makeTraceStep(pool, compiler, folders.shaders), limits,
                            interrupted);
        }
        run.workersPeakBytes = pool.peakMemory();
        run.plan = selected.plan;
        run.plan.options = describeOptions(execution, options.validation);
    }
    progress.finish();
    run.toolPeakBytes = peakMemoryOfTool();
    const Commit found = commit.get();
    run.commit = found.hash;
    run.modified = found.modified;
    run.plan.shaders = shaders.get();
    run.plan.harness = describeHarness();
    run.plan.hash = hashPlan(run.plan);
    sortByName(run);
    run.exitCode = static_cast<int>(computeExitCode(run));
    writeResults(run, options);
    const bool isWholeShard = selected.shard && whyNotWhole(run).empty();
    writePages(run, options, isWholeShard ? fs::path(options.output).replace_extension() : fs::path(options.output));
    // Of a shard the merged run's folder has it.
    if (!options.validation && !selected.shard) writePassedCases(options.output, mergePassedCases(passedBefore, run));
    if (!run.interrupted) {
        std::error_code gone;
        fs::remove(RunJournal::fileOf(options.output), gone);
    }
    trimCache(folders.cache, cacheBound(global));
    options.output = finishShard(run, options);
    if (options.github) fmt::print(text, "{}", formatGithubAnnotations(run));
    printSummary(run, options, style, text);
    if (options.json) fmt::print("{}", formatSummaryJson(run));
    fmt::print(text, "{}\n", formatCounts(countVerdicts(run)));
    return run.exitCode;
}

} // namespace crossray
