#include "harness/base/error.h"
#include "harness/mutate/glsl_tokens.h"
#include "harness/mutate/mutation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace crossray {
namespace {

// The texts that the operation makes of one function's body.
std::vector<std::string> changesOf(const std::string& operation, const std::string& body,
                                   const std::string& parameters = "float a, float b, float c")
{
    const std::string head = "float f(" + parameters + ") { ";
    const std::string text = head + body + " }";
    std::vector<std::string> changed;
    for (const Mutation& mutation : findMutations("x.glsl", text)) {
        if (mutation.operation != operation) continue;
        std::string whole = applyMutation(text, mutation);
        changed.push_back(whole.substr(head.size(), whole.size() - head.size() - 2));
    }
    return changed;
}

using Texts = std::vector<std::string>;

TEST(GlslTokens, knowsCommentsStringsDirectivesAndNumbers)
{
    const std::string text = "// a + b\n/* - \n */ #define X (1 + \\\n 2)\n\"+\" x+=1e-30-.5;\n";
    std::vector<std::string> words;
    for (const GlslToken& token : lexGlsl(text))
        words.emplace_back(token.text);
    EXPECT_EQ(words, (Texts{"#", "define", "X", "(", "1", "+", "\\", "2", ")", "x", "+=", "1e-30", "-", ".5", ";"}));
    // A directive stands first in its line.
    EXPECT_TRUE(lexGlsl("  # if A + B // c\n").empty());
    EXPECT_TRUE(lexGlsl("#define A 1 + \\\n 2 + 3\n").empty());
}

TEST(GlslTokens, knowsLinesAndColumns)
{
    const auto tokens = lexGlsl("a\n  bc;");
    ASSERT_EQ(tokens.size(), 3u);
    EXPECT_EQ(tokens[1].line, 2);
    EXPECT_EQ(tokens[1].column, 3);
    EXPECT_EQ(tokens[2].column, 5);
}

TEST(GlslTokens, findsFunctionsAndWhatTheyDeclare)
{
    const std::string text = "struct S { int a; };\nint hook(int i);\nvec3 f(View v, vec3 aWS) { const vec3 bVS = aWS; "
                             "for (int i = 0; i < 3; ++i) { float x; } return bVS; }";
    const GlslSource source(text);
    ASSERT_EQ(source.functions().size(), 1u);
    const GlslFunction& function = source.functions()[0];
    EXPECT_EQ(function.name, "f");
    std::vector<std::string> names;
    for (const GlslVariable& variable : function.variables)
        names.push_back(std::string(variable.type) + " " + std::string(variable.name));
    EXPECT_EQ(names, (Texts{"View v", "vec3 aWS", "vec3 bVS", "int i", "float x"}));
}

TEST(GlslTokens, survivesTextThatIsNoGlsl)
{
    for (const char* text : {"",
                             "(",
                             ")",
                             "}{",
                             "a ? b",
                             "f(",
                             "f(,)",
                             "if",
                             "if (",
                             "if (a)",
                             "a +",
                             "+ a",
                             ". x",
                             "? :",
                             "void f() { if (a) ",
                             "void f() { a ? b ; }",
                             "\"",
                             "/*",
                             "#",
                             "1e",
                             "void f(( {}"}) {
        EXPECT_NO_THROW(findMutations("x.glsl", text)) << text;
    }
}

TEST(Mutations, exchangeOperators)
{
    EXPECT_EQ(changesOf("operator", "return a + b * c;"), (Texts{"return a - b * c;", "return a + b / c;"}));
    EXPECT_EQ(changesOf("operator", "return a < 0 && b < 0;"), (Texts{"return a < 0 || b < 0;"}));
    EXPECT_EQ(changesOf("operator", "a += b;"), (Texts{"a -= b;"}));
    EXPECT_TRUE(changesOf("operator", "return -a;").empty());
}

TEST(Mutations, turnComparisonsAndMakeThemStrict)
{
    EXPECT_EQ(changesOf("comparison", "return a < b;"), (Texts{"return a <= b;", "return a > b;"}));
    EXPECT_EQ(changesOf("comparison", "return a >= b;"), (Texts{"return a > b;", "return a <= b;"}));
    EXPECT_EQ(changesOf("comparison", "return a == b;"), (Texts{"return a != b;"}));
    EXPECT_EQ(changesOf("comparison", "return all(lessThan(a, b));"), (Texts{"return all(greaterThan(a, b));"}));
}

TEST(Mutations, moveConstants)
{
    EXPECT_EQ(changesOf("constant", "return 0.0;"), (Texts{"return 1.0;"}));
    EXPECT_EQ(changesOf("constant", "return 2.0;"), (Texts{"return 2.5;"}));
    EXPECT_EQ(changesOf("constant", "return 1e-6;"), (Texts{"return 0.001;"}));
    EXPECT_EQ(changesOf("constant", "int i = 3;"), (Texts{"int i = 4;"}));
    EXPECT_EQ(changesOf("constant", "uint i = 3u;"), (Texts{"uint i = 4u;"}));
    EXPECT_EQ(changesOf("constant", "bool b = true;"), (Texts{"bool b = false;"}));
    EXPECT_TRUE(changesOf("constant", "m[3];").empty()); // beyond the end it would be no program
    const auto global =
        findMutations("x.glsl", "const float kHalf = 0.5;\nlayout(binding = 3) uniform U { int i; };\n");
    ASSERT_EQ(global.size(), 1u);
    EXPECT_EQ(global[0].id(), "x.glsl:1:21 constant: 0.5 -> 0.625");
    EXPECT_EQ(constantAt("const float kHalf = 0.5;\n", global[0]), "kHalf");
}

TEST(Mutations, dropSigns)
{
    EXPECT_EQ(changesOf("sign", "return a - -b;"), (Texts{"return a - b;"}));
    EXPECT_EQ(changesOf("sign", "return !(a < b);"), (Texts{"return (a < b);"}));
    EXPECT_EQ(changesOf("sign", "return -1.0;"), (Texts{"return 1.0;"}));
}

TEST(Mutations, removeGuards)
{
    EXPECT_EQ(changesOf("guard", "return saturate(a + b);"), (Texts{"return (a + b);"}));
    EXPECT_EQ(changesOf("guard", "return max(a, f(b, c));"), (Texts{"return (a);", "return (f(b, c));"}));
    EXPECT_EQ(changesOf("guard", "return clamp(a, 0.0, 1.0);"), (Texts{"return (a);"}));
    EXPECT_EQ(changesOf("guard", "return safeNormalize(v, vec3(0.0));"), (Texts{"return (v);"}));
    EXPECT_EQ(changesOf("guard", "return safeDivide(a + b, c, 0.0);"), (Texts{"return ((a + b) / (c));"}));
    EXPECT_EQ(changesOf("guard", "return choose(a < b, a, b);"), (Texts{"return (a);", "return (b);"}));
    EXPECT_EQ(changesOf("guard", "float x = a < b ? f(a, b) : c;"), (Texts{"float x = (f(a, b));", "float x = (c);"}));
    EXPECT_EQ(changesOf("guard", "if (a < b) return a; return b;"), (Texts{"; return b;"}));
    EXPECT_EQ(changesOf("guard", "if (a < b) { a = b; } return a;"), (Texts{"; return a;"}));
    EXPECT_TRUE(changesOf("guard", "if (a < b) a = b; else b = a;").empty());
}

TEST(Mutations, exchangeComponents)
{
    EXPECT_EQ(changesOf("swizzle", "return v.x + v.y;"), (Texts{"return v.y + v.y;", "return v.x + v.x;"}));
    EXPECT_EQ(changesOf("swizzle", "return v.xyz;"), (Texts{"return v.yxz;"}));
    EXPECT_EQ(changesOf("swizzle", "return v.rgb;"), (Texts{"return v.grb;"}));
    EXPECT_TRUE(changesOf("swizzle", "return s.begin + s.w1;").empty());
}

TEST(Mutations, dropTerms)
{
    EXPECT_EQ(changesOf("term", "return a + b;"), (Texts{"return a;", "return b;"}));
    EXPECT_EQ(changesOf("term", "return a - b * c;"), (Texts{"return a;", "return - b * c;"}));
    EXPECT_EQ(changesOf("term", "return a + b - f(c - 1);"),
              (Texts{"return a - f(c - 1);", "return b - f(c - 1);", "return a + b;", "return a + b - f(c);",
                     "return a + b - f(- 1);"}));
    EXPECT_EQ(changesOf("term", "return x < 1 && y < 2 || z;"),
              (Texts{"return x < 1 || z;", "return y < 2 || z;", "return x < 1 && y < 2;", "return z;"}));
}

TEST(Mutations, takeTheWrongSpace)
{
    // The first is no program: the compiler says so.
    EXPECT_EQ(changesOf("space", "vec3 dVS = m * dWS; return length(dVS);", "vec3 dWS"),
              (Texts{"vec3 dVS = m * dVS; return length(dVS);", "vec3 dVS = m * dWS; return length(dWS);"}));
    // Another type, or a name that comes later, would be no program.
    EXPECT_TRUE(changesOf("space", "return length(aWS);", "vec3 aWS, vec2 aSS").empty());
}

TEST(Mutations, areEachAChangeOfTheirOwn)
{
    const std::string text = "float f(float a) { return max(a, a) + 0.0; }";
    std::set<std::string> texts;
    const auto mutations = findMutations("x.glsl", text);
    for (const Mutation& mutation : mutations)
        texts.insert(applyMutation(text, mutation));
    EXPECT_EQ(texts.size(), mutations.size());
    EXPECT_FALSE(texts.contains(text));
}

TEST(Mutations, sayWhereAndWhat)
{
    const std::string text = "// Half.\nfloat half(float x)\n{\n    return x *\n        0.5;\n}\n";
    const auto mutations = findMutations("a/b.glsl", text);
    ASSERT_EQ(mutations.size(), 2u);
    EXPECT_EQ(mutations[0].function, "half");
    EXPECT_EQ(mutations[0].id(), "a/b.glsl:4:14 half operator: * -> /");
    EXPECT_EQ(formatMutationDiff(mutations[1]), "a/b.glsl:5:9 in half\n-0.5;\n+0.625;\n");
}

TEST(Mutations, refuseAnEditOutsideTheText)
{
    Mutation mutation;
    mutation.offset = 3;
    mutation.length = 2;
    EXPECT_THROW(applyMutation("abcd", mutation), InputError);
}

TEST(Users, areFoundThroughConstants)
{
    const std::vector<std::string> texts{"const int kA = 1;\nconst int kB = kA + 1;\nint f() { return kB; }",
                                         "int g() { return kA; }\nint h() { return 3; }"};
    EXPECT_EQ(findUsers(texts, "kA"), (Texts{"f", "g"}));
    EXPECT_EQ(findUsers(texts, "kB"), (Texts{"f"}));
    EXPECT_TRUE(findUsers(texts, "kC").empty());
}

} // namespace
} // namespace crossray
