#include "tests/shader/glsl/glsl_code.h"

#include "harness/base/text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>

namespace crossray {

namespace {

bool isWordStart(char c)
{
    return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_';
}
bool isDigit(char c)
{
    return std::isdigit(static_cast<unsigned char>(c)) != 0;
}
bool isWord(const std::string& text)
{
    return isWordStart(text.front());
}
bool isNumber(const std::string& text)
{
    return isDigit(text.front()) || (text.size() > 1 && text.front() == '.');
}

// The length of the number at the start: digits, a point, an exponent with its sign, suffixes.
size_t numberLength(std::string_view text)
{
    size_t length = 0;
    while (length < text.size()) {
        const char c = text[length];
        const bool isSign =
            (c == '+' || c == '-') && length > 0 && (text[length - 1] == 'e' || text[length - 1] == 'E');
        if (!isDigit(c) && c != '.' && !isWordStart(c) && !isSign) break;
        ++length;
    }
    return length;
}

size_t symbolLength(std::string_view text)
{
    constexpr std::array<std::string_view, 21> kLong{"<<=", ">>=", "==", "!=", "<=", ">=", "&&", "||", "^^", "+=", "-=",
                                                     "*=",  "/=",  "%=", "&=", "|=", "^=", "++", "--", "<<", ">>"};
    for (const std::string_view symbol : kLong) {
        if (text.starts_with(symbol)) return symbol.size();
    }
    return 1;
}

// Where what is opened at `open` is closed.
size_t findEnd(const std::vector<GlslToken>& tokens, size_t open)
{
    int depth = 0;
    for (size_t i = open; i < tokens.size(); ++i) {
        const std::string& text = tokens[i].text;
        if (text == "(" || text == "[") ++depth;
        if ((text == ")" || text == "]") && --depth == 0) return i;
    }
    return tokens.size() - 1;
}

size_t findStart(const std::vector<GlslToken>& tokens, size_t close)
{
    int depth = 0;
    for (size_t i = close + 1; i-- > 0;) {
        if (tokens[i].text == ")") ++depth;
        if (tokens[i].text == "(" && --depth == 0) return i;
    }
    return 0;
}

// As clang-format would have it on one line, near enough to read.
std::string join(const std::vector<GlslToken>& tokens, size_t first, size_t last)
{
    constexpr std::string_view kTight = "()[].";
    std::string code;
    for (size_t i = first; i <= last; ++i) {
        const std::string& text = tokens[i].text;
        const std::string before = i > first ? tokens[i - 1].text : "(";
        const bool isUnary = (before == "-" || before == "+") && i >= first + 2 && !isWord(tokens[i - 2].text) &&
                             !isNumber(tokens[i - 2].text) && tokens[i - 2].text != ")" && tokens[i - 2].text != "]";
        const bool isFirstSign = (before == "-" || before == "+") && i == first + 1;
        const bool touches =
            before == "(" || before == "[" || before == "." || before == "++" || before == "--" || before == "!" ||
            text == ")" || text == "]" || text == "," || text == ";" || text == "." ||
            ((text == "(" || text == "[") && kTight.find(before) == std::string_view::npos && isWord(before)) ||
            isUnary || isFirstSign;
        code += (touches ? "" : " ") + text;
    }
    return code;
}

// The operand at `first`: signs, then a name, a number or brackets, then what is called, indexed or picked of it.
size_t findOperandEnd(const std::vector<GlslToken>& tokens, size_t first)
{
    size_t i = first;
    while (tokens[i].text == "-" || tokens[i].text == "+")
        ++i;
    if (tokens[i].text == "(") i = findEnd(tokens, i);
    while (i + 1 < tokens.size()) {
        const std::string& next = tokens[i + 1].text;
        if (next == "(" || next == "[") {
            i = findEnd(tokens, i + 1);
        } else if (next == ".") {
            i += 2;
        } else {
            break;
        }
    }
    return i;
}

bool isConstantBeside0(const std::vector<GlslToken>& tokens, size_t first, size_t last)
{
    while (first < last && (tokens[first].text == "-" || tokens[first].text == "+"))
        ++first;
    return first == last && isNumber(tokens[first].text) && std::strtod(tokens[first].text.c_str(), nullptr) != 0.0;
}

bool isHazardousCall(const std::string& name)
{
    constexpr std::array<std::string_view, 22> kCalls{
        "sqrt", "inversesqrt", "normalize", "log",   "log2",    "pow",       "exp",  "exp2",
        "acos", "asin",        "atan",      "acosh", "atanh",   "tan",       "sinh", "cosh",
        "mod",  "modf",        "refract",   "ldexp", "inverse", "smoothstep"};
    return std::find(kCalls.begin(), kCalls.end(), name) != kCalls.end();
}

// Calls `visit(token, function)` for each token, with the function that it stands in.
template <class Visit>
void walk(const std::vector<GlslToken>& tokens, const Visit& visit)
{
    int depth = 0;
    std::string function;
    for (size_t i = 0; i < tokens.size(); ++i) {
        if (tokens[i].text == "{" && depth++ == 0 && i > 0 && tokens[i - 1].text == ")") {
            const size_t open = findStart(tokens, i - 1);
            function = open > 0 ? tokens[open - 1].text : "";
        }
        if (tokens[i].text == "}" && --depth == 0) function.clear();
        visit(i, function);
    }
}

} // namespace

std::string readSource(const std::filesystem::path& file)
{
    return readText(file).value_or("");
}

std::vector<GlslToken> lexGlsl(std::string_view text)
{
    std::vector<GlslToken> tokens;
    int line = 1;
    bool isLineStart = true;
    for (size_t i = 0; i < text.size();) {
        const std::string_view rest = text.substr(i);
        size_t length = 1;
        bool isCode = false;
        if (rest.starts_with("//") || (rest[0] == '#' && isLineStart)) {
            // A backslash at a line's end goes on with it.
            while (length < rest.size() && (rest[length] != '\n' || rest[length - 1] == '\\'))
                ++length;
        } else if (rest.starts_with("/*")) {
            const size_t end = rest.find("*/", 2);
            length = end == std::string_view::npos ? rest.size() : end + 2;
        } else if (isWordStart(rest[0])) {
            isCode = true;
            while (length < rest.size() && (isWordStart(rest[length]) || isDigit(rest[length])))
                ++length;
        } else if (isDigit(rest[0]) || (rest[0] == '.' && rest.size() > 1 && isDigit(rest[1]))) {
            isCode = true;
            length = numberLength(rest);
        } else if (std::isspace(static_cast<unsigned char>(rest[0])) == 0) {
            isCode = true;
            length = symbolLength(rest);
        }
        if (isCode) tokens.push_back({std::string(rest.substr(0, length)), line});
        isLineStart = rest[0] == '\n' || (isLineStart && !isCode);
        line += static_cast<int>(std::count(rest.begin(), rest.begin() + static_cast<std::ptrdiff_t>(length), '\n'));
        i += length;
    }
    return tokens;
}

std::vector<GlslPlace> findHazards(const std::vector<GlslToken>& tokens, const std::string& file)
{
    std::vector<GlslPlace> places;
    walk(tokens, [&](size_t i, const std::string& function) {
        const std::string& text = tokens[i].text;
        if (i + 1 >= tokens.size()) return;
        if (text == "/" || text == "%" || text == "/=" || text == "%=") {
            const size_t last = findOperandEnd(tokens, i + 1);
            if (!isConstantBeside0(tokens, i + 1, last))
                places.push_back({file, function, tokens[i].line, text + " " + join(tokens, i + 1, last)});
        } else if (isHazardousCall(text) && tokens[i + 1].text == "(") {
            places.push_back({file, function, tokens[i].line, join(tokens, i, findEnd(tokens, i + 1))});
        }
    });
    return places;
}

std::vector<GlslPlace> findLoops(const std::vector<GlslToken>& tokens, const std::string& file)
{
    std::vector<GlslPlace> places;
    walk(tokens, [&](size_t i, const std::string& function) {
        const std::string& text = tokens[i].text;
        if (text == "do") places.push_back({file, function, tokens[i].line, "do"});
        if (text != "for" && text != "while") return;
        places.push_back({file, function, tokens[i].line, join(tokens, i + 2, findEnd(tokens, i + 1) - 1)});
    });
    return places;
}

} // namespace crossray
