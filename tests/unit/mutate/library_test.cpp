#include "harness/mutate/library.h"

#include "harness/base/error.h"
#include "harness/mutate/case_odds.h"
#include "harness/mutate/hunt_report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>

namespace crossray {
namespace {

namespace fs = std::filesystem;

const fs::path kShaders = fs::path(CROSSRAY_SOURCE_DIR) / "shaders";

ProgramKey traceWith(double model)
{
    return {"entry/screen_trace.comp", {}, {{"kProjectionModel", model}, {"kOutputMask", 8}}};
}

// The short way makes the code that a run has.
TEST(MutantLibrary, compilesWhatTheCompilerDoes)
{
    MutantLibrary library(kShaders);
    ShaderCompiler compiler({});
    for (const double model : {2.0, 4.0}) {
        CompileOptions options;
        options.includeRoot = kShaders;
        options.specialization = traceWith(model).specialization;
        EXPECT_EQ(library.compile(traceWith(model)),
                  compiler.compile(kShaders / "entry/screen_trace.comp", options).spirv)
            << model;
    }
}

TEST(MutantLibrary, knowsWhatAVariantReaches)
{
    MutantLibrary library(kShaders);
    EXPECT_TRUE(library.reachOf(traceWith(4)).contains("traceHiz"));
    EXPECT_FALSE(library.reachOf(traceWith(4)).contains("traceLinear"));
    EXPECT_TRUE(library.reachOf(traceWith(5)).contains("traceLinear"));
    EXPECT_TRUE(library.closureOf(traceWith(5)).contains("crossray/project/linear.glsl"));
    const ProgramKey pyramid{"entry/color_pyramid.comp", {}, {}};
    EXPECT_FALSE(library.closureOf(pyramid).contains("crossray/project/linear.glsl"));
}

TEST(MutantLibrary, compilesAChangeAndNothingElse)
{
    MutantLibrary library(kShaders);
    const std::string name = "crossray/project/proxy.glsl";
    MutantLibrary::Mutant same(library, {name, library.textOf(name) + "\n// the same\n"});
    EXPECT_EQ(same.compile(traceWith(2)), library.compile(traceWith(2)));
    std::string text = library.textOf(name);
    const Mutation mutation = findMutations(name, text).front();
    MutantLibrary::Mutant broken(library, {name, text + "\nfloat broken(\n"});
    EXPECT_THROW(broken.compile(traceWith(2)), ShaderError);
    EXPECT_THROW(library.textOf("crossray/none.glsl"), InputError);
    EXPECT_FALSE(mutation.file.empty());
}

TEST(CaseOdds, asksFirstWhatCaughtBeforeInTheSameFunction)
{
    CaseOdds odds(3);
    const auto alike = [](size_t) { return 1.0; };
    auto choice = odds.start("x.glsl", "f", {0, 1, 2});
    EXPECT_EQ(choice.next(alike), 0u);
    choice.note(0, false);
    EXPECT_EQ(choice.next(alike), 1u);
    choice.note(1, true);
    choice.dropIf([](size_t testCase) { return testCase == 2; });
    EXPECT_FALSE(choice.next(alike));

    auto same = odds.start("x.glsl", "f", {0, 1, 2});
    EXPECT_EQ(same.next(alike), 1u);
    auto slow = odds.start("x.glsl", "f", {0, 1, 2});
    EXPECT_EQ(slow.next([](size_t testCase) { return testCase == 1 ? 1000.0 : 1.0; }), 2u);
}

HuntResult makeResult()
{
    HuntResult hunt;
    const std::string text = "float f(float a, float b) { return a + b; }";
    for (const Mutation& mutation : findMutations("x.glsl", text)) {
        MutantResult result;
        result.mutation = mutation;
        result.end = hunt.mutants.empty() ? MutantEnd::kSurvived : MutantEnd::kCaught;
        hunt.mutants.push_back(result);
    }
    hunt.mutants.back().end = MutantEnd::kUnreached;
    hunt.cases = {{"a/b", 1, 1, "", false}, {"a/idle", 0, 4, "", true}};
    return hunt;
}

TEST(HuntReport, countsWhatIsCaughtAmongWhatCouldBe)
{
    const HuntResult hunt = makeResult();
    ASSERT_EQ(hunt.mutants.size(), 3u);
    const HuntCounts counts = countAll(hunt);
    EXPECT_EQ(counts.planted, 3u);
    EXPECT_EQ(counts.caught, 1u);
    EXPECT_EQ(counts.unreached, 1u);
    EXPECT_DOUBLE_EQ(counts.score().value(), 0.5);
    EXPECT_EQ(formatScore(counts), "50.0 %");
    HuntCounts most;
    most.caught = 2999;
    most.survived = 1;
    EXPECT_EQ(formatScore(most), "99.9 %"); // 100 % is all of them
    EXPECT_EQ(formatScore({}), "-");
    EXPECT_EQ(countByOperation(hunt).size(), 2u);
}

TEST(HuntReport, writesTableSurvivorsAndJson)
{
    const HuntResult hunt = makeResult();
    EXPECT_NE(formatSurvivors(hunt).find(
                  "-float f(float a, float b) { return a + b; }\n+float f(float a, float b) { return a - b; }"),
              std::string::npos);
    EXPECT_NE(formatHuntMarkdown(hunt, {}).find("- a/idle"), std::string::npos);
    EXPECT_NE(formatHuntMarkdown(hunt, {}).find("| x.glsl | 3 | 1 | 1 | 0 | 0 | 1 | 0 | 50.0 % |"), std::string::npos);
    const auto json = nlohmann::json::parse(formatHuntJson(hunt, {"crossray mutate", "", 7, 1}));
    EXPECT_EQ(json["schema"], "crossray-mutation/1");
    EXPECT_EQ(json["mutants"].size(), 3u);
    EXPECT_EQ(json["idleCases"][0], "a/idle");
    const std::string csv = formatHuntCsv(hunt);
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 4);
}

} // namespace
} // namespace crossray
