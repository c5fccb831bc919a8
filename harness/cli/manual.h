// The command line's own definition as plain data, and what is made of it: the man page and the shells' completions.
#pragma once

#include <string>
#include <vector>

namespace crossray {

struct OptionDescription {
    std::vector<std::string> names; // "--backend", "-j"; empty: a positional argument
    std::string value;              // what its value is called, "N"; empty: a flag, which takes none
    std::string text;
    bool isRequired = false;
    bool isHidden = false;
    bool isRepeated = false; // a positional argument that may stand several times
    // Of a value that is one of a few words: the words.
    std::vector<std::string> choices() const;
};

struct CommandDescription {
    std::string name, text;
    std::vector<OptionDescription> options;
    std::vector<CommandDescription> verbs;
};

enum class Shell { kBash, kZsh, kFish };

// A man page, section 1, in the macros of man(7). `date` as it stands in its foot.
std::string formatManual(const CommandDescription& program, const std::string& version, const std::string& date);

// A script that completes verbs, options, words that an option chooses from, backends, and the names of cases, which
// it asks the program for.
std::string formatCompletion(const CommandDescription& program, Shell shell);

} // namespace crossray
