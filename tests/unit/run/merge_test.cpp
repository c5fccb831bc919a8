#include "harness/run/merge.h"

#include "harness/base/text.h"
#include "harness/run/attempt.h"
#include "harness/run/plane_files.h"
#include "harness/run/run_json.h"
#include "harness/run/run_plan.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <unistd.h>

namespace fs = std::filesystem;
using namespace crossray;

namespace {

// Runs of six cases on two backends; "d" fails on cpu64 and keeps its planes.
class MergeTest : public testing::Test {
  protected:
    void SetUp() override
    {
        const testing::TestInfo* const test = testing::UnitTest::GetInstance()->current_test_info();
        folder_ = fs::temp_directory_path() / fmt::format("crossray-merge-{}-{}", test->name(), getpid());
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    static inline const std::vector<std::string> kNames{"a", "b", "c", "d", "e", "f"};

    static RunResult makeRun(const std::vector<std::string>& names)
    {
        RunResult run;
        run.version = "1";
        run.started = "2026-01-31T12:00:00Z";
        run.plan.cases = kNames.size();
        run.plan.ownCases = names.size();
        run.plan.names = hashNames(kNames);
        run.plan.partition = names.size() == kNames.size() ? "whole" : "3 parts by name";
        run.plan.shaders = "shaders";
        run.plan.hash = "plan";
        for (const std::string backend : {"cpu32", "cpu64"})
            run.backends[backend].fingerprint = {backend, "none", "a device", "a driver", "", "a processor"};
        for (const std::string& name : names) {
            CaseResult& testCase = run.cases.emplace_back();
            testCase.name = name;
            for (const std::string backend : {"cpu32", "cpu64"}) {
                BackendResult& result = testCase.backends.emplace_back();
                result.backend = backend;
                result.verdict = name == "d" && backend == "cpu64" ? Verdict::kFail : Verdict::kPass;
                if (result.verdict == Verdict::kFail) result.planesFile = "planes/d/cpu64.exr";
            }
        }
        return run;
    }

    // Shard `index` of three has two cases.
    static RunResult makeShard(int index, const std::string& attempt = "x")
    {
        const auto at = static_cast<size_t>(index - 1) * 2;
        RunResult run = makeRun({kNames[at], kNames[at + 1]});
        run.shard = fmt::format("{}/3", index);
        run.attempt = attempt;
        return run;
    }

    fs::path write(const RunResult& run, const std::string& end = "") const
    {
        const Shard shard = Shard::parse(run.shard);
        const fs::path place = folder_ / "in" / (formatAttemptFolder({shard, run.attempt, false}) + end);
        fs::create_directories(place);
        for (const CaseResult& testCase : run.cases) {
            for (const BackendResult& result : testCase.backends) {
                if (result.planesFile.empty()) continue;
                fs::create_directories((place / result.planesFile).parent_path());
                writeFileWhole(place / result.planesFile, "planes of " + testCase.name);
            }
        }
        writeFileWhole(place / "run.json", formatRunJson(run));
        return place;
    }

    void writeAll() const
    {
        for (int index = 1; index <= 3; ++index)
            write(makeShard(index));
    }

    MergedRun merge(bool isPartial = false) const
    {
        MergeOptions options;
        options.inputs = {folder_ / "in"};
        options.output = folder_ / "out";
        options.junit = folder_ / "junit.xml";
        options.isPartial = isPartial;
        return mergeRuns(options, {"crossray", "merge"});
    }

    // The message of the error that the merge ends in; nothing is written then.
    std::string refuse() const
    {
        try {
            merge();
        } catch (const InputError& error) {
            EXPECT_FALSE(fs::exists(folder_ / "out"));
            return error.what();
        }
        ADD_FAILURE() << "it merged";
        return {};
    }

    fs::path folder_;
};

bool contains(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

} // namespace

TEST_F(MergeTest, theWholeHasTheCasesOfAllInOrderOfName)
{
    writeAll();
    const MergedRun merged = merge();
    EXPECT_EQ(merged.cases, 6u);
    EXPECT_EQ(merged.run.exitCode, 1);
    EXPECT_TRUE(merged.notes.empty());

    const RunResult run = readRun(folder_ / "out"), whole = makeRun(kNames);
    ASSERT_EQ(run.cases.size(), whole.cases.size());
    for (size_t i = 0; i < run.cases.size(); ++i)
        EXPECT_EQ(formatCaseJson(run.cases[i]), formatCaseJson(whole.cases[i]));
    EXPECT_EQ(formatCounts(countVerdicts(run)), "11 passed, 1 failed, 0 skipped");
    EXPECT_EQ(run.plan.partition, "whole");
    EXPECT_EQ(run.shard, "");
    ASSERT_EQ(run.parts.size(), 3u);
    EXPECT_EQ(run.parts[1].shard, "2/3");
    EXPECT_EQ(run.parts[1].cases, 2u);
    // What it wrote is what a run of these cases writes.
    EXPECT_EQ(*readText(folder_ / "out/run.json"), formatRunJson(run));
    EXPECT_EQ(*readText(folder_ / "out/planes/d/cpu64.exr"), "planes of d");
    EXPECT_TRUE(contains(*readText(folder_ / "junit.xml"), "tests=\"6\" failures=\"1\" errors=\"0\" skipped=\"0\""));
}

TEST_F(MergeTest, aMergedRunIsARunAndMergesAgain)
{
    writeAll();
    merge();
    MergeOptions options;
    options.inputs = {folder_ / "out"};
    options.output = folder_ / "again";
    EXPECT_EQ(mergeRuns(options, {}).cases, 6u);
    options.output = folder_ / "out/";
    EXPECT_THROW(mergeRuns(options, {}), InputError); // it would be cleared first
}

TEST_F(MergeTest, aMissingShardIsAnErrorUnlessAPartWillDo)
{
    write(makeShard(1));
    write(makeShard(3));
    EXPECT_TRUE(contains(refuse(), "1 of 3 shards is missing: 2/3")) << refuse();
    const MergedRun merged = merge(true);
    EXPECT_EQ(merged.cases, 4u);
    EXPECT_EQ(merged.run.missingParts, std::vector<std::string>{"2/3"});
    EXPECT_EQ(merged.run.exitCode, 1); // though what is there has passed
    EXPECT_EQ(readRun(folder_ / "out").missingParts, std::vector<std::string>{"2/3"});
}

TEST_F(MergeTest, ofTwoAttemptsTheWholeOneCounts)
{
    writeAll();
    RunResult cutOff = makeShard(2, "cut");
    cutOff.interrupted = true;
    cutOff.cases.clear();
    write(cutOff);
    RunResult noDevice = makeShard(2, "nodevice");
    noDevice.backends["cpu32"].environmentError = "no such device";
    write(noDevice);
    write(makeShard(3, "killed"), ".part");
    const MergedRun merged = merge();
    EXPECT_EQ(merged.cases, 6u);
    EXPECT_EQ(merged.notes.size(), 3u);
    EXPECT_EQ(merged.run.parts[1].attempt, "x");

    fs::remove_all(folder_ / "in/shard-2-of-3.x");
    fs::remove_all(folder_ / "out");
    const std::string error = refuse();
    EXPECT_TRUE(contains(error, "2/3") && contains(error, "no such device") && contains(error, "interrupted")) << error;
}

TEST_F(MergeTest, ofTwoWholeAttemptsThatAgreeTheFirstCounts)
{
    writeAll();
    RunResult earlier = makeShard(2, "earlier");
    earlier.started = "2026-01-31T11:00:00Z";
    earlier.cases[0].prepareMs = 7; // times differ
    write(earlier);
    const MergedRun merged = merge();
    EXPECT_EQ(merged.run.parts[1].attempt, "earlier");
    ASSERT_EQ(merged.notes.size(), 1u);
    EXPECT_TRUE(contains(merged.notes[0], "shard-2-of-3.x is left out")) << merged.notes[0];
}

TEST_F(MergeTest, attemptsWhoseVerdictsDifferAreAnErrorThatNamesTheCases)
{
    writeAll();
    RunResult other = makeShard(2, "y");
    other.cases[1].backends[1].verdict = Verdict::kPass; // "d" on cpu64
    write(other);
    const std::string error = refuse();
    EXPECT_TRUE(contains(error, "differ in the verdicts of d;")) << error;
    EXPECT_TRUE(contains(error, "2/3")) << error;
}

TEST_F(MergeTest, shardsOfAnotherPlanAreForeign)
{
    const std::vector<std::pair<std::string, void (*)(RunPlan&)>> changes{
        {"the shaders differ", [](RunPlan& plan) { plan.shaders = "others"; }},
        {"the harness differ", [](RunPlan& plan) { plan.harness = "others"; }},
        {"the options differ", [](RunPlan& plan) { plan.options = "others"; }},
        {"the files of the cases differ", [](RunPlan& plan) { plan.contents = "others"; }},
        {"other cases are selected", [](RunPlan& plan) { plan.names = "others"; }},
        {"the cases are parted otherwise", [](RunPlan& plan) { plan.partition = "4 parts by name"; }}};
    for (const auto& [text, change] : changes) {
        fs::remove_all(folder_ / "in");
        writeAll();
        RunResult other = makeShard(3);
        change(other.plan);
        write(other);
        const std::string error = refuse();
        EXPECT_TRUE(contains(error, text) && contains(error, "shard-3-of-3.x")) << error;
    }
    // Without a plan it is not known what it is a part of.
    fs::remove_all(folder_ / "in");
    writeAll();
    RunResult old = makeShard(3);
    old.plan = {};
    write(old);
    EXPECT_TRUE(contains(refuse(), "has no plan"));
}

TEST_F(MergeTest, casesInTwoShardsOrInNoneAreAnError)
{
    writeAll();
    RunResult third = makeShard(3);
    third.cases[0].name = "a";
    write(third);
    EXPECT_TRUE(contains(refuse(), "several shards hold a"));
    third.cases[0].name = "z";
    write(third);
    EXPECT_TRUE(contains(refuse(), "not the 6 of the plan"));
    third.cases.resize(1);
    write(third);
    EXPECT_TRUE(contains(refuse(), "has 1 of its 2 cases"));
    third.unchanged = {"e"}; // --changed left it out
    third.cases[0].name = "f";
    write(third);
    EXPECT_EQ(merge().run.unchanged, std::vector<std::string>{"e"});
}

TEST_F(MergeTest, machinesThatDifferAreTold)
{
    writeAll();
    RunResult third = makeShard(3);
    third.backends["cpu32"].fingerprint.cpu = "another processor";
    write(third);
    const MergedRun merged = merge();
    ASSERT_EQ(merged.notes.size(), 1u);
    EXPECT_TRUE(contains(merged.notes[0], "cpu32 ran on 2 kinds of machine")) << merged.notes[0];
}

TEST_F(MergeTest, aFileOutsideTheShardIsRefused)
{
    writeAll();
    RunResult second = makeShard(2);
    second.cases[1].backends[1].planesFile = "../../secret";
    second.cases[1].backends[1].traceFile = "";
    fs::create_directories(folder_ / "in/shard-2-of-3.x");
    writeFileWhole(folder_ / "in/shard-2-of-3.x/run.json", formatRunJson(second));
    EXPECT_THROW(merge(), InputError);
}

TEST_F(MergeTest, beyondWhatIsAtHandThePagesHaveTheFailures)
{
    writeAll();
    MergeOptions options;
    options.inputs = {folder_ / "in"};
    options.output = folder_ / "out";
    options.casesAtHand = 3;
    const MergedRun merged = mergeRuns(options, {});
    ASSERT_EQ(merged.run.cases.size(), 1u);
    EXPECT_EQ(merged.run.cases[0].name, "d");
    EXPECT_EQ(countVerdicts(merged.run).passed, 11); // of all
    EXPECT_EQ(readRun(folder_ / "out").cases.size(), 6u);
}

TEST(AttemptFolder, namesAreReadBack)
{
    const AttemptFolder folder{{2, 4}, "node-7.x_1", true};
    EXPECT_EQ(formatAttemptFolder(folder), "shard-2-of-4.node-7.x_1.part");
    const auto read = parseAttemptFolder("shard-2-of-4.node-7.x_1.part");
    ASSERT_TRUE(read);
    EXPECT_EQ(read->shard, folder.shard);
    EXPECT_EQ(read->attempt, folder.attempt);
    EXPECT_TRUE(read->isPart);
    EXPECT_FALSE(parseAttemptFolder(formatAttemptFolder({{2, 4}, makeAttemptName(), false}))->isPart);
    for (const char* other : {"planes", "shard-0-of-4.x", "shard-5-of-4.x", "shard-1-of-4", "shard-1-of-4.",
                              "shard-1.x", "shard-1-of-4.a b", "shard-1-of-4..x", "shard-a-of-4.x"})
        EXPECT_FALSE(parseAttemptFolder(other)) << other;
    EXPECT_NE(makeAttemptName(), "");
    for (const char* wrong : {"", "a/b", ".hidden", "x.part", "a b"})
        EXPECT_THROW(chooseAttemptFolder("/tmp", {1, 2}, wrong), InputError) << wrong;
}

TEST(RunSlices, takeTheTextApartAndNothingElse)
{
    const std::string text = R"({"a": "cases\": [", "cases" : [ {"x": "}]\\"}, [1, [2]] , 3 ], "b": {"cases": []}} )";
    const auto slices = sliceRunJson(text);
    ASSERT_TRUE(slices);
    EXPECT_EQ(slices->head, R"({"a": "cases\": [", "cases" : [], "b": {"cases": []}} )");
    ASSERT_EQ(slices->cases.size(), 3u);
    EXPECT_EQ(slices->cases[0], R"({"x": "}]\\"})");
    EXPECT_EQ(slices->cases[1], "[1, [2]]");
    EXPECT_TRUE(slices->cases[2].starts_with("3"));
    EXPECT_EQ(sliceRunJson(R"({"cases": []})")->cases.size(), 0u);
    for (size_t length = 0; length + 2 < text.size(); ++length)
        EXPECT_FALSE(sliceRunJson(text.substr(0, length))) << length;
    for (const char* broken : {"", "[]", "{}", "{\"cases\": 3}", "{\"cases\": [1,]}", "{\"cases\": [1 2}",
                               "{\"cases\": [], \"cases\": []}", "{\"cases\": [\"}"})
        EXPECT_FALSE(sliceRunJson(broken)) << broken;
}

TEST_F(MergeTest, aRunOfMoreCasesThanPagesShowIsReadByItsFailures)
{
    RunResult run = makeRun(kNames);
    fs::create_directories(folder_ / "whole");
    writeFileWhole(folder_ / "whole/run.json", formatRunJson(run));
    const RunAtHand all = readRunAtHand(folder_ / "whole", 6);
    EXPECT_EQ(formatRunJson(all.run), formatRunJson(run));
    EXPECT_EQ(describeLeftOut(all.run.cases.size(), all.cases), "");
    const RunAtHand failed = readRunAtHand(folder_ / "whole", 5);
    ASSERT_EQ(failed.run.cases.size(), 1u);
    EXPECT_EQ(failed.run.cases[0].name, "d");
    EXPECT_EQ(failed.cases, 6u);
    EXPECT_EQ(countVerdicts(failed.run).passed, countVerdicts(run).passed);
    EXPECT_TRUE(contains(describeLeftOut(1, 6), "5 of 6 cases")) << describeLeftOut(1, 6);
    EXPECT_TRUE(contains(describeLeftOut(0, 6), "none did"));
}

TEST_F(MergeTest, whatWasMeasuredOfPixelsComesAlong)
{
    writeAll();
    RunResult second = makeShard(2);
    second.cases[0].conditioning.emplace().file = "planes/c/conditioning.exr";
    const fs::path place = write(second);
    fs::create_directories(place / "planes/c");
    writeFileWhole(place / "planes/c/conditioning.exr", "measured");
    merge();
    EXPECT_EQ(readText(folder_ / "out/planes/c/conditioning.exr"), "measured");
}
