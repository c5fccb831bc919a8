#include "harness/cli/command_line.h"

#include "harness/cli/command_line_parts.h"
#include "harness/cli/ctest_folder.h"
#include "harness/cli/manual.h"
#include "harness/run/environment.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <memory>

namespace crossray {

void addSelection(CLI::App& verb, SelectionOptions& selection)
{
    verb.add_option("cases", selection.arguments, "Case files, folders, names, or globs over both; none: all cases")
        ->type_name("CASE|DIR|GLOB");
    verb.add_option("-k", selection.expression, "Only cases whose name or tags fit: words with and, or, not, brackets")
        ->type_name("EXPR");
    verb.add_option("--tag", selection.tags, "Only cases with this tag; may be repeated")
        ->type_name("TAG")
        ->expected(1)
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    verb.add_option(
            "--shard", selection.shard,
            "Part I of N, from 1, by a stable hash of the name; auto, or an engine's name: as its variables say")
        ->type_name("I/N|auto[/N]");
    verb.add_option("--timings", selection.timings, "With --shard: parts that take equally long, by the times of a run")
        ->type_name("RUN");
    verb.add_flag("--last-failed", selection.lastFailed, "Only the cases that failed in the last run (OUT/run.json)");
}

namespace {

int printManual();
int printCompletion(const std::string& shell);

template <typename Enum>
CLI::Option* addChoice(CLI::App& app, const std::string& name, Enum& value, const std::map<std::string, Enum>& choices,
                       const std::string& text)
{
    std::string allowed;
    for (const auto& [choice, unused] : choices)
        allowed += allowed.empty() ? choice : "|" + choice;
    return app
        .add_option_function<std::string>(
            name,
            [&value, choices, name, allowed](const std::string& given) {
                const auto found = choices.find(given);
                if (found == choices.end()) {
                    throw CLI::ValidationError(fmt::format("{} {}: allowed is {}", name, given, allowed));
                }
                value = found->second;
            },
            text)
        ->type_name(allowed)
        ->take_last();
}

void addRun(CLI::App& app, CommandLine& line)
{
    CLI::App& verb = *app.add_subcommand("run", "Run cases on the backends and judge what they answer");
    RunOptions& run = line.run;
    addSelection(verb, run.selection);
    verb.add_option("--backend", run.backends,
                    "Only these; all for every one that is found, vulkan:NAME for any other device")
        ->type_name("NAME,...")
        ->delimiter(',')
        ->expected(1)
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    verb.add_option("-j,--jobs", run.cores, "Processors to use; default: all available")
        ->type_name("N")
        ->check(CLI::Range(1, 256));
    verb.add_flag("--changed", run.changed,
                  "Leave out what has passed with the same shader code, inputs and expectations (OUT/inputs.json)");
    verb.add_flag("--no-cache", line.noCache, "Take no verdict from the cache, and keep none");
    verb.add_flag("--resume", run.resume, "Go on with the interrupted run in the output folder");
    verb.add_flag("-x,--exitfirst", line.stopAtFirst, "Stop at the first failure");
    verb.add_option("--max-fail", run.maxFailures, "Stop after N failures")
        ->type_name("N")
        ->check(CLI::Range(1, 1000000));
    verb.add_flag("--keep-going", run.keepGoing,
                  "Run the other cases when a case file is broken; the exit code stays 2");
    verb.add_option("--timeout", run.timeoutSeconds, "Seconds a case may take on a backend, instead of its own limit")
        ->type_name("SECONDS")
        ->check(CLI::Range(0.001, 86400.0));
    verb.add_option("--repeat", run.repeat, "Run each case N times; answers that differ fail")
        ->type_name("N")
        ->check(CLI::Range(1, 10000));
    verb.add_option("--seed", run.seed, "Run the cases in a random order drawn from this number")->type_name("N");
    verb.add_flag("--validate", run.validation,
                  "Vulkan validation layer and GL debug context; any message fails the case");
    addChoice<KeepPlanes>(verb, "--planes", run.planes,
                          {{"all", KeepPlanes::kAll}, {"failed", KeepPlanes::kFailed}, {"none", KeepPlanes::kNone}},
                          "Which cases' planes are kept as EXR");
    verb.add_flag("--conditioning", run.conditioning,
                  "Measure how many output ulp an input ulp becomes, per pixel (OUT/planes/CASE/conditioning.exr)");
    verb.add_option("-o,--output", run.output, "Folder for run.json and planes; default: out/last")
        ->type_name("DIR")
        ->take_last();
    verb.add_flag("--json", run.json, "Print run.json's summary to standard output, and all text to standard error");
    verb.add_option("--attempt", run.attempt,
                    "Of a shard: its results go to DIR/shard-I-of-N.NAME; default: a new name")
        ->type_name("NAME");
    verb.add_option("--junit", run.junit, "Write JUnit XML")->type_name("FILE");
    verb.add_flag("--no-report", line.noReport, "Write no pages (OUT/report/index.html)");
    addChoice<std::string>(verb, "--github", line.github, {{"auto", "auto"}, {"on", "on"}, {"off", "off"}},
                           "GitHub annotations; auto: when in GitHub Actions");
    addChoice<ProgressMode>(verb, "--progress", run.progress,
                            {{"auto", ProgressMode::kAuto},
                             {"bar", ProgressMode::kBar},
                             {"lines", ProgressMode::kLines},
                             {"none", ProgressMode::kNone}},
                            "auto: a bar on a terminal, lines elsewhere");
    verb.add_flag("-q,--quiet", run.quiet, "Failures and the last line alone");
    verb.add_flag("-v,--verbose", run.verbose, "Every verdict, and every failed expectation");
    verb.callback([&line] {
        line.verb = [&line] {
            const char* const actions = std::getenv("GITHUB_ACTIONS");
            line.run.github =
                line.github == "on" || (line.github == "auto" && actions != nullptr && std::string(actions) == "true");
            if (line.stopAtFirst) line.run.maxFailures = 1;
            line.run.report = !line.noReport;
            line.run.useCache = !line.noCache;
            return runCases(line.global, line.run);
        };
    });
}

void addInspection(CLI::App& app, CommandLine& line)
{
    CLI::App& list = *app.add_subcommand("list", "List cases");
    addSelection(list, line.list);
    CLI::Option* const asJson = list.add_flag("--json", line.listJson, "As JSON");
    list.add_option("--ctest", line.listCtest, "Write a folder for ctest: a test a case, with its tags as labels")
        ->type_name("DIR")
        ->excludes(asJson);
    list.callback([&line] {
        line.verb = [&line] {
            if (!line.listCtest.empty()) return writeCtestFolder(line.global, line.list, line.listCtest);
            return listCases(line.global, line.list, line.listJson);
        };
    });

    CLI::App& show = *app.add_subcommand("show", "Show what a case will run, expect and skip");
    show.add_option("case", line.show.testCase, "A case's name, file or glob")->type_name("CASE")->required();
    show.add_option("--backend", line.show.backends, "As for run")
        ->type_name("NAME,...")
        ->delimiter(',')
        ->expected(1)
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    show.add_option("--image", line.show.image,
                    "Run the case and draw its debug modes, on the first backend named; - for the terminal alone")
        ->type_name("FILE.png");
    show.add_option("--panels", line.show.panels, "Of the picture, by name; default: all")
        ->type_name("NAME,...")
        ->delimiter(',')
        ->expected(1)
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    show.add_option("--debug-mode", line.show.debugMode, "With --image: this debug mode alone, in its display encoding")
        ->type_name("NAME");
    show.add_flag("--conditioning", line.show.conditioning,
                  "Measure how many output ulp an input ulp becomes, and which pixels are undecidable");
    show.add_option("--pixel", line.show.pixel, "With --conditioning: of this pixel alone, from the top left corner")
        ->type_name("X,Y");
    show.callback([&line] { line.verb = [&line] { return showCase(line.global, line.show); }; });

    CLI::App& trace = *app.add_subcommand("trace", "Show all that the ray of one pixel does");
    trace.add_option("case", line.trace.testCase, "A case's name or file")->type_name("CASE")->required();
    trace.add_option("--pixel", line.trace.pixel, "From the top left corner")->type_name("X,Y")->required();
    trace
        .add_option("--backend", line.trace.backends,
                    "One, or two to see where they part; may be repeated; default: lavapipe")
        ->type_name("NAME,...")
        ->delimiter(',')
        ->expected(1)
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    trace.add_flag("--json", line.trace.json, "As JSON");
    trace.add_flag("--conditioning", line.trace.conditioning,
                   "Measure how many output ulp an input ulp becomes, also where the image is large");
    trace.callback([&line] { line.verb = [&line] { return traceCase(line.global, line.trace); }; });

    CLI::App& inspect =
        *app.add_subcommand("inspect", "Look at cases live in a browser: turn their keys, trace pixels");
    addSelection(inspect, line.inspect.selection);
    inspect.add_option("--port", line.inspect.port, "Of 127.0.0.1; default: 0, a free one")
        ->type_name("N")
        ->check(CLI::Range(0, 65535));
    inspect.add_flag("--open", line.inspect.open, "In the browser");
    inspect.callback([&line] { line.verb = [&line] { return inspectCases(line.global, line.inspect); }; });

    CLI::App& diff = *app.add_subcommand("diff", "Compare two runs, or two EXR files of planes");
    diff.add_option("before", line.before, "A run's folder, its run.json, or an .exr")->type_name("A")->required();
    diff.add_option("after", line.after, "The same kind")->type_name("B")->required();
    diff.add_flag("--json", line.diffJson, "As JSON");
    diff.callback(
        [&line] { line.verb = [&line] { return diffRuns(line.global, line.before, line.after, line.diffJson); }; });

    CLI::App& review = *app.add_subcommand("review", "List golden expectations that failed, or record them");
    review.add_option("--run", line.review.run, "The run to review; default: out/last")->type_name("DIR");
    CLI::Option* const listFlag = review.add_flag("--list", line.reviewList, "List what failed (the default)");
    review.add_option("--accept", line.review.accept, "Record the goldens of a case from the run's planes")
        ->type_name("CASE")
        ->excludes(listFlag);
    review.add_option("--backend", line.review.backend, "Whose planes to record; default: the first that failed")
        ->type_name("NAME");
    review.callback([&line] { line.verb = [&line] { return reviewGoldens(line.global, line.review); }; });
}

void addReport(CLI::App& app, CommandLine& line)
{
    CLI::App& report = *app.add_subcommand("report", "Show a run as pages for a browser");
    report.add_option("run", line.report.run, "A run's folder, or its run.json; default: out/last")->type_name("RUN");
    report.add_flag("--single", line.report.isSingle, "One file of at most 20 MB that needs no other");
    report.add_option("-o,--output", line.report.output, "Default: RUN/report, or RUN/report.html for a single file")
        ->type_name("DIR");
    report.add_option("--trace", line.report.traces, "What `crossray trace --json` printed; may be repeated")
        ->type_name("FILE")
        ->expected(1)
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    report
        .add_option("--bench", line.report.benches,
                    "JSON of bench, bench tracers, sweep or mutate, as charts; may be repeated")
        ->type_name("FILE")
        ->expected(1)
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    report.add_option("--cubemap", line.report.cubemaps, "A cubemap file, to look about in; may be repeated")
        ->type_name("FILE.exr")
        ->expected(1)
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    report.add_flag("--open", line.report.open, "Open it in the browser");
    report.callback([&line] { line.verb = [&line] { return reportRun(line.report); }; });
}

void addMerge(CLI::App& app, CommandLine& line)
{
    CLI::App& merge = *app.add_subcommand("merge", "Make one run of the shards that ran apart");
    merge.add_option("runs", line.merge.runs, "Folders that hold shards, or the shards' own folders")
        ->type_name("RUN")
        ->required();
    merge.add_option("-o,--output", line.merge.output, "Folder for the run; default: out/last")->type_name("DIR");
    merge.add_option("--junit", line.merge.junit, "Write JUnit XML")->type_name("FILE");
    merge.add_flag("--partial", line.merge.isPartial, "Merge what is there although shards are missing");
    merge.add_flag("--no-report", line.noMergeReport, "Write no pages (DIR/report/index.html)");
    merge.add_flag("-q,--quiet", line.merge.quiet, "The last line alone, and what was wrong");
    merge.callback([&line] {
        line.verb = [&line] {
            line.merge.report = !line.noMergeReport;
            return mergeRuns(line.global, line.merge);
        };
    });
}

void addTools(CLI::App& app, CommandLine& line)
{
    CLI::App& compile = *app.add_subcommand("compile", "Compile a shader and print it in another language");
    compile.add_option("shader", line.compile.shader, "A path, here or below the shader folder")
        ->type_name("SHADER")
        ->required();
    compile.add_option("--target", line.compile.target, "spirv, glsl, essl, hlsl or msl; default: glsl")
        ->type_name("LANGUAGE");
    compile.add_option("-o,--output", line.compile.output, "A file instead of standard output")->type_name("FILE");
    compile.add_option("--spec", line.compile.specialization, "Value of a specialization constant; may be repeated")
        ->type_name("NAME=VALUE")
        ->expected(1)
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    compile.add_flag("--no-optimize", line.noOptimization, "Leave out the optimiser");
    compile.add_flag("--assembly", line.compile.assembly, "SPIR-V as text also in a file");
    compile.callback([&line] {
        line.verb = [&line] {
            line.compile.optimize = !line.noOptimization;
            return compileShader(line.global, line.compile);
        };
    });

    CLI::App& bake = *app.add_subcommand("bake", "Capture the baked probes of a case as cubemap files");
    bake.add_option("case", line.bake.testCase, "A case's name, file or glob")->type_name("CASE")->required();
    bake.add_option("-o,--output", line.bake.output, "Another file than the one that the case reads")
        ->type_name("FILE.exr");
    bake.callback([&line] { line.verb = [&line] { return bakeProbes(line.global, line.bake); }; });

    CLI::App& doctor = *app.add_subcommand("doctor", "Show which backends, compilers and folders are there");
    doctor.callback([&line] { line.verb = [&line] { return diagnose(line.global); }; });

    CLI::App& cache = *app.add_subcommand("cache", "Show or empty the cache of shaders and verdicts");
    cache.require_subcommand(1);
    CLI::App& stats = *cache.add_subcommand("stats", "Show what is in it, and where");
    stats.callback([&line] { line.verb = [&line] { return showCache(line.global); }; });
    CLI::App& clear = *cache.add_subcommand("clear", "Empty it, or the named parts of it");
    clear.add_option("parts", line.cacheParts, "Parts of it; none: all")->type_name("spirv|results|mesa");
    clear.callback([&line] { line.verb = [&line] { return emptyCache(line.global, line.cacheParts); }; });

    CLI::App& manual = *app.add_subcommand("manual", "Print the man page, as roff");
    manual.callback([&line] { line.verb = [] { return printManual(); }; });

    CLI::App& completion = *app.add_subcommand("completion", "Print a shell's completion script");
    completion.add_option("shell", line.shell, "Which shell it is for")->type_name("bash|zsh|fish")->required();
    completion.callback([&line] { line.verb = [&line] { return printCompletion(line.shell); }; });

    CLI::App& worker = *app.add_subcommand("worker", "Serve one backend; started by run")->group("");
    worker.add_option("--backend", line.workerBackend)->required();
    worker.add_option("--request-fd", line.requestFd)->required();
    worker.add_option("--reply-fd", line.replyFd)->required();
    worker.add_flag("--validation", line.workerValidation);
    worker.callback([&line] {
        line.verb = [&line] {
            return runWorker(line.workerBackend, line.requestFd, line.replyFd, line.workerValidation);
        };
    });
}

std::unique_ptr<CLI::App> makeApp(CommandLine& line)
{
    auto app = std::make_unique<CLI::App>(
        "crossray: one shader, every backend, judged against data that no GPU produced", "crossray");
    app->set_version_flag("--version", std::string(toolVersion()));
    app->require_subcommand(1);
    app->fallthrough();
    GlobalOptions& global = line.global;
    addChoice<ColorMode>(*app, "--color", global.color,
                         {{"auto", ColorMode::kAuto}, {"always", ColorMode::kAlways}, {"never", ColorMode::kNever}},
                         "auto: on a terminal; NO_COLOR wins");
    app->add_option("--shaders", global.shaders, "The shader folder (CROSSRAY_SHADERS)")->type_name("DIR");
    app->add_option("--cases", global.cases, "The case folder (CROSSRAY_CASES)")->type_name("DIR");
    app->add_option("--cache-dir", global.cache, "The cache folder (CROSSRAY_CACHE)")->type_name("DIR");
    app->add_option("--cache-size", global.cacheMebibytes, "What the cache may grow to (CROSSRAY_CACHE_SIZE); 1024")
        ->type_name("MIB")
        ->envname("CROSSRAY_CACHE_SIZE")
        ->check(CLI::Range(uint64_t{1}, uint64_t{1} << 24));
    addRun(*app, line);
    addInspection(*app, line);
    addReport(*app, line);
    addMerge(*app, line);
    addTools(*app, line);
    addBench(*app, line);
    addSweep(*app, line);
    addMutate(*app, line);
    return app;
}

// Of a command line without a verb: its first word, and what would be one.
std::string describeMissingVerb(const CLI::App& app)
{
    std::vector<std::string> allowed;
    for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; })) {
        if (!verb->get_group().empty()) allowed.push_back(verb->get_name());
    }
    const std::vector<std::string> words = app.remaining();
    const auto isOption = [](const std::string& word) { return word.starts_with('-'); };
    const auto word = std::find_if_not(words.begin(), words.end(), isOption);
    const std::string wrong = word == words.end() ? "a verb is required" : fmt::format("\"{}\" is no verb", *word);
    return fmt::format("{}; allowed are {}", wrong, fmt::join(allowed, ", "));
}

// CLI11's texts name the option and what is wrong; what is allowed is in the help.
int printUsageError(const CLI::App& app, const CLI::ParseError& error)
{
    const auto verbs = app.get_subcommands();
    std::string text = verbs.empty() && error.get_name() == "RequiredError" ? describeMissingVerb(app) : error.what();
    for (char& character : text) {
        if (character == '\n') character = ' ';
    }
    const std::string help = verbs.empty() ? "crossray --help" : "crossray " + verbs.front()->get_name() + " --help";
    fmt::print(stderr, "crossray: {} (see {})\n", text, help);
    return static_cast<int>(ExitCode::kUsage);
}

} // namespace

int runCommandLine(int argc, const char* const* argv)
{
    CommandLine line;
    line.global.commandLine.assign(argv, argv + argc);
    const std::unique_ptr<CLI::App> app = makeApp(line);
    try {
        app->parse(argc, argv);
    } catch (const CLI::Success& success) { // --help, --version
        return app->exit(success);
    } catch (const CLI::ParseError& error) {
        return printUsageError(*app, error);
    }
    try {
        return line.verb();
    } catch (const Error& error) {
        fmt::print(stderr, "{}{}\n", error.position().file.empty() ? "crossray: " : "", error.what());
        return static_cast<int>(error.exitCode());
    } catch (const std::bad_alloc&) {
        fmt::print(stderr, "crossray: out of memory; fewer cores (-j) or smaller images take less\n");
        return static_cast<int>(ExitCode::kEnvironment);
    } catch (const std::exception& error) {
        fmt::print(stderr, "crossray: {}\n", error.what());
        return static_cast<int>(ExitCode::kEnvironment);
    }
}

namespace {

CommandDescription describe(const CLI::App& app)
{
    CommandDescription command{app.get_name(), app.get_description(), {}, {}};
    for (const CLI::Option* option : app.get_options()) {
        OptionDescription& described = command.options.emplace_back();
        for (const std::string& name : option->get_snames())
            described.names.push_back("-" + name);
        for (const std::string& name : option->get_lnames())
            described.names.push_back("--" + name);
        described.value = option->get_expected_max() > 0 ? option->get_type_name() : "";
        described.text = option->get_description();
        described.isRequired = option->get_required();
        described.isHidden = option->get_group().empty();
        described.isRepeated = option->get_items_expected_max() > 1;
    }
    for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; })) {
        if (!verb->get_group().empty()) command.verbs.push_back(describe(*verb));
    }
    return command;
}

int printManual()
{
    // Without a date, so that the same program prints the same page.
    fmt::print("{}", formatManual(describeCommandLine(), std::string(toolVersion()), ""));
    return static_cast<int>(ExitCode::kAsExpected);
}

int printCompletion(const std::string& shell)
{
    const std::map<std::string, Shell> shells{{"bash", Shell::kBash}, {"zsh", Shell::kZsh}, {"fish", Shell::kFish}};
    const auto found = shells.find(shell);
    if (found == shells.end()) {
        throw InputError(fmt::format("completion {}: allowed are bash, zsh and fish", shell));
    }
    fmt::print("{}", formatCompletion(describeCommandLine(), found->second));
    return static_cast<int>(ExitCode::kAsExpected);
}

} // namespace

CommandDescription describeCommandLine()
{
    CommandLine line;
    return describe(*makeApp(line));
}

std::vector<std::string> listOptions()
{
    CommandLine line;
    const std::unique_ptr<CLI::App> app = makeApp(line);
    std::vector<std::string> names;
    auto collect = [&names](const CLI::App& owner, const std::string& prefix) {
        for (const CLI::Option* option : owner.get_options()) {
            for (const std::string& name : option->get_lnames())
                names.push_back(prefix + "--" + name);
            for (const std::string& name : option->get_snames())
                names.push_back(prefix + "-" + name);
        }
    };
    collect(*app, "");
    for (const CLI::App* verb : app->get_subcommands([](const CLI::App*) { return true; })) {
        if (verb->get_group().empty()) continue;
        names.push_back(verb->get_name());
        collect(*verb, verb->get_name() + " ");
    }
    return names;
}

} // namespace crossray
