#include "harness/run/selection.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

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

TEST(Shard, acceptsOnlyPartsThatExist)
{
    EXPECT_EQ(Shard::parse("2/3").index, 2);
    EXPECT_EQ(Shard::parse("2/3").count, 3);
    for (const char* broken : {"0/3", "4/3", "1", "1/", "/3", "1/3x", "-1/3", "a/b", ""})
        EXPECT_THROW(Shard::parse(broken), InputError) << broken;
}

// The hash is a promise: results of shards that were run by different versions are merged.
TEST(Shard, hashNeverChanges)
{
    EXPECT_EQ(computeStableHash("refraction/sphere"), 167449756777745165u);
    EXPECT_NE(computeStableHash("a"), computeStableHash("b"));
}

RC_GTEST_PROP(Shard, partitionTheWhole, (std::vector<std::string> names))
{
    const int count = *rc::gen::inRange(1, 9);
    for (const std::string& name : names) {
        int holders = 0;
        for (int index = 1; index <= count; ++index)
            holders += Shard{index, count}.contains(name) ? 1 : 0;
        RC_ASSERT(holders == 1);
    }
}

TEST(Shard, partsAreOfSimilarSize)
{
    int inFirst = 0;
    for (int i = 0; i < 1000; ++i)
        inFirst += Shard{1, 4}.contains("sweep/case[ior=1." + std::to_string(i) + "]") ? 1 : 0;
    EXPECT_GT(inFirst, 200);
    EXPECT_LT(inFirst, 300);
}
