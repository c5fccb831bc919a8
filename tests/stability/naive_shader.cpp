#include "tests/stability/naive_shader.h"

#include "harness/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>

namespace crossray {

namespace fs = std::filesystem;

namespace {

std::string readText(const fs::path& path)
{
    std::ifstream stream(path, std::ios::binary);
    if (!stream) throw InputError(fmt::format("{}: cannot be read", path.string()));
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

std::string trim(const std::string& text)
{
    const size_t begin = text.find_first_not_of(" \t\r\n");
    if (begin == std::string::npos) return {};
    return text.substr(begin, text.find_last_not_of(" \t\r\n") - begin + 1);
}

// Comments and preprocessor lines as blanks, so that places stay and braces in them count for nothing.
std::string blankComments(std::string text)
{
    const auto blank = [&](size_t from, size_t to) {
        for (size_t i = from; i < std::min(to, text.size()); ++i) {
            if (text[i] != '\n') text[i] = ' ';
        }
    };
    for (size_t i = 0; i < text.size(); ++i) {
        const bool startsLine = i == 0 || text[i - 1] == '\n';
        if (text.compare(i, 2, "//") == 0 || (startsLine && text[i] == '#')) {
            blank(i, text.find('\n', i));
        } else if (text.compare(i, 2, "/*") == 0) {
            const size_t close = text.find("*/", i + 2);
            blank(i, close == std::string::npos ? text.size() : close + 2);
        }
    }
    return text;
}

size_t findClose(const std::string& text, size_t open, char opening, char closing)
{
    int depth = 0;
    for (size_t i = open; i < text.size(); ++i) {
        if (text[i] == opening) ++depth;
        if (text[i] == closing && --depth == 0) return i;
    }
    return std::string::npos;
}

std::string oneBlankEach(const std::string& text)
{
    std::string result;
    for (const char c : trim(text)) {
        const bool isBlank = std::isspace(static_cast<unsigned char>(c)) != 0;
        if (!isBlank) result += c;
        if (isBlank && result.back() != ' ') result += ' ';
    }
    return result;
}

// The types of a parameter list: what parameters are called is nobody's business.
std::string listTypes(const std::string& parameters)
{
    std::string types;
    std::istringstream list(parameters);
    for (std::string parameter; std::getline(list, parameter, ',');) {
        const std::string words = oneBlankEach(parameter);
        types += (types.empty() ? "" : ",") + words.substr(0, words.rfind(' '));
    }
    return types;
}

// Of "float f(vec3 a, int b)"; nothing where the text before a brace is no head of a function.
std::optional<std::string> readSignature(const std::string& head)
{
    const size_t open = head.find('(');
    if (open == std::string::npos || head.find('=') != std::string::npos) return std::nullopt;
    const size_t close = findClose(head, open, '(', ')');
    if (close == std::string::npos || !trim(head.substr(close + 1)).empty()) return std::nullopt;
    return fmt::format("{}({})", oneBlankEach(head.substr(0, open)),
                       listTypes(head.substr(open + 1, close - open - 1)));
}

std::string functionOf(const std::string& signature)
{
    const std::string head = signature.substr(0, signature.find('('));
    return head.substr(head.rfind(' ') + 1);
}

std::vector<FunctionPlace> findNamed(const std::vector<FunctionPlace>& functions, const std::string& name)
{
    std::vector<FunctionPlace> found;
    std::copy_if(functions.begin(), functions.end(), std::back_inserter(found),
                 [&](const FunctionPlace& place) { return functionOf(place.signature) == name; });
    return found;
}

} // namespace

std::vector<FunctionPlace> findFunctions(const std::string& text)
{
    const std::string code = blankComments(text);
    std::vector<FunctionPlace> found;
    size_t begin = 0; // of the statement at file scope
    for (size_t i = 0; i < code.size(); ++i) {
        if (code[i] == ';') begin = i + 1;
        if (code[i] != '{') continue;
        const size_t close = findClose(code, i, '{', '}');
        if (close == std::string::npos) break;
        const std::string head = code.substr(begin, i - begin);
        if (const auto signature = readSignature(head)) {
            found.push_back({*signature, begin + head.find_first_not_of(" \t\r\n"), close + 1});
        }
        i = close;
        begin = close + 1;
    }
    return found;
}

NaiveShader readNaiveShader(const fs::path& path)
{
    NaiveShader naive{path, path.filename().string().substr(0, 2), {}, {}, readText(path)};
    const std::string name = path.filename().string();
    const bool isNumbered = name.size() > 3 && std::isdigit(static_cast<unsigned char>(name[0])) != 0 &&
                            std::isdigit(static_cast<unsigned char>(name[1])) != 0 && name[2] == '_';
    if (!isNumbered) throw InputError(fmt::format("{}: the name opens with no situation's number", path.string()));

    std::istringstream lines(naive.text);
    bool isFails = false;
    for (std::string line; std::getline(lines, line) && line.starts_with("//");) {
        const std::string text = trim(line.substr(2));
        if (text.starts_with("Replaces: ")) {
            std::istringstream words(text.substr(10));
            ReplacedFunction replaced;
            words >> replaced.file >> replaced.function;
            naive.replaces.push_back(replaced);
            isFails = false;
        } else if (text.starts_with("On: ")) {
            naive.backend = text.substr(4);
            isFails = false;
        } else if (text.starts_with("Fails: ")) {
            naive.fails = text.substr(7);
            isFails = true;
        } else if (isFails) {
            naive.fails += " " + text;
        }
    }
    if (naive.replaces.empty() || naive.fails.empty()) {
        throw InputError(
            fmt::format("{}: the head needs \"// Replaces: FILE FUNCTION\" and \"// Fails: SENTENCE\"", path.string()));
    }
    return naive;
}

void writeNaiveTree(const fs::path& shaders, const NaiveShader& naive, const fs::path& target)
{
    fs::copy(shaders, target, fs::copy_options::recursive | fs::copy_options::overwrite_existing);
    const std::vector<FunctionPlace> forms = findFunctions(naive.text);
    std::map<std::string, std::string> changed; // text by file
    for (const ReplacedFunction& replaced : naive.replaces) {
        const std::vector<FunctionPlace> form = findNamed(forms, replaced.function);
        if (form.size() != 1) {
            throw InputError(fmt::format("{}: {} is defined {} times; once is allowed", naive.path.string(),
                                         replaced.function, form.size()));
        }
        if (!changed.contains(replaced.file)) changed[replaced.file] = readText(target / replaced.file);
        std::string& text = changed[replaced.file];
        std::vector<FunctionPlace> original = findFunctions(text);
        std::erase_if(original, [&](const FunctionPlace& place) { return place.signature != form[0].signature; });
        if (original.size() != 1) {
            throw InputError(fmt::format("{}: {} has {} definitions of {}; one is required", naive.path.string(),
                                         replaced.file, original.size(), form[0].signature));
        }
        // With what stands between the form before it and this one.
        size_t begin = 0;
        for (const FunctionPlace& other : forms) {
            const bool isReplacing = std::any_of(naive.replaces.begin(), naive.replaces.end(), [&](const auto& each) {
                return each.function == functionOf(other.signature);
            });
            if (isReplacing && other.end <= form[0].begin) begin = std::max(begin, other.end);
        }
        text.replace(original[0].begin, original[0].end - original[0].begin,
                     naive.text.substr(begin, form[0].end - begin));
    }
    for (const auto& [file, text] : changed) {
        std::ofstream(target / file, std::ios::binary | std::ios::trunc) << text;
    }
}

} // namespace crossray
