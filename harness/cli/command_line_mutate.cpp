#include "harness/cli/command_line_parts.h"

namespace crossray {

void addMutate(CLI::App& app, CommandLine& line)
{
    MutateOptions& options = line.mutate;
    CLI::App& verb = *app.add_subcommand("mutate", "Plant small bugs in the shader library: which do the cases catch?");
    addSelection(verb, options.selection);
    verb.add_option("--shader", options.shaders,
                    "A file or folder of the shader library; may be repeated; default: crossray")
        ->type_name("PATH")
        ->expected(1)
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    verb.add_option("--mutant", options.mutants, "Only those with this in their line of --list; may be repeated")
        ->type_name("TEXT")
        ->expected(1)
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    verb.add_option("--sample", options.sample, "So many of them, drawn at random")
        ->type_name("N")
        ->check(CLI::Range(size_t{1}, size_t{1000000}));
    verb.add_option("--seed", options.seed, "Of the sample; default: 1")->type_name("N");
    verb.add_option("--backend", options.backend, "Where the cases run; default: lavapipe")->type_name("NAME");
    verb.add_option("-j,--jobs", options.jobs, "Processors to use; default: all available")
        ->type_name("N")
        ->check(CLI::Range(1, 256));
    verb.add_option("--idle", options.idleTries,
                    "Look for cases that catch nothing: each that was never the first is asked about up to N mutants")
        ->type_name("N")
        ->check(CLI::Range(1, 10000));
    verb.add_option(
            "--ask", options.askAtMost,
            "Ask at most N cases about a mutant, the likeliest first, before it counts as survived; default: all")
        ->type_name("N")
        ->check(CLI::Range(size_t{1}, size_t{1000000}));
    verb.add_option("--again", options.again,
                    "A mutation.json: what it tells as caught counts as that, and the others are asked about again")
        ->type_name("FILE");
    verb.add_option("--min-score", options.minScore, "Exit code 1 below this score")
        ->type_name("PERCENT")
        ->check(CLI::Range(0.0, 100.0));
    verb.add_option("--equivalents", options.equivalents,
                    "Mutants that cannot be caught; default: tests/mutation/equivalent.toml beside the shader folder")
        ->type_name("FILE");
    verb.add_flag("--try-equivalents", options.tryEquivalents, "Run those, too");
    verb.add_flag("--list", options.list, "Print the mutants and run none");
    verb.add_option("--json", options.json, "All results as JSON")->type_name("FILE");
    verb.add_option("-o,--output", options.output, "Folder for mutation.md, mutation.csv and mutation.json")
        ->type_name("DIR");
    verb.add_flag("-v,--verbose", options.verbose, "Each mutant as it ends, and the cases that take no part");
    verb.callback([&line] { line.verb = [&line] { return mutateShaders(line.global, line.mutate); }; });
}

} // namespace crossray
