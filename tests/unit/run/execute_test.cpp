// The order of things, on backends that are functions.
#include "harness/run/execute.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <mutex>

using namespace crossray;

namespace {

// A 4x4 view of nothing, whose HitWeight is expected to be 1 everywhere.
Case makeCase(const std::string& name)
{
    Case testCase;
    testCase.name = name;
    testCase.position = {"cases/" + name + ".toml", 1, 1};
    testCase.camera.width = testCase.camera.height = 4;
    const OutputInfo output = *findOutput("HitWeight");
    testCase.outputs = {output};
    Expectation expectation;
    expectation.output = output;
    expectation.source = ConstantSource{{1.0}};
    expectation.tolerance.absolute = 0;
    expectation.where = Where::kAll;
    expectation.position = {"cases/" + name + ".toml", 9, 1};
    testCase.expectations = {expectation};
    return testCase;
}

Expectation makeAgreement(const std::vector<std::string>& backends)
{
    Expectation expectation = makeCase("x").expectations.front();
    expectation.source = AgreeSource{backends};
    return expectation;
}

// What a backend answers for a case: the value of every pixel, or a misfortune.
struct Reply {
    double value = 1;
    JobOutcome outcome = JobOutcome::kDone;
    std::vector<std::string> messages;
};

class Recorder : public RunObserver {
  public:
    void startBackend(const std::string&, const CaseResult&) override { ++started; }
    void finishBackend(const CaseResult&, const BackendResult&) override { ++finishedBackends; }
    void finishCase(const CaseResult& testCase) override { finishedCases.push_back(testCase.name); }
    void tick() override {}
    int started = 0, finishedBackends = 0;
    std::vector<std::string> finishedCases;
};

struct Bench {
    ExecuteOptions options;
    std::map<std::string, std::function<Reply(const std::string& caseName)>> backends;
    std::function<void(const Case&)> onPrepare = [](const Case&) {};
    std::atomic<bool> interrupted{false};
    Recorder recorder;

    explicit Bench(std::vector<std::string> names)
    {
        options.backends = std::move(names);
        options.keepPlanes = KeepPlanes::kNone;
        options.today = "2026-01-01";
        options.cores = 2;
        for (const std::string& name : options.backends)
            backends[name] = [](const std::string&) { return Reply{}; };
    }

    ExecuteSteps makeSteps()
    {
        ExecuteSteps steps;
        steps.prepare = [this](const Case& testCase, bool, bool) {
            onPrepare(testCase);
            PreparedCase prepared;
            prepared.data = std::make_shared<const CaseData>(testCase);
            prepared.floatJob.emplace().label = testCase.name;
            prepared.doubleJob = prepared.floatJob;
            return prepared;
        };
        steps.open = [](const std::string& backend, int) { return Fingerprint{backend, "none", backend, "", "", ""}; };
        steps.run = [this](const std::string& backend, int, const Job& job, std::chrono::duration<double>) {
            const Reply reply = backends.at(backend)(job.label);
            JobReport report;
            report.outcome = reply.outcome;
            report.text = reply.outcome == JobOutcome::kCrash ? "signal 11" : "";
            report.result.readbacks = {std::vector<double>(16, reply.value)};
            report.result.messages = reply.messages;
            return report;
        };
        steps.readPlanes = [](const Case&, const JobResult& result) {
            Plane plane("HitWeight", 4, 4, 1);
            plane.values = result.readbacks.front();
            return std::vector<Plane>{plane};
        };
        steps.killWorkers = [] {};
        return steps;
    }

    RunResult run(const std::vector<Case>& cases)
    {
        RunResult result;
        execute(cases, options, makeSteps(), recorder, interrupted, result);
        return result;
    }
};

const BackendResult& resultOf(const RunResult& run, const std::string& testCase, const std::string& backend)
{
    for (const CaseResult& item : run.cases) {
        for (const BackendResult& result : item.backends) {
            if (item.name == testCase && result.backend == backend) return result;
        }
    }
    throw std::runtime_error("no result of " + testCase + " on " + backend);
}

Verdict verdictOf(const RunResult& run, const std::string& testCase, const std::string& backend)
{
    return resultOf(run, testCase, backend).verdict;
}

} // namespace

TEST(Execute, judgesEachCaseOnEachBackend)
{
    Bench bench({"osmesa", "cpu64"});
    bench.backends["osmesa"] = [](const std::string& name) {
        return Reply{name == "b" ? 0.5 : 1.0, JobOutcome::kDone, {}};
    };
    const RunResult run = bench.run({makeCase("a"), makeCase("b"), makeCase("c")});
    EXPECT_EQ(formatCounts(countVerdicts(run)), "5 passed, 1 failed, 0 skipped");
    EXPECT_EQ(verdictOf(run, "b", "osmesa"), Verdict::kFail);
    EXPECT_EQ(verdictOf(run, "b", "cpu64"), Verdict::kPass);
    EXPECT_EQ(bench.recorder.finishedBackends, 6);
    EXPECT_EQ(bench.recorder.finishedCases.size(), 3u);
    EXPECT_EQ(run.cases[0].backends[0].backend, "osmesa"); // in the run's order, whoever came first
    EXPECT_GE(run.firstVerdictMs, 0);
}

TEST(Execute, aCrashCostsOneCase)
{
    Bench bench({"osmesa"});
    bench.backends["osmesa"] = [](const std::string& name) {
        return Reply{1, name == "b" ? JobOutcome::kCrash : JobOutcome::kDone, {}};
    };
    const RunResult run = bench.run({makeCase("a"), makeCase("b"), makeCase("c")});
    EXPECT_EQ(verdictOf(run, "b", "osmesa"), Verdict::kCrash);
    EXPECT_EQ(resultOf(run, "b", "osmesa").reason, "signal 11");
    EXPECT_EQ(formatCounts(countVerdicts(run)), "2 passed, 1 failed, 0 skipped");
}

TEST(Execute, agreementWaitsForTheReferenceAndIsHeldAgainstIt)
{
    Bench bench({"lavapipe", "osmesa", "cpu64"});
    Case testCase = makeCase("a");
    testCase.expectations = {makeAgreement({"lavapipe", "osmesa", "cpu64"})};
    bench.backends["osmesa"] = [](const std::string&) { return Reply{0.75, JobOutcome::kDone, {}}; };
    const RunResult run = bench.run({testCase});
    EXPECT_EQ(verdictOf(run, "a", "lavapipe"), Verdict::kPass);
    EXPECT_EQ(verdictOf(run, "a", "osmesa"), Verdict::kFail);
    EXPECT_EQ(verdictOf(run, "a", "cpu64"), Verdict::kPass);
    EXPECT_EQ(resultOf(run, "a", "osmesa").expectations.at(0).source, "agree with cpu64");
}

TEST(Execute, agreementWithABackendThatDidNotAnswerIsSkippedWithAReason)
{
    Bench bench({"lavapipe", "cpu64"});
    Case testCase = makeCase("a");
    testCase.expectations = {makeAgreement({"lavapipe", "cpu64"})};
    bench.backends["cpu64"] = [](const std::string&) { return Reply{1, JobOutcome::kTimeout, {}}; };
    const RunResult run = bench.run({testCase});
    EXPECT_EQ(verdictOf(run, "a", "cpu64"), Verdict::kTimeout);
    EXPECT_EQ(verdictOf(run, "a", "lavapipe"), Verdict::kSkip);
    EXPECT_EQ(resultOf(run, "a", "lavapipe").reason, "cpu64 gave no answer to agree with");
}

TEST(Execute, aMustFailCasePassesByFailing)
{
    Bench bench({"osmesa"});
    Case failing = makeCase("failing"), passing = makeCase("passing");
    failing.mustFail = passing.mustFail = true;
    bench.backends["osmesa"] = [](const std::string& name) {
        return Reply{name == "failing" ? 0.0 : 1.0, JobOutcome::kDone, {}};
    };
    const RunResult run = bench.run({failing, passing});
    EXPECT_EQ(verdictOf(run, "failing", "osmesa"), Verdict::kPass);
    EXPECT_EQ(verdictOf(run, "passing", "osmesa"), Verdict::kFail);
}

TEST(Execute, aMessageOfTheDriverFailsTheCase)
{
    Bench bench({"lavapipe"});
    bench.backends["lavapipe"] = [](const std::string&) { return Reply{1, JobOutcome::kDone, {"VUID-1"}}; };
    const RunResult run = bench.run({makeCase("a")});
    EXPECT_EQ(verdictOf(run, "a", "lavapipe"), Verdict::kFail);
}

TEST(Execute, aBackendThatTheCaseDoesNotNameIsSkipped)
{
    Bench bench({"osmesa", "cpu64"});
    Case testCase = makeCase("a");
    testCase.backends = {"cpu64"};
    const RunResult run = bench.run({testCase});
    EXPECT_EQ(verdictOf(run, "a", "osmesa"), Verdict::kSkip);
    EXPECT_EQ(verdictOf(run, "a", "cpu64"), Verdict::kPass);
}

TEST(Execute, aRepeatThatDiffersFailsOnASoftwareRasterizer)
{
    Bench bench({"osmesa"});
    bench.options.repeat = 3;
    std::atomic<int> calls{0};
    bench.backends["osmesa"] = [&](const std::string& name) {
        const bool differs = name == "b" && calls++ == 2;
        return Reply{differs ? 1.0 + std::numeric_limits<double>::epsilon() : 1.0, JobOutcome::kDone, {}};
    };
    const RunResult run = bench.run({makeCase("a"), makeCase("b")});
    EXPECT_EQ(verdictOf(run, "a", "osmesa"), Verdict::kPass);
    EXPECT_EQ(verdictOf(run, "b", "osmesa"), Verdict::kFail);
    EXPECT_EQ(resultOf(run, "b", "osmesa").reason, "repeat 3 differs: HitWeight in 16 values, first at (0, 0)");
}

TEST(Execute, stopsAtTheFirstFailureWhenAsked)
{
    Bench bench({"osmesa"});
    bench.options.cores = 1;
    bench.options.maxFailures = 1;
    bench.backends["osmesa"] = [](const std::string&) { return Reply{0, JobOutcome::kDone, {}}; };
    const RunResult run = bench.run({makeCase("a"), makeCase("b"), makeCase("c")});
    EXPECT_TRUE(run.stoppedEarly);
    EXPECT_EQ(formatCounts(countVerdicts(run)), "0 passed, 1 failed, 0 skipped");
}

TEST(Execute, aBrokenCaseStopsTheRunUnlessItShallKeepGoing)
{
    for (const bool keepGoing : {false, true}) {
        Bench bench({"osmesa"});
        bench.options.cores = 1;
        bench.options.keepGoing = keepGoing;
        bench.onPrepare = [](const Case& testCase) {
            if (testCase.name == "a") throw InputError({"room.exr", 0, 0}, "is truncated");
        };
        const RunResult run = bench.run({makeCase("a"), makeCase("b")});
        EXPECT_EQ(run.brokenFiles, std::vector<std::string>{"room.exr: is truncated"});
        EXPECT_EQ(verdictOf(run, "a", "osmesa"), Verdict::kError);
        EXPECT_EQ(run.cases.size(), keepGoing ? 2u : 1u);
        EXPECT_EQ(computeExitCode(run), ExitCode::kUsage);
    }
}

TEST(Execute, aShaderThatDoesNotCompileIsAnErrorOfItsCases)
{
    Bench bench({"osmesa", "cpu64"});
    bench.onPrepare = [](const Case& testCase) {
        if (testCase.name == "a") throw ShaderError("hiz.glsl:3:1: error: no");
    };
    const RunResult run = bench.run({makeCase("a"), makeCase("b")});
    EXPECT_EQ(verdictOf(run, "a", "cpu64"), Verdict::kError);
    EXPECT_EQ(verdictOf(run, "b", "cpu64"), Verdict::kPass);
    EXPECT_EQ(computeExitCode(run), ExitCode::kFailed);
}

TEST(Execute, aBackendThatCannotBeOpenedIsTriedOnce)
{
    Bench bench({"osmesa", "cpu64"});
    ExecuteSteps steps = bench.makeSteps();
    std::atomic<int> tries{0};
    steps.open = [&tries](const std::string& backend, int) {
        if (backend == "osmesa") {
            ++tries;
            throw EnvironmentError("no context");
        }
        return Fingerprint{backend, "none", "", "", "", ""};
    };
    bench.options.cores = 1;
    RunResult run;
    execute({makeCase("a"), makeCase("b")}, bench.options, steps, bench.recorder, bench.interrupted, run);
    EXPECT_EQ(tries, 1);
    EXPECT_EQ(verdictOf(run, "b", "osmesa"), Verdict::kError);
    EXPECT_EQ(verdictOf(run, "b", "cpu64"), Verdict::kPass);
    EXPECT_EQ(run.backends.at("osmesa").environmentError, "no context");
    EXPECT_EQ(computeExitCode(run), ExitCode::kEnvironment);
}

TEST(Execute, anInterruptionKeepsWhatIsDoneAndBlamesNobody)
{
    Bench bench({"osmesa"});
    bench.options.cores = 1;
    bench.backends["osmesa"] = [&](const std::string& name) {
        if (name != "b") return Reply{};
        bench.interrupted = true; // the signal comes, and the worker is killed
        return Reply{1, JobOutcome::kCrash, {}};
    };
    const RunResult run = bench.run({makeCase("a"), makeCase("b"), makeCase("c")});
    EXPECT_TRUE(run.interrupted);
    ASSERT_EQ(run.cases.size(), 1u);
    EXPECT_EQ(run.cases[0].name, "a");
    EXPECT_EQ(computeExitCode(run), ExitCode::kInterrupted);
}

TEST(Execute, whatIsNotAboutACaseEndsTheRun)
{
    Bench bench({"osmesa"});
    bench.onPrepare = [](const Case&) { throw EnvironmentError("the disk is full"); };
    EXPECT_THROW(bench.run({makeCase("a"), makeCase("b")}), EnvironmentError);
}

TEST(Execute, manyCasesOnManyCoresGiveOneVerdictEach)
{
    Bench bench({"lavapipe", "osmesa", "cpu32", "cpu64"});
    bench.options.cores = 8;
    std::vector<Case> cases;
    for (int i = 0; i < 100; ++i) {
        cases.push_back(makeCase("case" + std::to_string(i)));
        cases.back().expectations.push_back(makeAgreement({"lavapipe", "osmesa", "cpu64"}));
    }
    const RunResult run = bench.run(cases);
    EXPECT_EQ(formatCounts(countVerdicts(run)), "400 passed, 0 failed, 0 skipped");
    EXPECT_EQ(bench.recorder.finishedBackends, 400);
    EXPECT_EQ(bench.recorder.finishedCases.size(), 100u);
}
