#include "harness/mutate/earlier_hunt.h"

#include "harness/base/error.h"
#include "harness/base/temporary_folder.h"
#include "harness/mutate/hunt_report.h"

#include <gtest/gtest.h>

#include <fstream>

namespace crossray {
namespace {

// Three mutants of which the first survived, the second was caught and the third has no program.
HuntResult makeHunt(const std::string& text)
{
    HuntResult hunt;
    for (const Mutation& mutation : findMutations("x.glsl", text)) {
        MutantResult result;
        result.mutation = mutation;
        hunt.mutants.push_back(result);
    }
    hunt.mutants.at(1).end = MutantEnd::kCaught;
    hunt.mutants.at(1).caughtBy = "library/x";
    hunt.mutants.at(1).how = "fail";
    hunt.mutants.at(2).end = MutantEnd::kNoCompile;
    return hunt;
}

TEST(EarlierHunt, knowsWhatWasCaughtWhereverItStandsNow)
{
    const std::string text = "float f(float a, float b) { return a + b; }";
    const HuntResult hunt = makeHunt(text);
    const TemporaryFolder folder("earlier");
    const auto file = folder.path() / "mutation.json";
    std::ofstream(file) << formatHuntJson(hunt, {});
    const EarlierHunt earlier(file);

    const std::vector<Mutation> moved = findMutations("x.glsl", "// a line more\n" + text);
    ASSERT_EQ(moved.size(), 3u);
    EXPECT_EQ(earlier.findCaught(moved[0]), nullptr);
    ASSERT_NE(earlier.findCaught(moved[1]), nullptr);
    EXPECT_EQ(earlier.findCaught(moved[1])->caughtBy, "library/x");
    EXPECT_EQ(earlier.findCaught(moved[1])->how, "fail");
    EXPECT_EQ(earlier.findCaught(moved[2]), nullptr);
    for (const Mutation& other : findMutations("y.glsl", text))
        EXPECT_EQ(earlier.findCaught(other), nullptr);
    EXPECT_EQ(EarlierHunt().findCaught(moved[1]), nullptr);
}

// Two lines of one function may read alike: they cannot be told apart, so both must have been caught.
TEST(EarlierHunt, asksAgainWhereOneOfTwoAlikeSurvived)
{
    const std::string text = "void g() {\n    a = b + c;\n    a = b + c;\n}";
    HuntResult hunt;
    for (const Mutation& mutation : findMutations("x.glsl", text)) {
        MutantResult result;
        result.mutation = mutation;
        result.end = mutation.line == 2 ? MutantEnd::kCaught : MutantEnd::kSurvived;
        hunt.mutants.push_back(result);
    }
    ASSERT_GE(hunt.mutants.size(), 2u);
    const TemporaryFolder folder("earlier");
    const auto file = folder.path() / "mutation.json";
    std::ofstream(file) << formatHuntJson(hunt, {});
    for (const MutantResult& result : hunt.mutants)
        EXPECT_EQ(EarlierHunt(file).findCaught(result.mutation), nullptr);
    for (MutantResult& result : hunt.mutants)
        result.end = MutantEnd::kCaught;
    std::ofstream(file) << formatHuntJson(hunt, {});
    for (const MutantResult& result : hunt.mutants)
        EXPECT_NE(EarlierHunt(file).findCaught(result.mutation), nullptr);
}

TEST(EarlierHunt, refusesWhatIsNoHunt)
{
    const TemporaryFolder folder("earlier");
    const auto file = folder.path() / "mutation.json";
    EXPECT_THROW(EarlierHunt{file}, InputError);
    for (const char* text :
         {"", "[1", "{}", R"({"schema":"crossray-run/1"})", R"({"schema":"crossray-mutation/1","mutants":[{}]})"}) {
        std::ofstream(file) << text;
        EXPECT_THROW(EarlierHunt{file}, InputError) << text;
    }
}

} // namespace
} // namespace crossray
