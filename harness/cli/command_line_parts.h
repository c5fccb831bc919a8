// The parts of the command line that its two files share.
#pragma once

#include "harness/cli/verbs.h"

#include <CLI/CLI.hpp>

#include <functional>
#include <string>

namespace crossray {

// The parsed command line; CLI11 holds references into it while it parses.
struct CommandLine {
    GlobalOptions global;
    RunOptions run;
    SelectionOptions list;
    bool listJson = false;
    std::string listCtest;
    ShowOptions show;
    TraceOptions trace;
    InspectVerbOptions inspect;
    ThroughputVerbOptions throughput;
    TracersVerbOptions tracers;
    BenchCasesOptions bench;
    BakeOptions bake;
    SweepVerbOptions sweep;
    MutateOptions mutate;
    CompileVerbOptions compile;
    bool noOptimization = false;
    std::string before, after;
    bool diffJson = false;
    ReviewOptions review;
    ReportVerbOptions report;
    std::string shell;
    bool noReport = false;
    MergeVerbOptions merge;
    bool noMergeReport = false;
    bool noCache = false;
    std::vector<std::string> cacheParts;
    bool reviewList = false;
    std::string github = "auto";
    std::string workerBackend;
    int requestFd = -1, replyFd = -1;
    bool workerValidation = false;
    bool stopAtFirst = false;
    std::function<int()> verb;
};

// Which cases: what several verbs take alike.
void addSelection(CLI::App& verb, SelectionOptions& selection);

// The verbs that measure.
void addBench(CLI::App& app, CommandLine& line);
void addSweep(CLI::App& app, CommandLine& line);
void addMutate(CLI::App& app, CommandLine& line);

} // namespace crossray
