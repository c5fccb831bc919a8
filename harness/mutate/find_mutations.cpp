#include "harness/mutate/glsl_tokens.h"
#include "harness/mutate/mutation.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>

namespace crossray {

namespace {

std::string foldBlanks(std::string_view text)
{
    std::string folded;
    for (const char c : text) {
        const bool isBlank = c == ' ' || c == '\t' || c == '\n' || c == '\r';
        if (!isBlank) folded += c;
        if (isBlank && !folded.empty() && folded.back() != ' ') folded += ' ';
    }
    while (!folded.empty() && folded.back() == ' ')
        folded.pop_back();
    return folded;
}

bool isSwizzle(std::string_view text)
{
    if (text.empty() || text.size() > 4) return false;
    return text.find_first_not_of("xyzw") == std::string_view::npos ||
           text.find_first_not_of("rgba") == std::string_view::npos;
}

// The suffix of a name that says its space; empty where there is none.
std::string_view spaceOf(std::string_view name)
{
    static constexpr std::array<std::string_view, 9> kSpaces{"NDC", "WS", "VS", "CS",       "SS",
                                                             "UV",  "PS", "IS", "CaptureWS"};
    for (const std::string_view space : kSpaces) {
        if (name.size() > space.size() && name.ends_with(space)) return space;
    }
    return {};
}

class MutationFinder {
  public:
    MutationFinder(const std::string& file, std::string_view text) : file_(file), source_(text) {}

    std::vector<Mutation> find()
    {
        const auto& tokens = source_.tokens();
        for (size_t i = 0; i < tokens.size(); ++i) {
            function_ = source_.functionAt(i);
            if (function_ == nullptr && !isConstantValue(i)) continue;
            if (tokens[i].kind == GlslToken::Kind::kNumber) changeNumber(i);
            if (tokens[i].kind == GlslToken::Kind::kSymbol) changeSymbol(i);
            if (tokens[i].kind == GlslToken::Kind::kWord) changeWord(i);
        }
        return std::move(found_);
    }

  private:
    // In the value of a global constant.
    bool isConstantValue(size_t token) const
    {
        const auto& tokens = source_.tokens();
        bool hasEquals = false;
        while (token > 0 && !tokens[token].is(";") && !tokens[token].is("{") && !tokens[token].is("}")) {
            --token;
            if (tokens[token].is("=")) hasEquals = true;
            if (tokens[token].is("const")) return hasEquals;
        }
        return false;
    }

    void add(std::string_view operation, size_t begin, size_t end, std::string replacement)
    {
        Mutation mutation;
        mutation.file = file_;
        mutation.function = function_ == nullptr ? "" : std::string(function_->name);
        mutation.operation = operation;
        mutation.offset = begin;
        mutation.length = end - begin;
        mutation.replacement = std::move(replacement);
        const std::string_view text = source_.text();
        const std::string_view upTo = text.substr(0, begin);
        const size_t lineBegin = upTo.rfind('\n') == std::string_view::npos ? 0 : upTo.rfind('\n') + 1;
        mutation.line = static_cast<int>(std::count(upTo.begin(), upTo.end(), '\n')) + 1;
        mutation.column = static_cast<int>(begin - lineBegin) + 1;
        const size_t lineEnd = std::min(text.find('\n', end), text.size());
        mutation.was = foldBlanks(text.substr(begin, end - begin));
        mutation.before = foldBlanks(text.substr(lineBegin, lineEnd - lineBegin));
        mutation.after = foldBlanks(std::string(text.substr(lineBegin, begin - lineBegin)) + mutation.replacement +
                                    std::string(text.substr(end, lineEnd - end)));
        if (mutation.before == mutation.after || !seen_.insert(applyMutation(text, mutation)).second) return;
        found_.push_back(std::move(mutation));
    }

    void replaceToken(std::string_view operation, size_t token, std::string replacement)
    {
        add(operation, tokenAt(token).offset, tokenAt(token).end(), std::move(replacement));
    }

    const GlslToken& tokenAt(size_t token) const { return source_.tokens()[token]; }
    std::string textOf(GlslSource::Range range) const { return std::string(source_.textOf(range)); }

    void changeNumber(size_t token)
    {
        const std::string text(tokenAt(token).text);
        const bool isWhole = text.find_first_not_of("0123456789uU") == std::string::npos;
        if (token > 0 && tokenAt(token - 1).is("[")) return; // a size or a place; the compiler bounds both
        if (isWhole) {
            const bool isUnsigned = text.ends_with('u') || text.ends_with('U');
            replaceToken("constant", token, fmt::format("{}{}", std::atoll(text.c_str()) + 1, isUnsigned ? "u" : ""));
            return;
        }
        if (text.starts_with("0x")) return;
        const double value = std::strtod(text.c_str(), nullptr);
        const bool isBound = value != 0 && (value < 1e-3 || value >= 1e4);
        // Away from the end of a float's range, on either side.
        const double moved = value == 0 ? 1.0 : !isBound ? value * 1.25 : value > 1e30 ? value / 1000 : value * 1000;
        std::string number = fmt::format("{}", moved);
        if (number.find_first_of(".e") == std::string::npos) number += ".0";
        replaceToken("constant", token, number);
    }

    void changeSymbol(size_t token)
    {
        static const std::map<std::string_view, std::vector<std::string_view>> kComparisons{
            {"<", {"<=", ">"}},  {"<=", {"<", ">="}}, {">", {">=", "<"}},
            {">=", {">", "<="}}, {"==", {"!="}},      {"!=", {"=="}}};
        static const std::map<std::string_view, std::string_view> kOperators{
            {"+", "-"},   {"-", "+"}, {"*", "/"}, {"/", "*"},   {"&&", "||"}, {"||", "&&"}, {"<<", ">>"},
            {">>", "<<"}, {"&", "|"}, {"|", "&"}, {"+=", "-="}, {"-=", "+="}, {"*=", "/="}, {"/=", "*="}};
        const GlslToken& here = tokenAt(token);
        if (const auto found = kComparisons.find(here.text); found != kComparisons.end()) {
            for (const std::string_view other : found->second)
                replaceToken("comparison", token, std::string(other));
        }
        const bool isSum = here.is("+") || here.is("-");
        if (isSum && !source_.isBinary(token)) {
            if (here.is("-")) replaceToken("sign", token, "");
            return;
        }
        if (here.is("!")) replaceToken("sign", token, "");
        if (const auto found = kOperators.find(here.text); found != kOperators.end())
            replaceToken("operator", token, std::string(found->second));
        if (isSum || here.is("&&") || here.is("||")) dropOperands(token);
        if (here.is("?")) removeChoice(token);
    }

    void dropOperands(size_t token)
    {
        const GlslToken& here = tokenAt(token);
        const size_t behind = source_.behindRightOperand(token);
        add("term", tokenAt(token - 1).end(), tokenAt(behind - 1).end(), "");
        const size_t first = source_.leftOperand(token);
        const bool isFirst = first == 0 || precedenceOf(tokenAt(first - 1).text) != precedenceOf(here.text);
        if (!isFirst) return; // dropped with the operator before it
        const size_t end = here.is("-") ? here.offset : tokenAt(token + 1).offset;
        add("term", tokenAt(first).offset, end, "");
    }

    // "c ? a : b" to a, and to b.
    void removeChoice(size_t question)
    {
        int open = 1;
        size_t colon = question + 1;
        for (; colon < source_.tokens().size() && open > 0; ++colon) {
            if (source_.partnerOf(colon) != GlslSource::kNone && source_.partnerOf(colon) > colon) {
                colon = source_.partnerOf(colon);
                continue;
            }
            if (tokenAt(colon).is("?")) ++open;
            if (tokenAt(colon).is(":") && --open == 0) break;
        }
        if (colon >= source_.tokens().size()) return;
        const size_t begin = source_.leftOperand(question), end = source_.behindRightOperand(colon);
        const size_t from = tokenAt(begin).offset, to = tokenAt(end - 1).end();
        add("guard", from, to, fmt::format("({})", textOf({question + 1, colon})));
        add("guard", from, to, fmt::format("({})", textOf({colon + 1, end})));
    }

    void changeWord(size_t token)
    {
        const GlslToken& here = tokenAt(token);
        const bool isMember = token > 0 && tokenAt(token - 1).is(".");
        const auto arguments = source_.argumentsOf(token);
        if (isMember && arguments.empty() && isSwizzle(here.text)) return changeSwizzle(token);
        if (here.is("if")) return removeIf(token);
        if (here.is("true")) replaceToken("constant", token, "false");
        if (here.is("false")) replaceToken("constant", token, "true");
        if (arguments.empty()) {
            if (!isDeclared(token)) exchangeSpace(token, isMember);
            return;
        }
        if (!isMember) changeCall(token, arguments);
    }

    // The name of a declaration is no use of it.
    bool isDeclared(size_t token) const
    {
        return token > 0 && tokenAt(token - 1).kind == GlslToken::Kind::kWord && !tokenAt(token - 1).is("return");
    }

    void changeSwizzle(size_t token)
    {
        std::string text(tokenAt(token).text);
        const bool isColor = text.find_first_of("rgba") != std::string::npos;
        const std::string_view set = isColor ? "rgba" : "xyzw";
        if (text.size() == 1 || text[0] == text[1]) {
            text.back() = text.back() == set[0] ? set[1] : set[0];
        } else {
            std::swap(text[0], text[1]);
        }
        replaceToken("swizzle", token, text);
    }

    // "if (c) s" without an else disappears.
    void removeIf(size_t token)
    {
        if (!tokenAt(token + 1).is("(") || source_.partnerOf(token + 1) == GlslSource::kNone) return;
        size_t last = source_.partnerOf(token + 1) + 1;
        if (tokenAt(last).is("{")) {
            last = source_.partnerOf(last);
        } else {
            while (last < source_.tokens().size() && !tokenAt(last).is(";"))
                ++last;
        }
        if (last + 1 >= source_.tokens().size() || tokenAt(last + 1).is("else")) return;
        const bool isElse = token > 0 && tokenAt(token - 1).is("else");
        if (isElse) return;
        add("guard", tokenAt(token).offset, tokenAt(last).end(), ";");
    }

    void changeCall(size_t token, const std::vector<GlslSource::Range>& arguments)
    {
        static const std::set<std::string_view> kToFirst{
            "saturate",   "normalize",    "safeNormalize", "abs",     "clamp", "max",   "min",
            "finiteOr",   "awayFromZero", "sqrt",          "exp",     "pow",   "floor", "fract",
            "smoothRamp", "reflect",      "transpose",     "inverse", "sign",  "exp2",  "log2"};
        static const std::set<std::string_view> kToSecond{"max", "min"};
        static const std::set<std::string_view> kToTrue{"isFinite", "hasDirection"};
        static const std::set<std::string_view> kExchanged{"mix", "cross", "step", "atan", "choose"};
        static const std::map<std::string_view, std::string_view> kOthers{{"any", "all"},
                                                                          {"all", "any"},
                                                                          {"floor", "ceil"},
                                                                          {"ceil", "floor"},
                                                                          {"sin", "cos"},
                                                                          {"cos", "sin"},
                                                                          {"lessThan", "greaterThan"},
                                                                          {"greaterThan", "lessThan"},
                                                                          {"equal", "notEqual"},
                                                                          {"notEqual", "equal"},
                                                                          {"lessThanEqual", "lessThan"},
                                                                          {"greaterThanEqual", "greaterThan"}};
        const GlslToken& here = tokenAt(token);
        if (isDeclared(token)) return;
        const size_t from = here.offset, to = tokenAt(source_.partnerOf(token + 1)).end();
        const bool tidies = here.text.starts_with("usable") || here.text.starts_with("sanitize");
        if (kToFirst.contains(here.text) || (tidies && arguments.size() == 1))
            add("guard", from, to, fmt::format("({})", textOf(arguments[0])));
        if (kToSecond.contains(here.text) && arguments.size() == 2)
            add("guard", from, to, fmt::format("({})", textOf(arguments[1])));
        if (kToTrue.contains(here.text)) add("guard", from, to, "true");
        if (here.is("safeDivide") && arguments.size() == 3)
            add("guard", from, to, fmt::format("(({}) / ({}))", textOf(arguments[0]), textOf(arguments[1])));
        if (here.is("choose") && arguments.size() == 3) {
            add("guard", from, to, fmt::format("({})", textOf(arguments[1])));
            add("guard", from, to, fmt::format("({})", textOf(arguments[2])));
        } else if (kExchanged.contains(here.text) && arguments.size() >= 2) {
            add("order", tokenAt(arguments[0].begin).offset, tokenAt(arguments[1].end - 1).end(),
                textOf(arguments[1]) + ", " + textOf(arguments[0]));
        }
        if (const auto found = kOthers.find(here.text); found != kOthers.end()) {
            const bool isTurned =
                here.text.starts_with("less") || here.text.starts_with("greater") || here.text.ends_with("qual");
            replaceToken(isTurned ? "comparison" : "operator", token, std::string(found->second));
        }
    }

    // positionWS for positionVS where both are there, else for another name of the same type in another space.
    void exchangeSpace(size_t token, bool isMember)
    {
        const std::string_view name = tokenAt(token).text;
        const std::string_view space = spaceOf(name);
        if (space.empty() || function_ == nullptr || isMember) return;
        const auto& variables = function_->variables;
        const auto own = std::find_if(variables.begin(), variables.end(),
                                      [&](const GlslVariable& variable) { return variable.name == name; });
        if (own == variables.end()) return;
        const std::string_view stem = name.substr(0, name.size() - space.size());
        const GlslVariable* best = nullptr;
        for (const GlslVariable& other : variables) {
            const std::string_view otherSpace = spaceOf(other.name);
            if (other.type != own->type || otherSpace.empty() || otherSpace == space) continue;
            // What is declared behind this place would not compile.
            if (other.name.data() > name.data()) continue;
            const bool hasStem = other.name.substr(0, other.name.size() - otherSpace.size()) == stem;
            if (best == nullptr || hasStem) best = &other;
            if (hasStem) break;
        }
        if (best != nullptr) replaceToken("space", token, std::string(best->name));
    }

    std::string file_;
    GlslSource source_;
    const GlslFunction* function_ = nullptr;
    std::vector<Mutation> found_;
    std::set<std::string> seen_; // whole texts, so that no edit is there twice
};

} // namespace

std::vector<Mutation> findMutations(const std::string& file, std::string_view text)
{
    return MutationFinder(file, text).find();
}

} // namespace crossray
