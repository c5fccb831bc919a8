#include "harness/run/verdict.h"

#include <gtest/gtest.h>

using namespace crossray;

namespace {

ExpectationResult makeExpectation(bool passed, uint64_t failed = 0, std::string output = "HitDepth")
{
    ExpectationResult expectation;
    expectation.output = std::move(output);
    expectation.judged = true;
    expectation.comparison.passed = passed;
    expectation.comparison.compared = 100;
    expectation.comparison.failed = failed;
    expectation.comparison.reason = passed ? "" : "worst";
    return expectation;
}

BackendResult makeAnswer(std::vector<ExpectationResult> expectations)
{
    BackendResult result;
    result.backend = "osmesa";
    result.expectations = std::move(expectations);
    return result;
}

Case makeKnownCase(std::string until, std::vector<std::string> backends = {})
{
    Case testCase;
    testCase.knownFailures.push_back({std::move(backends), "#12", std::move(until), "driver bug"});
    return testCase;
}

} // namespace

TEST(Verdict, passesWhenAllPass)
{
    const Judgement judgement = judgeAnswer(Case{}, makeAnswer({makeExpectation(true)}), false);
    EXPECT_EQ(judgement.verdict, Verdict::kPass);
    EXPECT_TRUE(judgement.reason.empty());
}

TEST(Verdict, namesTheWorstFailureFirst)
{
    const BackendResult result = makeAnswer(
        {makeExpectation(false, 3, "HitDepth"), makeExpectation(true), makeExpectation(false, 90, "RayDirWS")});
    const Judgement judgement = judgeAnswer(Case{}, result, false);
    EXPECT_EQ(judgement.verdict, Verdict::kFail);
    EXPECT_EQ(judgement.reason, "RayDirWS: worst (and 1 more)");
}

TEST(Verdict, anyMessageFailsEvenWhatMustFail)
{
    BackendResult result = makeAnswer({makeExpectation(false, 5)});
    result.messages = {"VUID-1"};
    Case testCase;
    EXPECT_EQ(judgeAnswer(testCase, result, false).verdict, Verdict::kFail);
    testCase.mustFail = true;
    EXPECT_EQ(judgeAnswer(testCase, result, false).verdict, Verdict::kFail);
}

TEST(Verdict, aMissingGoldenIsNoPass)
{
    ExpectationResult golden;
    golden.missingGolden = true;
    EXPECT_EQ(judgeAnswer(Case{}, makeAnswer({makeExpectation(true), golden}), false).verdict, Verdict::kMissingGolden);
    Case mustFail;
    mustFail.mustFail = true;
    EXPECT_EQ(judgeAnswer(mustFail, makeAnswer({golden}), false).verdict, Verdict::kMissingGolden);
}

TEST(Verdict, whatWasNotJudgedIsSkippedUnlessOthersWereHeldToIt)
{
    ExpectationResult open;
    open.note = "cpu64 gave no answer to agree with";
    const Judgement skipped = judgeAnswer(Case{}, makeAnswer({open}), false);
    EXPECT_EQ(skipped.verdict, Verdict::kSkip);
    EXPECT_EQ(skipped.reason, open.note);
    EXPECT_EQ(judgeAnswer(Case{}, makeAnswer({}), true).verdict, Verdict::kPass);
}

TEST(Verdict, aMustFailCasePassesOnlyWhenEachExpectationFails)
{
    Case testCase;
    testCase.mustFail = true;
    EXPECT_EQ(judgeAnswer(testCase, makeAnswer({makeExpectation(false, 1)}), false).verdict, Verdict::kPass);
    EXPECT_EQ(judgeAnswer(testCase, makeAnswer({makeExpectation(true)}), false).verdict, Verdict::kFail);
    EXPECT_EQ(judgeAnswer(testCase, makeAnswer({makeExpectation(false, 1), makeExpectation(true)}), false).verdict,
              Verdict::kFail);
}

TEST(KnownFailure, holdsUntilItsLastDay)
{
    const Case testCase = makeKnownCase("2026-03-31");
    const Judgement failed{Verdict::kFail, "worst"};
    EXPECT_EQ(applyKnownFailures(testCase, "osmesa", "2026-03-31", failed).verdict, Verdict::kKnownFail);
    const Judgement after = applyKnownFailures(testCase, "osmesa", "2026-04-01", failed);
    EXPECT_EQ(after.verdict, Verdict::kFail);
    EXPECT_NE(after.reason.find("#12 ended on 2026-03-31"), std::string::npos);
}

TEST(KnownFailure, aPassIsUnknownWhileItHolds)
{
    const Case testCase = makeKnownCase("2026-03-31");
    EXPECT_EQ(applyKnownFailures(testCase, "osmesa", "2026-03-01", {Verdict::kPass, {}}).verdict,
              Verdict::kUnknownPass);
    EXPECT_EQ(applyKnownFailures(testCase, "osmesa", "2026-04-01", {Verdict::kPass, {}}).verdict, Verdict::kPass);
}

TEST(KnownFailure, speaksOfItsBackendsAlone)
{
    const Case testCase = makeKnownCase("2026-03-31", {"swiftshader"});
    EXPECT_EQ(applyKnownFailures(testCase, "osmesa", "2026-03-01", {Verdict::kFail, "worst"}).verdict, Verdict::kFail);
    EXPECT_EQ(applyKnownFailures(testCase, "swiftshader", "2026-03-01", {Verdict::kCrash, "signal 11"}).verdict,
              Verdict::kKnownFail);
}

TEST(KnownFailure, excusesNoMissingGolden)
{
    const Case testCase = makeKnownCase("2026-03-31");
    EXPECT_EQ(applyKnownFailures(testCase, "osmesa", "2026-03-01", {Verdict::kMissingGolden, "none"}).verdict,
              Verdict::kMissingGolden);
}

TEST(Counts, countEachVerdictOnceAndExitByTheGravest)
{
    RunResult run;
    CaseResult& testCase = run.cases.emplace_back();
    for (const Verdict verdict : allVerdicts())
        testCase.backends.emplace_back().verdict = verdict;
    const RunCounts counts = countVerdicts(run);
    EXPECT_EQ(formatCounts(counts), "1 passed, 6 failed, 2 skipped");
    EXPECT_EQ(computeExitCode(run), ExitCode::kFailed);
    run.brokenFiles.push_back("a.toml:1:1: unknown key");
    EXPECT_EQ(computeExitCode(run), ExitCode::kUsage);
    run.backends["lavapipe"].environmentError = "no device";
    EXPECT_EQ(computeExitCode(run), ExitCode::kEnvironment);
    run.interrupted = true;
    EXPECT_EQ(computeExitCode(run), ExitCode::kInterrupted);
    EXPECT_EQ(computeExitCode(RunResult{}), ExitCode::kAsExpected);
}

TEST(Verdicts, haveNamesThatReadBack)
{
    for (const Verdict verdict : allVerdicts())
        EXPECT_EQ(findVerdict(nameOf(verdict)), verdict);
    EXPECT_EQ(nameOf(Verdict::kMissingGolden), "missing-golden");
    EXPECT_FALSE(findVerdict("passed"));
}
