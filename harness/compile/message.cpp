#include "harness/compile/message.h"

#include "harness/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <regex>
#include <sstream>
#include <vector>

namespace crossray {

namespace {

constexpr size_t kMaxMessages = 20;
constexpr size_t kMaxLine = 1000; // std::regex recurses over what it matches

bool isWordCharacter(char c)
{
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

std::string_view trim(std::string_view text)
{
    while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front())) != 0)
        text.remove_prefix(1);
    while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())) != 0)
        text.remove_suffix(1);
    return text;
}

bool consume(std::string_view& text, std::string_view prefix)
{
    if (!text.starts_with(prefix)) return false;
    text.remove_prefix(prefix.size());
    return true;
}

// glslang's names of operators and of the grammar's tokens.
struct Spelling {
    std::string_view name, text;
};
constexpr std::array kSpellings{
    Spelling{"assign", "="},       Spelling{"negate", "-"},        Spelling{"LEFT_BRACE", "{"},
    Spelling{"RIGHT_BRACE", "}"},  Spelling{"LEFT_PAREN", "("},    Spelling{"RIGHT_PAREN", ")"},
    Spelling{"LEFT_BRACKET", "["}, Spelling{"RIGHT_BRACKET", "]"}, Spelling{"LEFT_ANGLE", "<"},
    Spelling{"RIGHT_ANGLE", ">"},  Spelling{"SEMICOLON", ";"},     Spelling{"COMMA", ","},
    Spelling{"COLON", ":"},        Spelling{"EQUAL", "="},         Spelling{"DOT", "."},
    Spelling{"QUESTION", "?"},     Spelling{"PLUS", "+"},          Spelling{"DASH", "-"},
    Spelling{"STAR", "*"},         Spelling{"SLASH", "/"},         Spelling{"PERCENT", "%"},
    Spelling{"BANG", "!"},         Spelling{"TILDE", "~"},         Spelling{"AMPERSAND", "&"},
    Spelling{"VERTICAL_BAR", "|"}, Spelling{"CARET", "^"},         Spelling{"INC_OP", "++"},
    Spelling{"DEC_OP", "--"},      Spelling{"LE_OP", "<="},        Spelling{"GE_OP", ">="},
    Spelling{"EQ_OP", "=="},       Spelling{"NE_OP", "!="},        Spelling{"AND_OP", "&&"},
    Spelling{"OR_OP", "||"},       Spelling{"XOR_OP", "^^"},       Spelling{"LEFT_OP", "<<"},
    Spelling{"RIGHT_OP", ">>"},    Spelling{"ADD_ASSIGN", "+="},   Spelling{"SUB_ASSIGN", "-="},
    Spelling{"MUL_ASSIGN", "*="},  Spelling{"DIV_ASSIGN", "/="},
};

std::string spellingOf(std::string_view token)
{
    for (const Spelling& spelling : kSpellings) {
        if (spelling.name == token) return std::string(spelling.text);
    }
    return std::string(token);
}

// "syntax error, unexpected RIGHT_BRACE, expecting COMMA or SEMICOLON" with the characters that a person typed.
std::string spellTokens(std::string_view text)
{
    std::string result;
    while (!text.empty()) {
        size_t length = 0;
        while (length < text.size() && isWordCharacter(text[length]))
            ++length;
        const std::string_view word = text.substr(0, std::max<size_t>(length, 1));
        const std::string spelled = spellingOf(word);
        result += spelled == word ? spelled : "'" + spelled + "'";
        text.remove_prefix(word.size());
    }
    return result;
}

// The token that a syntax error did not expect. Keywords are named in capitals.
std::string unexpectedToken(std::string_view text)
{
    constexpr std::string_view kMark = "unexpected ";
    const size_t at = text.find(kMark);
    if (at == std::string_view::npos) return {};
    text.remove_prefix(at + kMark.size());
    const std::string_view name = text.substr(0, text.find(','));
    std::string token = spellingOf(name);
    if (token == name) {
        std::transform(token.begin(), token.end(), token.begin(),
                       [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    }
    return token;
}

std::string formatMessage(const SourceFile& file, int line, int column, std::string_view token, std::string_view text)
{
    const std::string subject = token.empty() ? std::string{} : fmt::format("'{}': ", token);
    return SourcePosition{displayPath(file.path), line, column}.format() + ": error: " + subject +
           std::string(trim(text));
}

// "name:line: 'token' : text" with a known name.
std::string rewriteLocated(std::string_view message, const SourceFile& file)
{
    std::string_view rest = message.substr(file.name.size() + 1);
    int line = 0;
    const auto parsed = std::from_chars(rest.data(), rest.data() + rest.size(), line);
    rest.remove_prefix(static_cast<size_t>(parsed.ptr - rest.data()));
    consume(rest, ":");
    rest = trim(rest);
    std::string_view token;
    if (consume(rest, "'")) {
        const size_t end = rest.find("' : ");
        if (end != std::string_view::npos) {
            token = rest.substr(0, end);
            rest.remove_prefix(end + 4);
        }
    }
    rest = trim(rest);
    const std::string_view sourceLine = lineOf(file.text, line);
    if (token == "#include") {
        constexpr std::string_view kSuffix = " for header name: ";
        if (const size_t at = rest.rfind(kSuffix); at != std::string_view::npos) {
            const std::string_view header = trim(rest.substr(at + kSuffix.size()));
            return formatMessage(file, line, findColumn(sourceLine, header), header, rest.substr(0, at));
        }
    }
    if (rest.starts_with("syntax error")) {
        const std::string sought = token.empty() ? unexpectedToken(rest) : std::string(token);
        return formatMessage(file, line, findColumn(sourceLine, sought), token, spellTokens(rest));
    }
    return formatMessage(file, line, findColumn(sourceLine, spellingOf(token)), token, rest);
}

// "odd(f1; calling even(f1;" of a recursion: where the caller is written.
std::string rewriteRecursion(std::string_view message, const SourceSet& sources, const SourceFile& entry)
{
    const std::string caller(message.substr(0, message.find('(')));
    const std::regex definition("\\b(?!return\\b|else\\b)\\w+\\s+(" + caller +
                                ")\\s*\\("); // a type stands before the name
    for (const SourceFile& file : sources.files()) {
        std::istringstream lines(file.text);
        std::string text;
        for (int line = 1; std::getline(lines, text); ++line) {
            std::smatch match;
            if (text.size() > kMaxLine || trim(text).ends_with(';') || !std::regex_search(text, match, definition))
                continue;
            return formatMessage(file, line, static_cast<int>(match.position(1)) + 1, caller,
                                 "recursion is not allowed");
        }
    }
    return formatMessage(entry, 0, 0, caller, "recursion is not allowed");
}

} // namespace

int findColumn(std::string_view line, std::string_view token)
{
    if (token.empty()) return 0;
    for (size_t at = line.find(token); at != std::string_view::npos; at = line.find(token, at + 1)) {
        const size_t end = at + token.size();
        const bool cutsBefore = at > 0 && isWordCharacter(token.front()) && isWordCharacter(line[at - 1]);
        const bool cutsAfter = end < line.size() && isWordCharacter(token.back()) && isWordCharacter(line[end]);
        if (!cutsBefore && !cutsAfter) return static_cast<int>(at) + 1;
    }
    return 0;
}

std::string rewriteMessages(const std::string& log, const SourceSet& sources, const SourceFile& entry)
{
    std::vector<std::string> messages;
    std::string_view rest = log;
    while (!rest.empty()) {
        std::string_view line = rest.substr(0, rest.find('\n'));
        rest.remove_prefix(std::min(rest.size(), line.size() + 1));
        line = trim(line);
        if (line.empty() || line.starts_with("WARNING:")) continue;
        if (line.find("compilation errors.") != std::string_view::npos) continue;
        if (line.find("compilation terminated") != std::string_view::npos && !messages.empty()) continue;
        if (line.ends_with("Recursion detected:") || line.find(kAfterFailure) != std::string_view::npos) continue;
        if (messages.size() == kMaxMessages) {
            messages.push_back("more errors follow");
            break;
        }
        if (line.find(" calling ") != std::string_view::npos) {
            messages.push_back(rewriteRecursion(line, sources, entry));
            continue;
        }
        consume(line, "ERROR: ");
        const SourceFile* named = nullptr;
        for (const SourceFile& file : sources.files()) {
            if (line.starts_with(file.name + ":") && (named == nullptr || named->name.size() < file.name.size()))
                named = &file;
        }
        messages.push_back(named != nullptr ? rewriteLocated(line, *named) : formatMessage(entry, 0, 0, "", line));
    }
    if (messages.empty())
        messages.push_back(formatMessage(entry, 0, 0, "", "the compiler refused it without a message"));
    return fmt::format("{}", fmt::join(messages, "\n"));
}

} // namespace crossray
