#include "harness/compile/compile.h"

#include "harness/compile/source.h"

#include <fmt/format.h>

#include <regex>
#include <sstream>

namespace crossray {

namespace {

struct MappedLine {
    std::string file;
    int line = 0;
};

// The source line that line `generatedLine` of the generated text came from.
std::optional<MappedLine> mapLine(const std::string& glsl, int generatedLine)
{
    static const std::regex directive(R"re(^\s*#line\s+(\d+)\s+"([^"]*)")re");
    std::optional<MappedLine> mapped;
    std::string_view rest = glsl;
    for (int line = 1; line <= generatedLine && !rest.empty(); ++line) {
        const std::string text(rest.substr(0, rest.find('\n')));
        rest.remove_prefix(std::min(rest.size(), text.size() + 1));
        std::smatch match;
        // The directive numbers the line after it; what follows until the next one came from that one source line.
        if (text.find("#line") != std::string::npos && std::regex_search(text, match, directive)) {
            mapped = MappedLine{match[2], std::stoi(match[1])};
        }
    }
    return mapped;
}

std::string pathOf(const std::string& name, const std::filesystem::path& includeRoot)
{
    std::error_code ignored;
    if (includeRoot.empty() || !std::filesystem::exists(includeRoot / name, ignored)) return name;
    return displayPath(std::filesystem::absolute(includeRoot / name));
}

std::string mapOneMessage(const std::string& message, const std::string& glsl, const std::filesystem::path& includeRoot)
{
    if (message.size() > 10000) return message; // std::regex recurses over what it matches
    // Mesa: 0:12(3): error: text, or "file":12(3): error: text where it followed a #line. Others: 0:12: text, ERROR:
    // 0:12: text.
    static const std::regex named(R"re(^(?:ERROR:\s*)?"([^"]+)":(\d{1,8})(?:\(\d+\))?:\s*(.*)$)re");
    static const std::regex numbered(R"re(^(?:ERROR:\s*)?\d+:(\d{1,8})(?:\(\d+\))?:\s*(.*)$)re");
    std::smatch match;
    if (std::regex_match(message, match, named)) {
        return fmt::format("{}:{}: {}", pathOf(match[1], includeRoot), match[2].str(), match[3].str());
    }
    if (std::regex_match(message, match, numbered)) {
        if (const std::optional<MappedLine> mapped = mapLine(glsl, std::stoi(match[1]))) {
            return fmt::format("{}:{}: {}", pathOf(mapped->file, includeRoot), mapped->line, match[2].str());
        }
    }
    return message;
}

} // namespace

std::string blankLineDirectives(const std::string& generatedGlsl)
{
    std::string result;
    std::istringstream lines(generatedGlsl);
    for (std::string line; std::getline(lines, line);) {
        const bool directive =
            line.starts_with("#line ") || line.starts_with("#extension GL_GOOGLE_cpp_style_line_directive");
        result += directive ? "\n" : line + "\n";
    }
    return result;
}

std::string mapDriverMessage(const std::string& message, const std::string& generatedGlsl,
                             const std::filesystem::path& includeRoot)
{
    std::string result;
    std::string_view rest = message;
    while (!rest.empty()) {
        const std::string_view line = rest.substr(0, rest.find('\n'));
        const bool ended = line.size() < rest.size();
        result += mapOneMessage(std::string(line), generatedGlsl, includeRoot);
        if (ended) result += '\n';
        rest.remove_prefix(line.size() + (ended ? 1 : 0));
    }
    return result;
}

} // namespace crossray
