// GLSL as tokens, and what a change of the text needs to know of them: brackets, functions, operands.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace crossray {

struct GlslToken {
    enum class Kind { kWord, kNumber, kSymbol } kind = Kind::kSymbol;
    std::string_view text; // into the source
    size_t offset = 0;
    int line = 1, column = 1;

    bool is(std::string_view other) const { return text == other; }
    size_t end() const { return offset + text.size(); }
};

// Comments, and directives with what they define, are no tokens. Symbols are as long as GLSL has them ("<<=").
std::vector<GlslToken> lexGlsl(std::string_view source);

// A name with its type, as a parameter or a local variable declares it.
struct GlslVariable {
    std::string_view type, name;
};

struct GlslFunction {
    std::string_view name;
    size_t open = 0, close = 0; // tokens: the braces of its body
    std::vector<GlslVariable> variables;
};

class GlslSource {
  public:
    explicit GlslSource(std::string_view text);

    std::string_view text() const { return text_; }
    const std::vector<GlslToken>& tokens() const { return tokens_; }
    const std::vector<GlslFunction>& functions() const { return functions_; }
    // The function whose body holds the token; null outside all.
    const GlslFunction* functionAt(size_t token) const;
    // The other bracket of a pair; kNone for a token that is no bracket, or has no partner.
    size_t partnerOf(size_t token) const { return partners_[token]; }
    static constexpr size_t kNone = static_cast<size_t>(-1);

    // Whether "+" or "-" has an operand on its left.
    bool isBinary(size_t token) const;
    // The first token of the operand on the left, and the one behind the operand on the right, of a binary operator:
    // both end at an operator that binds no more tightly.
    size_t leftOperand(size_t token) const;
    size_t behindRightOperand(size_t token) const;
    // Of a call's name: the tokens of each argument, [begin, end). Empty for what is no call.
    struct Range {
        size_t begin = 0, end = 0;
    };
    std::vector<Range> argumentsOf(size_t name) const;
    std::string_view textOf(Range range) const;

  private:
    void matchBrackets();
    void findFunctions();
    void findVariables(GlslFunction& function, size_t firstToken) const;
    bool endsOperand(size_t token, int precedence) const;

    std::string_view text_;
    std::vector<GlslToken> tokens_;
    std::vector<size_t> partners_;
    std::vector<GlslFunction> functions_;
};

// How tightly a binary operator binds, from 1 ("*") upwards to assignments; 0 for what is none.
int precedenceOf(std::string_view symbol);

} // namespace crossray
