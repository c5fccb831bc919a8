#include "harness/run/selection.h"

#include <gtest/gtest.h>

using namespace crossray;

namespace {

Case makeCase(std::string name, std::vector<std::string> tags = {})
{
    Case testCase;
    testCase.name = std::move(name);
    testCase.tags = std::move(tags);
    return testCase;
}

bool selects(const char* expression, const Case& testCase)
{
    return KeyExpression::parse(expression).matches(testCase);
}

} // namespace

TEST(Glob, starsRunAcrossSlashesAndBracketsAreThemselves)
{
    EXPECT_TRUE(matchesGlob("refraction/*", "refraction/sphere[ior=1.2]"));
    EXPECT_TRUE(matchesGlob("*sphere*", "refraction/sphere[ior=1.2]"));
    EXPECT_TRUE(matchesGlob("a?c", "abc"));
    EXPECT_TRUE(matchesGlob("x[ior=1.?]", "x[ior=1.2]"));
    EXPECT_TRUE(matchesGlob("*", ""));
    EXPECT_TRUE(matchesGlob("a*b*c", "aXbYbZc"));
    EXPECT_FALSE(matchesGlob("a?c", "ac"));
    EXPECT_FALSE(matchesGlob("x[ab]", "xa"));
    EXPECT_FALSE(matchesGlob("a*b", "abc"));
    EXPECT_FALSE(matchesGlob("", "a"));
}

TEST(KeyExpression, wordsArePartsOfTheNameOrTags)
{
    const Case testCase = makeCase("hiz/two_planes", {"exact", "slow"});
    EXPECT_TRUE(selects("two", testCase));
    EXPECT_TRUE(selects("exact", testCase));
    EXPECT_FALSE(selects("exa", testCase)); // a tag is named whole
    EXPECT_FALSE(selects("proxy", testCase));
}

TEST(KeyExpression, andBindsTighterThanOrAndNotTightest)
{
    const Case testCase = makeCase("hiz/two_planes", {"exact"});
    EXPECT_TRUE(selects("hiz or proxy and missing", testCase));
    EXPECT_FALSE(selects("(hiz or proxy) and missing", testCase));
    EXPECT_TRUE(selects("not proxy and exact", testCase));
    EXPECT_FALSE(selects("not (hiz and exact)", testCase));
    EXPECT_TRUE(selects("not not hiz", testCase));
}

TEST(KeyExpression, saysWhereItBreaksOff)
{
    for (const char* broken : {"", "and", "hiz and", "(hiz", "hiz)", "hiz exact", "not", "()"}) {
        EXPECT_THROW(KeyExpression::parse(broken), InputError) << broken;
    }
    try {
        KeyExpression::parse("hiz exact");
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("\"exact\" comes unexpected at column 5"), std::string::npos)
            << error.what();
    }
}
