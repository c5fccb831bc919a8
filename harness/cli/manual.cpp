#include "harness/cli/manual.h"

#include "harness/cli/failure_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <functional>

namespace crossray {

namespace {

// Text that roff prints as it stands.
std::string escapeRoff(std::string_view text)
{
    std::string escaped;
    for (const char character : text) {
        if (character == '\\') {
            escaped += "\\e";
        } else if (character == '-') {
            escaped += "\\-";
        } else if (character == '\n') {
            escaped += ' ';
        } else {
            escaped += character;
        }
    }
    // A line that begins with a dot or a quote is a command.
    if (!escaped.empty() && (escaped[0] == '.' || escaped[0] == '\'')) escaped.insert(0, "\\&");
    return escaped;
}

std::string escapeForRoffArgument(std::string_view text)
{
    std::string escaped = escapeRoff(text);
    for (size_t at = escaped.find('"'); at != std::string::npos; at = escaped.find('"', at + 4))
        escaped.replace(at, 1, "\\(dq");
    return escaped;
}

void addOptions(const std::vector<OptionDescription>& options, std::string& page)
{
    for (const OptionDescription& option : options) {
        if (option.isHidden) continue;
        std::vector<std::string> names;
        for (const std::string& name : option.names)
            names.push_back(fmt::format("\\fB{}\\fR", escapeRoff(name)));
        const std::string value = option.value.empty() ? "" : fmt::format("\\fI{}\\fR", escapeRoff(option.value));
        const std::string space = names.empty() || value.empty() ? "" : " ";
        page += fmt::format(".TP\n{}{}{}\n{}.\n", fmt::join(names, ", "), space, value, escapeRoff(option.text));
    }
}

std::string formatSynopsis(const CommandDescription& command, const std::string& path)
{
    std::string line = fmt::format(".B {}\n", escapeRoff(path));
    const bool hasOptions = std::any_of(command.options.begin(), command.options.end(),
                                        [](const auto& option) { return !option.names.empty() && !option.isHidden; });
    if (hasOptions) line += "[\\fIOPTION\\fR...]\n";
    for (const OptionDescription& option : command.options) {
        if (!option.names.empty() || option.isHidden) continue;
        const std::string word = fmt::format("\\fI{}\\fR{}", escapeRoff(option.value), option.isRepeated ? "..." : "");
        line += option.isRequired ? word + "\n" : fmt::format("[{}]\n", word);
    }
    return line;
}

// Each verb with the words that lead to it.
void forEachVerb(const CommandDescription& command, const std::string& path,
                 const std::function<void(const CommandDescription&, const std::string&)>& visit)
{
    for (const CommandDescription& verb : command.verbs) {
        const std::string own = path.empty() ? verb.name : path + " " + verb.name;
        visit(verb, own);
        forEachVerb(verb, own, visit);
    }
}

bool takesCases(const CommandDescription& command)
{
    return std::any_of(command.options.begin(), command.options.end(), [](const OptionDescription& option) {
        return option.names.empty() && option.value.starts_with("CASE");
    });
}

std::vector<std::string> namesOf(const CommandDescription& command)
{
    std::vector<std::string> names;
    for (const OptionDescription& option : command.options) {
        if (!option.isHidden) names.insert(names.end(), option.names.begin(), option.names.end());
    }
    return names;
}

std::vector<std::string> verbsOf(const CommandDescription& command)
{
    std::vector<std::string> names;
    for (const CommandDescription& verb : command.verbs)
        names.push_back(verb.name);
    return names;
}

// What may follow an option, as words; nothing: a file.
std::vector<std::string> wordsAfter(const OptionDescription& option)
{
    if (std::find(option.names.begin(), option.names.end(), "--backend") != option.names.end()) {
        return {"all", "lavapipe", "osmesa", "swiftshader", "softpipe", "egl", "cpu32", "cpu64"};
    }
    return option.choices();
}

// Words that a positional argument chooses from.
std::vector<std::string> positionalWordsOf(const CommandDescription& command)
{
    std::vector<std::string> words;
    for (const OptionDescription& option : command.options) {
        const std::vector<std::string> choices = option.names.empty() ? option.choices() : std::vector<std::string>{};
        words.insert(words.end(), choices.begin(), choices.end());
    }
    return words;
}

// One name for each path of words: "bench tracers" is bench_tracers.
std::string functionName(std::string path)
{
    std::replace(path.begin(), path.end(), ' ', '_');
    return path;
}

std::string formatBash(const CommandDescription& program)
{
    std::string text = fmt::format("# bash completion for {0}\n_{0}()\n{{\n", program.name);
    text += "    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} path='' i\n"
            "    local verbs options cases=no\n"
            "    for ((i = 1; i < COMP_CWORD; i++)); do\n"
            "        case \"$path ${COMP_WORDS[i]}\" in\n";
    std::vector<std::string> paths;
    forEachVerb(program, "",
                [&](const CommandDescription&, const std::string& path) { paths.push_back("' " + path + "'"); });
    text += fmt::format("            {}) path=\"$path ${{COMP_WORDS[i]}}\" ;;\n        esac\n    done\n",
                        fmt::join(paths, " | "));
    text += "    case \"$path\" in\n";
    const auto addBranch = [&text](const CommandDescription& command, const std::string& path) {
        text += fmt::format("        '{}') verbs={} options={} cases={}\n            case \"$before\" in\n", path,
                            quoteForShell(fmt::format("{} {}", fmt::join(verbsOf(command), " "),
                                                      fmt::join(positionalWordsOf(command), " "))),
                            quoteForShell(fmt::format("{}", fmt::join(namesOf(command), " "))),
                            takesCases(command) ? "yes" : "no");
        for (const OptionDescription& option : command.options) {
            if (option.names.empty() || option.value.empty() || option.isHidden) continue;
            const std::vector<std::string> words = wordsAfter(option);
            const std::string reply = words.empty()
                                          ? "$(compgen -f -- \"$word\")"
                                          : fmt::format("$(compgen -W '{}' -- \"$word\")", fmt::join(words, " "));
            text += fmt::format("                {}) mapfile -t COMPREPLY < <(echo \"{}\"); return ;;\n",
                                fmt::join(option.names, " | "), reply);
        }
        text += "            esac ;;\n";
    };
    addBranch(program, "");
    forEachVerb(program, "",
                [&](const CommandDescription& verb, const std::string& path) { addBranch(verb, " " + path); });
    text += fmt::format(
        "    esac\n"
        "    [[ $word == -* ]] && {{ mapfile -t COMPREPLY < <(compgen -W \"$options\" -- \"$word\"); return; }}\n"
        "    local words=$verbs\n"
        "    [ $cases = yes ] && words=\"$words $({0} list --color never 2>/dev/null | sed 's/ .*//')\"\n"
        "    mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$word\"; [ $cases = yes ] && compgen -f -- "
        "\"$word\")\n"
        "}}\ncomplete -o filenames -F _{0} {0}\n",
        program.name);
    return text;
}

// In _arguments' specifications, brackets and colons have a meaning.
std::string escapeZsh(std::string_view text)
{
    std::string escaped;
    for (const char character : text) {
        if (character == '[' || character == ']' || character == ':' || character == '\\') escaped += '\\';
        escaped += character;
    }
    return escaped;
}

std::string formatZshOption(const OptionDescription& option)
{
    const std::string names =
        option.names.size() == 1 ? option.names.front() : fmt::format("{{{}}}", fmt::join(option.names, ","));
    std::string action;
    if (!option.value.empty()) {
        const std::vector<std::string> words = wordsAfter(option);
        action = fmt::format(":{}:{}", escapeZsh(option.value),
                             words.empty() ? "_files" : fmt::format("({})", fmt::join(words, " ")));
    }
    const std::string rest = quoteForShell(fmt::format("[{}]{}", escapeZsh(option.text), action));
    return "'*'" + names + rest;
}

std::string formatZsh(const CommandDescription& program)
{
    std::string text = fmt::format("#compdef {0}\n# zsh completion for {0}\n\n"
                                   "_{0}_cases() {{\n"
                                   "    local -a names\n"
                                   "    names=(${{(f)\"$({0} list --color never 2>/dev/null | sed 's/ .*//')\"}})\n"
                                   "    compadd -a names\n    _files\n}}\n\n",
                                   program.name);
    const auto addFunction = [&](const CommandDescription& command, const std::string& path) {
        text += fmt::format("_{}{}() {{\n", program.name, path.empty() ? "" : fmt::format("_{}", functionName(path)));
        std::string specifications;
        for (const OptionDescription& option : command.options) {
            if (!option.names.empty() && !option.isHidden) specifications += " \\\n        " + formatZshOption(option);
        }
        if (!command.verbs.empty()) {
            text += "    local -a verbs\n    verbs=(\n";
            for (const CommandDescription& verb : command.verbs)
                text += "        " + quoteForShell(fmt::format("{}:{}", verb.name, escapeZsh(verb.text))) + "\n";
            text += "    )\n    local state\n    _arguments -C" + specifications +
                    " \\\n        '1: :->verb' '*:: :->rest'\n    case $state in\n"
                    "    verb) _describe 'verb' verbs" +
                    std::string(takesCases(command) ? fmt::format("; _{}_cases", program.name) : "") +
                    " ;;\n    rest)\n        case $words[1] in\n";
            for (const CommandDescription& verb : command.verbs) {
                text += fmt::format("        {}) _{}_{} ;;\n", verb.name, program.name,
                                    functionName(path.empty() ? verb.name : path + " " + verb.name));
            }
            text += "        esac ;;\n    esac\n}\n\n";
        } else {
            const std::string rest =
                takesCases(command) ? fmt::format("'*: :_{}_cases'", program.name) : "'*: :_files'";
            text += "    _arguments" + specifications + " \\\n        " + rest + "\n}\n\n";
        }
    };
    addFunction(program, "");
    forEachVerb(program, "", addFunction);
    return text + fmt::format("_{} \"$@\"\n", program.name);
}

std::string formatFish(const CommandDescription& program)
{
    std::string text = fmt::format("# fish completion for {0}\n"
                                   "function __{0}_cases\n"
                                   "    {0} list --color never 2>/dev/null | string replace -r ' .*' ''\nend\n",
                                   program.name);
    const auto add = [&](const CommandDescription& command, const std::string& path) {
        std::string condition = fmt::format("not __fish_seen_subcommand_from {}", fmt::join(verbsOf(program), " "));
        if (!path.empty()) {
            condition.clear();
            for (size_t begin = 0; begin < path.size();) {
                const size_t end = std::min(path.find(' ', begin), path.size());
                condition += fmt::format("{}__fish_seen_subcommand_from {}", condition.empty() ? "" : "; and ",
                                         path.substr(begin, end - begin));
                begin = end + 1;
            }
        }
        const std::string head = fmt::format("complete -c {} -n {}", program.name, quoteForShell(condition));
        for (const CommandDescription& verb : command.verbs)
            text += fmt::format("{} -f -a {} -d {}\n", head, verb.name, quoteForShell(verb.text));
        if (takesCases(command)) text += fmt::format("{} -a '(__{}_cases)'\n", head, program.name);
        if (const auto words = positionalWordsOf(command); !words.empty()) {
            text += fmt::format("{} -f -a '{}'\n", head, fmt::join(words, " "));
        }
        for (const OptionDescription& option : command.options) {
            if (option.names.empty() || option.isHidden) continue;
            text += head;
            for (const std::string& name : option.names)
                text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
            const std::vector<std::string> words = wordsAfter(option);
            if (!option.value.empty()) text += words.empty() ? " -r" : " -x";
            if (!words.empty()) text += fmt::format(" -a '{}'", fmt::join(words, " "));
            text += fmt::format(" -d {}\n", quoteForShell(option.text));
        }
    };
    add(program, "");
    forEachVerb(program, "", add);
    return text;
}

} // namespace

std::vector<std::string> OptionDescription::choices() const
{
    if (value.find('|') == std::string::npos) return {};
    std::vector<std::string> words;
    for (size_t begin = 0; begin <= value.size();) {
        const size_t end = std::min(value.find('|', begin), value.size());
        words.push_back(value.substr(begin, end - begin));
        begin = end + 1;
    }
    // "CASE|DIR|GLOB" says what kind of word, not which.
    const bool areWords = std::all_of(words.begin(), words.end(), [](const std::string& word) {
        return !word.empty() && std::none_of(word.begin(), word.end(), [](unsigned char c) { return std::isupper(c); });
    });
    return areWords ? words : std::vector<std::string>{};
}

std::string formatManual(const CommandDescription& program, const std::string& version, const std::string& date)
{
    std::string page = fmt::format(".TH {} 1 \"{}\" \"{} {}\" \"User Commands\"\n", "CROSSRAY",
                                   escapeForRoffArgument(date), program.name, escapeForRoffArgument(version));
    const size_t colon = program.text.find(": ");
    const std::string what = colon == std::string::npos ? program.text : program.text.substr(colon + 2);
    page += fmt::format(".SH NAME\n{} \\- {}\n.SH SYNOPSIS\n", program.name, escapeRoff(what));
    bool isFirst = true;
    forEachVerb(program, program.name, [&](const CommandDescription& verb, const std::string& path) {
        if (!isFirst) page += ".br\n";
        isFirst = false;
        page += formatSynopsis(verb, path);
    });
    page += ".SH OPTIONS\nTaken by every verb.\n";
    addOptions(program.options, page);
    page += ".SH VERBS\n";
    forEachVerb(program, program.name, [&](const CommandDescription& verb, const std::string& path) {
        page += fmt::format(".SS \"{}\"\n{}.\n", escapeForRoffArgument(path), escapeRoff(verb.text));
        addOptions(verb.options, page);
    });
    page +=
        ".SH EXIT STATUS\n"
        ".TP\n0\nAll as expected.\n"
        ".TP\n1\nA case failed, or something differs.\n"
        ".TP\n2\nUsage, configuration, or a broken case file; one line says file, line, column and what is allowed.\n"
        ".TP\n3\nA backend or folder that is needed is missing.\n"
        ".TP\n4\nNothing is selected.\n"
        ".TP\n130\nInterrupted; what was finished by then is kept.\n"
        ".SH ENVIRONMENT\n"
        ".TP\nCROSSRAY_SHADERS, CROSSRAY_CASES, CROSSRAY_CACHE\nFolders in place of \\-\\-shaders, \\-\\-cases and "
        "\\-\\-cache\\-dir.\n"
        ".TP\nNO_COLOR\nNo colours.\n"
        ".SH FILES\n"
        ".TP\nout/last/run.json\nThe last run; its planes, traces and pages are beside it.\n";
    return page;
}

std::string formatCompletion(const CommandDescription& program, Shell shell)
{
    switch (shell) {
    case Shell::kBash:
        return formatBash(program);
    case Shell::kZsh:
        return formatZsh(program);
    case Shell::kFish:
        return formatFish(program);
    }
    return {};
}

} // namespace crossray
