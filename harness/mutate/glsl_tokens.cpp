#include "harness/mutate/glsl_tokens.h"

#include <algorithm>
#include <array>
#include <cctype>

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

bool isWordPart(char c)
{
    return isWordStart(c) || isDigit(c);
}

// Walks over a text and knows the line and the column.
class Reader {
  public:
    explicit Reader(std::string_view text) : text_(text) {}

    bool atEnd() const { return at_ >= text_.size(); }
    std::string_view rest() const { return text_.substr(at_); }
    char peek(size_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }
    bool atLineStart() const { return lineIsBlank_; }
    void skip(size_t count)
    {
        for (; count > 0 && !atEnd(); --count, ++at_) {
            if (text_[at_] == '\n') {
                ++line_;
                lineBegin_ = at_ + 1;
                lineIsBlank_ = true;
            } else if (text_[at_] != ' ' && text_[at_] != '\t') {
                lineIsBlank_ = false;
            }
        }
    }
    // To the end of the line, over lines that end in a backslash.
    void skipDirective()
    {
        while (!atEnd() && peek() != '\n') {
            if (rest().starts_with("//") || rest().starts_with("/*")) return;
            skip(peek() == '\\' && peek(1) == '\n' ? 2 : 1);
        }
    }
    GlslToken take(GlslToken::Kind kind, size_t length)
    {
        const GlslToken token{kind, text_.substr(at_, length), at_, line_, static_cast<int>(at_ - lineBegin_) + 1};
        skip(length);
        return token;
    }

  private:
    std::string_view text_;
    size_t at_ = 0, lineBegin_ = 0;
    int line_ = 1;
    bool lineIsBlank_ = true;
};

// "1", "0.5", ".5", "1e-30", "3u", "2.0lf".
size_t lengthOfNumber(std::string_view text)
{
    size_t length = 0;
    while (length < text.size()) {
        const char c = text[length];
        const bool isExponentSign = (c == '+' || c == '-') && length > 0 && !text.starts_with("0x") &&
                                    (text[length - 1] == 'e' || text[length - 1] == 'E');
        if (!isWordPart(c) && c != '.' && !isExponentSign) break;
        ++length;
    }
    return length;
}

size_t lengthOfSymbol(std::string_view text)
{
    static constexpr std::array<std::string_view, 22> kLong{
        "<<=", ">>=", "<<", ">>", "<=", ">=", "==", "!=", "&&", "||", "^^",
        "++",  "--",  "+=", "-=", "*=", "/=", "%=", "&=", "|=", "^=", "::"};
    for (const std::string_view symbol : kLong) {
        if (text.starts_with(symbol)) return symbol.size();
    }
    return 1;
}

size_t lengthOfWord(std::string_view text)
{
    return static_cast<size_t>(std::find_if_not(text.begin(), text.end(), isWordPart) - text.begin());
}

} // namespace

std::vector<GlslToken> lexGlsl(std::string_view source)
{
    std::vector<GlslToken> tokens;
    Reader reader(source);
    while (!reader.atEnd()) {
        const std::string_view rest = reader.rest();
        const char c = rest[0];
        if (std::isspace(static_cast<unsigned char>(c)) != 0) {
            reader.skip(1);
        } else if (rest.starts_with("//")) {
            reader.skip(std::min(rest.find('\n'), rest.size()));
        } else if (rest.starts_with("/*")) {
            const size_t end = rest.find("*/", 2);
            reader.skip(end == std::string_view::npos ? rest.size() : end + 2);
        } else if (c == '#' && reader.atLineStart()) {
            reader.skipDirective();
        } else if (c == '"') {
            const size_t end = rest.find('"', 1);
            reader.skip(end == std::string_view::npos ? rest.size() : end + 1);
        } else if (isWordStart(c)) {
            tokens.push_back(reader.take(GlslToken::Kind::kWord, lengthOfWord(rest)));
        } else if (isDigit(c) || (c == '.' && isDigit(reader.peek(1)))) {
            tokens.push_back(reader.take(GlslToken::Kind::kNumber, lengthOfNumber(rest)));
        } else {
            tokens.push_back(reader.take(GlslToken::Kind::kSymbol, lengthOfSymbol(rest)));
        }
    }
    return tokens;
}

int precedenceOf(std::string_view symbol)
{
    struct Level {
        int precedence;
        std::string_view symbols; // between blanks
    };
    static constexpr std::array<Level, 13> kLevels{{{1, " * / % "},
                                                    {2, " + - "},
                                                    {3, " << >> "},
                                                    {4, " < > <= >= "},
                                                    {5, " == != "},
                                                    {6, " & "},
                                                    {7, " ^ "},
                                                    {8, " | "},
                                                    {9, " && "},
                                                    {10, " ^^ "},
                                                    {11, " || "},
                                                    {12, " ? : "},
                                                    {13, " = += -= *= /= %= &= |= ^= <<= >>= "}}};
    for (const Level& level : kLevels) {
        const size_t at = level.symbols.find(symbol);
        if (at == std::string_view::npos || at == 0 || symbol.empty()) continue;
        if (level.symbols[at - 1] == ' ' && level.symbols[at + symbol.size()] == ' ') return level.precedence;
    }
    return 0;
}

GlslSource::GlslSource(std::string_view text) : text_(text), tokens_(lexGlsl(text))
{
    matchBrackets();
    findFunctions();
}

void GlslSource::matchBrackets()
{
    partners_.assign(tokens_.size(), kNone);
    std::vector<size_t> open;
    for (size_t i = 0; i < tokens_.size(); ++i) {
        const std::string_view text = tokens_[i].text;
        if (text == "(" || text == "[" || text == "{") open.push_back(i);
        if (text != ")" && text != "]" && text != "}") continue;
        if (open.empty()) continue;
        partners_[i] = open.back();
        partners_[open.back()] = i;
        open.pop_back();
    }
}

void GlslSource::findFunctions()
{
    for (size_t i = 2; i < tokens_.size(); ++i) {
        if (tokens_[i].is("{") && tokens_[i - 1].is(")") && partners_[i] != kNone && partners_[i - 1] != kNone &&
            partners_[i - 1] > 0) {
            const size_t name = partners_[i - 1] - 1;
            GlslFunction function{tokens_[name].text, i, partners_[i], {}};
            findVariables(function, name + 1);
            functions_.push_back(std::move(function));
            i = partners_[i];
        } else if (tokens_[i].is("{") && partners_[i] != kNone) { // a struct or a block
            i = partners_[i];
        }
    }
}

// "type name" where a declaration can stand: behind a bracket, a comma of the parameters, or the end of a statement.
void GlslSource::findVariables(GlslFunction& function, size_t firstToken) const
{
    for (size_t i = firstToken; i + 2 < function.close; ++i) {
        const GlslToken& before = tokens_[i];
        const bool canStand = before.is("(") || before.is(";") || before.is("{") || before.is("}") || before.is("in") ||
                              before.is("const") || (before.is(",") && i < function.open);
        const GlslToken &type = tokens_[i + 1], &name = tokens_[i + 2];
        if (!canStand || type.kind != GlslToken::Kind::kWord || name.kind != GlslToken::Kind::kWord) continue;
        if (type.is("return") || type.is("else") || type.is("const") || type.is("in")) continue;
        function.variables.push_back({type.text, name.text});
    }
}

const GlslFunction* GlslSource::functionAt(size_t token) const
{
    const auto found = std::find_if(functions_.begin(), functions_.end(), [&](const GlslFunction& function) {
        return function.open < token && token < function.close;
    });
    return found == functions_.end() ? nullptr : &*found;
}

bool GlslSource::isBinary(size_t token) const
{
    if (token == 0) return false;
    const GlslToken& before = tokens_[token - 1];
    if (before.kind == GlslToken::Kind::kSymbol) return before.is(")") || before.is("]");
    return !before.is("return");
}

bool GlslSource::endsOperand(size_t token, int precedence) const
{
    const GlslToken& here = tokens_[token];
    if (here.is(",") || here.is(";") || here.is("return") || here.is("{") || here.is("}")) return true;
    const bool isSign = (here.is("+") || here.is("-")) && !isBinary(token);
    const int own = isSign ? 0 : precedenceOf(here.text);
    return own >= precedence;
}

size_t GlslSource::leftOperand(size_t token) const
{
    const int precedence = precedenceOf(tokens_[token].text);
    size_t at = token;
    while (at > 0) {
        const GlslToken& before = tokens_[at - 1];
        if (before.is(")") || before.is("]")) {
            if (partners_[at - 1] == kNone) break;
            at = partners_[at - 1];
            continue;
        }
        if (before.is("(") || before.is("[") || endsOperand(at - 1, precedence)) break;
        --at;
    }
    return at;
}

size_t GlslSource::behindRightOperand(size_t token) const
{
    const int precedence = precedenceOf(tokens_[token].text);
    size_t at = token + 1;
    while (at < tokens_.size()) {
        const GlslToken& here = tokens_[at];
        if (here.is("(") || here.is("[")) {
            if (partners_[at] == kNone) break;
            at = partners_[at] + 1;
            continue;
        }
        if (here.is(")") || here.is("]") || endsOperand(at, precedence)) break;
        ++at;
    }
    return at;
}

std::vector<GlslSource::Range> GlslSource::argumentsOf(size_t name) const
{
    std::vector<Range> arguments;
    if (name + 1 >= tokens_.size() || !tokens_[name + 1].is("(") || partners_[name + 1] == kNone) return arguments;
    const size_t close = partners_[name + 1];
    size_t begin = name + 2;
    for (size_t at = begin; at <= close; ++at) {
        if (at == close || tokens_[at].is(",")) {
            if (at > begin) arguments.push_back({begin, at});
            begin = at + 1;
        } else if (tokens_[at].is("(") || tokens_[at].is("[")) {
            if (partners_[at] == kNone) break;
            at = partners_[at];
        }
    }
    return arguments;
}

std::string_view GlslSource::textOf(Range range) const
{
    if (range.begin >= range.end) return {};
    const size_t first = tokens_[range.begin].offset;
    return text_.substr(first, tokens_[range.end - 1].end() - first);
}

} // namespace crossray
