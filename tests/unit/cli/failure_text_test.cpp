#include "harness/cli/failure_text.h"

#include <gtest/gtest.h>

#include <limits>

using namespace crossray;

namespace {

const Style kPlain(false);

ExpectationResult makeFailure(const std::string& output, uint64_t failed)
{
    ExpectationResult expectation;
    expectation.output = output;
    expectation.source = "truth hit_depth";
    expectation.position = {"cases/hiz.toml", 21, 1};
    expectation.tolerance = "0.0001 relative";
    expectation.judged = true;
    expectation.comparison.unit = "relative";
    expectation.comparison.compared = 4096;
    expectation.comparison.failed = failed;
    expectation.comparison.worst = PixelDifference{31, 12, {2.4987}, {2.5112}, 0.005};
    expectation.comparison.reason = "worst";
    return expectation;
}

CaseResult makeCase()
{
    CaseResult testCase;
    testCase.name = "hiz/two_planes";
    testCase.position = {"cases/hiz.toml", 1, 1};
    return testCase;
}

BackendResult makeResult(std::vector<ExpectationResult> expectations)
{
    BackendResult result;
    result.backend = "osmesa";
    result.verdict = Verdict::kFail;
    result.reason = "HitDepth: worst";
    result.expectations = std::move(expectations);
    return result;
}

} // namespace

TEST(FailureText, saysTheWorstFirstAndHandsOverTheNextCommand)
{
    const std::string text =
        formatFailure(makeCase(), makeResult({makeFailure("RayDirWS", 3), makeFailure("HitDepth", 37)}), kPlain, false);
    EXPECT_EQ(text,
              "FAIL  hiz/two_planes  osmesa  HitDepth   37 of 4096 px (0.90 %), worst 0.005 relative at (31, 12)\n"
              "      expected 2.4987  actual 2.5112   tolerance 0.0001 relative   (truth hit_depth)\n"
              "      cases/hiz.toml:21:1   crossray trace hiz/two_planes --pixel 31,12 --backend osmesa\n"
              "       RayDirWS   3 of 4096 px (0.07 %), worst 0.005 relative at (31, 12)\n"
              "      expected 2.4987  actual 2.5112   tolerance 0.0001 relative   (truth hit_depth)\n");
}

TEST(FailureText, anAgreementIsTracedBesideWhatItIsHeldAgainst)
{
    ExpectationResult expectation = makeFailure("HitDepth", 1);
    expectation.source = "agree with cpu64";
    const std::string text = formatFailure(makeCase(), makeResult({expectation}), kPlain, false);
    EXPECT_NE(text.find("crossray trace hiz/two_planes --pixel 31,12 --backend osmesa,cpu64\n"), std::string::npos)
        << text;
}

TEST(FailureText, classesAndReasonsHaveNames)
{
    EXPECT_EQ(formatValues("HitSuccess", {2}, 6), "miss (2)");
    EXPECT_EQ(formatValues("HitReason", {1}, 6), "iteration cap (1)");
    EXPECT_EQ(formatValues("HitSuccess", {4}, 6), "4") << "no class";
    EXPECT_EQ(formatValues("HitSuccess", {0.5}, 6), "0.5");
    EXPECT_EQ(formatValues("HitSuccess", {std::numeric_limits<double>::quiet_NaN()}, 6), "nan");
    EXPECT_EQ(formatValues("IterationCount", {2}, 6), "2");
    EXPECT_EQ(formatValues("RayDirWS", {0, 0, 1}, 6), "(0, 0, 1)");
    ExpectationResult expectation = makeFailure("HitSuccess", 1);
    expectation.comparison.worst->expected = {2};
    expectation.comparison.worst->actual = {1};
    const std::string text = formatFailure(makeCase(), makeResult({expectation}), kPlain, false);
    EXPECT_NE(text.find("expected miss (2)  actual hit (1) "), std::string::npos) << text;
}

TEST(FailureText, withoutAWorstPixelTheCaseIsRunAgain)
{
    ExpectationResult expectation = makeFailure("HitSuccess", 1);
    expectation.comparison.worst.reset();
    const std::string text = formatFailure(makeCase(), makeResult({expectation}), kPlain, false);
    EXPECT_NE(text.find("crossray run hiz/two_planes --backend osmesa --planes all\n"), std::string::npos) << text;
}

TEST(FailureText, showsThreeUnlessAllAreAskedFor)
{
    const BackendResult result = makeResult(std::vector<ExpectationResult>(5, makeFailure("HitDepth", 1)));
    EXPECT_NE(formatFailure(makeCase(), result, kPlain, false).find("and 2 more"), std::string::npos);
    EXPECT_EQ(formatFailure(makeCase(), result, kPlain, true).find("more"), std::string::npos);
}

TEST(FailureText, aCrashShowsTheSignalAndTheLastLogLines)
{
    BackendResult result = makeResult({});
    result.verdict = Verdict::kCrash;
    result.reason = "signal 11 (Segmentation fault)";
    result.logLines = {"one", "two", "three", "four", "five", "six", "seven", "eight", "nine"};
    const std::string text = formatFailure(makeCase(), result, kPlain, false);
    EXPECT_TRUE(text.starts_with("CRASH hiz/two_planes  osmesa   signal 11 (Segmentation fault)\n")) << text;
    EXPECT_EQ(text.find("one"), std::string::npos);
    EXPECT_NE(text.find("      nine\n"), std::string::npos);
}

TEST(FailureText, aMustFailCaseNamesWhatPassed)
{
    CaseResult testCase = makeCase();
    testCase.mustFail = true;
    ExpectationResult passed = makeFailure("HitDepth", 0);
    passed.comparison.passed = true;
    const std::string text = formatFailure(testCase, makeResult({makeFailure("RayDirWS", 9), passed}), kPlain, false);
    EXPECT_TRUE(text.starts_with("FAIL  hiz/two_planes  osmesa  HitDepth   passed in a case that must fail\n")) << text;
    EXPECT_EQ(text.find("RayDirWS"), std::string::npos);
}

TEST(FailureText, namesOfSubCasesAreQuotedForTheShell)
{
    EXPECT_EQ(quoteForShell("hiz/two_planes"), "hiz/two_planes");
    EXPECT_EQ(quoteForShell("a[ior=1.2]"), "'a[ior=1.2]'");
    EXPECT_EQ(quoteForShell("it's"), "'it'\\''s'");
    EXPECT_EQ(quoteForShell(""), "''");
}
