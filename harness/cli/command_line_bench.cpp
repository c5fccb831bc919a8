#include "harness/cli/command_line_parts.h"

#include <fmt/format.h>

namespace crossray {

namespace {

void addThroughput(CLI::App& bench, CommandLine& line)
{
    CLI::App& throughput = *bench.add_subcommand("throughput", "Milliseconds a case, on each backend");
    throughput.add_option("--backend", line.throughput.backends, "As for run")
        ->type_name("NAME,...")
        ->delimiter(',')
        ->allow_extra_args(false);
    throughput.add_option("--cases", line.throughput.cases, "Distinct cases")
        ->type_name("N")
        ->check(CLI::Range(1, 4096));
    throughput.add_option("--cores", line.throughput.cores, "Processors, one measurement each")
        ->type_name("N,...")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->check(CLI::Range(1, 1024));
    throughput.add_option("--rounds", line.throughput.rounds, "The median of so many counts")
        ->type_name("N")
        ->check(CLI::Range(1, 99));
    throughput.add_option("-o,--output", line.throughput.output, "The figures as JSON")->type_name("FILE");
    throughput.callback([&line] { line.verb = [&line] { return benchThroughput(line.global, line.throughput); }; });
}

void addTracers(CLI::App& bench, CommandLine& line)
{
    TracersVerbOptions& options = line.tracers;
    CLI::App& verb =
        *bench.add_subcommand("tracers", "Screen-space tracers on random scenes: how many hits, at what cost");
    verb.add_option("--seeds", options.seeds, "Seeds of the scenes; default: 1-24")->type_name("FIRST-LAST");
    verb.add_option("--size", options.size, "Pixels; default: 1920x1080")->type_name("WIDTHxHEIGHT");
    verb.add_option("--family", options.family,
                    "random_room, forest, staircase, terrain, curved_hall or panels; default: random_room")
        ->type_name("NAME");
    verb.add_option(
            "--disturb", options.disturbance,
            "What is done to the G-buffer: none, normal_map, smooth_normals, no_normals, depth24, depth16, noise, "
            "standard32, standard24 or standard16")
        ->type_name("NAME");
    verb.add_option("--case", options.testCase, "A case's scene instead")->type_name("CASE");
    verb.add_option("-k", options.filter, "Only tracers with this in their name")->type_name("TEXT");
    verb.add_option("--thickness", options.thickness, "Metres; default: 0.2 from 720 lines on, else 0.05")
        ->type_name("METRES")
        ->check(CLI::Range(1e-6, 1e6));
    verb.add_option("--stride", options.stride, "Every so many pixels both ways; default: 4")
        ->type_name("N")
        ->check(CLI::Range(1, 64));
    verb.add_option("--threads", options.threads, "Default: 2")->type_name("N")->check(CLI::Range(1, 256));
    verb.add_option("--json", options.json, "The figures as JSON")->type_name("FILE");
    verb.add_option("--csv", options.csv, "The figures as CSV")->type_name("FILE");
    verb.add_option("--charts", options.charts, "Charts as SVG")->type_name("DIR");
    verb.add_option("--method", options.methods, "A tracer of your own beside them; repeated: several")
        ->type_name("NAME=FILE")
        ->take_all()
        ->allow_extra_args(false);
    verb.add_option("--backend", options.backend, "Where it runs; default: lavapipe")->type_name("NAME");
    verb.callback([&line] { line.verb = [&line] { return benchTracers(line.global, line.tracers); }; });
}

} // namespace

void addBench(CLI::App& app, CommandLine& line)
{
    CLI::App& bench = *app.add_subcommand("bench", "Measure the accuracy and the cost of each method on cases' scenes");
    BenchCasesOptions& options = line.bench;
    bench.require_subcommand(0, 1);
    bench.add_option("cases", options.cases, "Case files, folders, names, or globs over both")
        ->type_name("CASE|DIR|GLOB");
    bench.add_option("--backend", options.backend, "Where; default: lavapipe")->type_name("NAME");
    bench.add_option("--method", options.methods, "A tracer of your own beside the library's; repeated: several")
        ->type_name("NAME=FILE")
        ->take_all()
        ->allow_extra_args(false);
    bench.add_flag("--jitter", options.jitter,
                   "Measure Flips of reflections too: classes that change where the camera moves by a hundredth of a "
                   "pixel; 16 runs more of each method");
    bench.add_option("--rounds", options.rounds, "Each runs every method once; the median counts; default: 9")
        ->type_name("N")
        ->check(CLI::Range(1, 999));
    bench.add_option("--budget", options.budget, "Name the cheapest method whose errors are within these bounds")
        ->type_name("ERROR<=NUMBER,...");
    bench.add_option("-o,--output", options.output, "Folder for charts, bench.json and bench.csv")->type_name("DIR");
    bench.add_option("--compare", options.compare, "An earlier bench.json: say what moved, and fail on a loss")
        ->type_name("BASE.json");
    bench.add_option("--loss", options.loss, "Share by which something must get worse to be a loss; default: 0.05")
        ->type_name("SHARE")
        ->check(CLI::Range(0.0, 1000.0));
    addThroughput(bench, line);
    addTracers(bench, line);
    bench.callback([&line] {
        if (line.verb) return; // of a subcommand
        line.verb = [&line] {
            if (line.bench.cases.empty() && !line.bench.methods.empty()) line.bench.cases = {"yardstick/random_room"};
            if (line.bench.cases.empty())
                throw InputError(
                    "bench: name a case (those of `bench` are made for it), or one of tracers and throughput");
            return benchCases(line.global, line.bench);
        };
    });
}

void addSweep(CLI::App& app, CommandLine& line)
{
    CLI::App& verb = *app.add_subcommand("sweep", "Run a parameter of a case through the edge where its method fails");
    SweepVerbOptions& sweep = line.sweep;
    verb.add_option("case", sweep.testCase, "A case's name or file")->type_name("CASE");
    verb.add_option("parameter", sweep.parameter, "A number of the case format; several by commas take one value")
        ->type_name("PARAM");
    verb.add_option("range", sweep.range, "Such as 0.5..2.5:40 or 1..8192:14:log; default: 25 steps")
        ->type_name("FROM..TO[:STEPS][:log]");
    verb.add_option("--set", sweep.overrides, "Another key of the case, for all values; may be repeated")
        ->type_name("KEY=VALUE")
        ->expected(1)
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    verb.add_option("--backend", sweep.backends, "As for run; cpu64 is always there")
        ->type_name("NAME,...")
        ->delimiter(',')
        ->expected(1)
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    verb.add_option("-j,--jobs", sweep.jobs, "Processors to use; default: all available")
        ->type_name("N")
        ->check(CLI::Range(1, 256));
    verb.add_option("--width", sweep.width, "An edge is bisected to this share of the range; default: 0.0001")
        ->type_name("SHARE")
        ->check(CLI::Range(1e-9, 1.0));
    verb.add_option("-o,--output", sweep.output, "Folder for the curves as SVG, and for CSV and JSON")
        ->type_name("DIR");
    verb.add_option("--csv", sweep.csv, "The numbers as CSV")->type_name("FILE");
    verb.add_flag("--json", sweep.json, "The numbers as JSON on standard output, all text on standard error");
    verb.add_flag("--all", sweep.all, "Those of sweeps.toml in the case folder, with a README.md");
    verb.add_option("-k", sweep.filter, "With --all: only those with this in their id")->type_name("TEXT");
    verb.callback([&line] { line.verb = [&line] { return sweepCase(line.global, line.sweep); }; });
}

} // namespace crossray
