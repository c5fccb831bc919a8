#include "harness/run/selection.h"

#include <fmt/format.h>

#include <algorithm>

namespace crossray {

bool isGlob(std::string_view text)
{
    return text.find_first_of("*?") != std::string_view::npos;
}

bool matchesGlob(std::string_view pattern, std::string_view text)
{
    size_t p = 0, t = 0;
    size_t star = std::string_view::npos, afterStar = 0; // the last star, and where what it swallowed ends
    while (t < text.size()) {
        if (p < pattern.size() && pattern[p] == '*') {
            star = p++;
            afterStar = t;
        } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == text[t])) {
            ++p;
            ++t;
        } else if (star != std::string_view::npos) {
            p = star + 1;
            t = ++afterStar;
        } else {
            return false;
        }
    }
    while (p < pattern.size() && pattern[p] == '*')
        ++p;
    return p == pattern.size();
}

struct KeyExpression::Node {
    enum class Kind { kWord, kNot, kAnd, kOr } kind = Kind::kWord;
    std::string word;
    std::shared_ptr<const Node> left, right;
};

namespace {

using Node = KeyExpression::Node;
using NodePtr = std::shared_ptr<const Node>;

// or -> and ("or" and)*;  and -> not ("and" not)*;  not -> "not" not | "(" or ")" | word
class ExpressionParser {
  public:
    explicit ExpressionParser(std::string_view text) : text_(text) { advance(); }

    NodePtr parseAll()
    {
        NodePtr node = parseOr();
        if (!token_.empty()) fail(fmt::format("\"{}\" comes unexpected", token_));
        return node;
    }

  private:
    void advance()
    {
        while (next_ < text_.size() && text_[next_] == ' ')
            ++next_;
        tokenStart_ = next_;
        if (next_ < text_.size() && (text_[next_] == '(' || text_[next_] == ')')) {
            ++next_;
        } else {
            while (next_ < text_.size() && text_[next_] != ' ' && text_[next_] != '(' && text_[next_] != ')')
                ++next_;
        }
        token_ = text_.substr(tokenStart_, next_ - tokenStart_);
    }

    [[noreturn]] void fail(const std::string& what) const
    {
        throw InputError(fmt::format("-k \"{}\": {} at column {}; allowed are words, and, or, not and brackets", text_,
                                     what, tokenStart_ + 1));
    }

    NodePtr parseOr()
    {
        NodePtr left = parseAnd();
        while (token_ == "or") {
            advance();
            left = std::make_shared<Node>(Node{Node::Kind::kOr, {}, left, parseAnd()});
        }
        return left;
    }

    NodePtr parseAnd()
    {
        NodePtr left = parseNot();
        while (token_ == "and") {
            advance();
            left = std::make_shared<Node>(Node{Node::Kind::kAnd, {}, left, parseNot()});
        }
        return left;
    }

    NodePtr parseNot()
    {
        if (token_ == "not") {
            advance();
            return std::make_shared<Node>(Node{Node::Kind::kNot, {}, parseNot(), {}});
        }
        if (token_ == "(") {
            advance();
            NodePtr inner = parseOr();
            if (token_ != ")") fail("a closing bracket is missing");
            advance();
            return inner;
        }
        if (token_.empty() || token_ == ")" || token_ == "and" || token_ == "or") fail("a word is missing");
        auto node = std::make_shared<Node>(Node{Node::Kind::kWord, std::string(token_), {}, {}});
        advance();
        return node;
    }

    std::string_view text_;
    std::string_view token_;
    size_t next_ = 0;
    size_t tokenStart_ = 0;
};

bool evaluate(const Node& node, const Case& testCase)
{
    switch (node.kind) {
    case Node::Kind::kWord:
        return testCase.name.find(node.word) != std::string::npos ||
               std::find(testCase.tags.begin(), testCase.tags.end(), node.word) != testCase.tags.end();
    case Node::Kind::kNot:
        return !evaluate(*node.left, testCase);
    case Node::Kind::kAnd:
        return evaluate(*node.left, testCase) && evaluate(*node.right, testCase);
    case Node::Kind::kOr:
        return evaluate(*node.left, testCase) || evaluate(*node.right, testCase);
    }
    return false;
}

} // namespace

KeyExpression KeyExpression::parse(std::string_view text)
{
    KeyExpression expression;
    expression.root_ = ExpressionParser(text).parseAll();
    return expression;
}

bool KeyExpression::matches(const Case& testCase) const
{
    return evaluate(*root_, testCase);
}

} // namespace crossray
