// Shards and their merge from outside.
#include "tests/cli/program.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <regex>

namespace fs = std::filesystem;

namespace {

class ShardTest : public CliTest {
  protected:
    // 16 cases; one fails on both backends, and one does not run on cpu32.
    void writeCases() const
    {
        for (int i = 0; i < 16; ++i)
            writeCase(fmt::format("cases/{}.toml", i), fmt::format("set/case{}", i),
                      i == 3 ? "backends = [\"cpu64\"]" : "", i == 5 ? kFails : kHolds);
    }

    // The folders of shards below one, by name.
    std::vector<std::string> listShards(const std::string& folder) const
    {
        std::vector<std::string> names;
        for (const auto& entry : fs::directory_iterator(folder_ / folder)) {
            if (entry.path().filename().string().starts_with("shard-")) names.push_back(entry.path().filename());
        }
        std::sort(names.begin(), names.end());
        return names;
    }
};

constexpr const char* kCpu = "--backend cpu32,cpu64 --no-report -q";

// All that two runs of one plan have in common.
nlohmann::json withoutTimes(nlohmann::json run)
{
    for (const char* key :
         {"started", "seconds", "firstVerdictMs", "commandLine", "toolPeakBytes", "workersPeakBytes", "parts", "cores"})
        run.erase(key);
    for (auto& [name, backend] : run["backends"].items())
        backend.erase("startMs");
    for (auto& testCase : run["cases"]) {
        testCase.erase("times");
        testCase.erase("answeredBy");
        for (auto& result : testCase["backends"]) {
            result.erase("times");
            result.erase("programsWereWarm");
        }
    }
    return run;
}

std::string withoutTimes(const std::string& junit)
{
    return std::regex_replace(junit, std::regex(" time(stamp)?=\"[^\"]*\""), "");
}

} // namespace

TEST_F(ShardTest, theMergedRunEqualsTheUnsharded)
{
    writeCases();
    EXPECT_EQ(run(fmt::format("run {} -o whole --junit whole.xml", kCpu)).exitCode, 1);
    for (int index = 1; index <= 3; ++index) {
        const Outcome outcome = run(fmt::format("run {} -o shards --shard {}/3", kCpu, index));
        EXPECT_NE(outcome.err.find(fmt::format("part {} of 3", index)), std::string::npos) << outcome.err;
    }
    ASSERT_EQ(listShards("shards").size(), 3u);
    const Outcome merged = run("merge shards -o merged --junit merged.xml");
    EXPECT_EQ(merged.exitCode, 1) << merged.err;
    EXPECT_EQ(merged.lastLine(), "29 passed, 2 failed, 1 skipped");
    EXPECT_EQ(withoutTimes(readRun("merged")), withoutTimes(readRun("whole")));
    EXPECT_EQ(withoutTimes(readFile("merged.xml")), withoutTimes(readFile("whole.xml")));
    EXPECT_EQ(readFile("merged/planes/set/case5/cpu64.exr"), readFile("whole/planes/set/case5/cpu64.exr"));
    EXPECT_TRUE(fs::exists(folder_ / "merged/planes/set/case5/expected.exr"));
    EXPECT_TRUE(fs::exists(folder_ / "merged/planes/set/case5/cpu64.trace.json"));
    EXPECT_TRUE(fs::exists(folder_ / "merged/report/index.html"));
    EXPECT_EQ(run("diff whole merged").exitCode, 0);
    // What passed is known to --changed.
    EXPECT_EQ(run(fmt::format("run {} --changed -o merged", kCpu)).lastLine(), "0 passed, 2 failed, 0 skipped");
}

TEST_F(ShardTest, partsByTimesAreAPartitionToo)
{
    writeCases();
    run(fmt::format("run {} -o whole", kCpu));
    for (int index = 1; index <= 3; ++index)
        run(fmt::format("run {} -o shards --shard {}/3 --timings whole", kCpu, index));
    EXPECT_EQ(run("merge shards -o merged --no-report").exitCode, 1);
    EXPECT_EQ(withoutTimes(readRun("merged")), withoutTimes(readRun("whole")));
    // A part by name is none of these.
    run(fmt::format("run {} -o shards --shard 2/3", kCpu));
    const Outcome mixed = run("merge shards -o mixed");
    EXPECT_EQ(mixed.exitCode, 2);
    EXPECT_NE(mixed.err.find("the cases are parted otherwise"), std::string::npos) << mixed.err;
    EXPECT_EQ(run("run --timings whole").exitCode, 2);
    EXPECT_EQ(run("run --shard 1/2 --timings nowhere").exitCode, 2);
}

TEST_F(ShardTest, aPartWithoutCasesIsWhole)
{
    writeCase("cases/a.toml", "a");
    for (int index = 1; index <= 3; ++index) {
        const Outcome outcome = run(fmt::format("run {} -o shards --shard {}/3", kCpu, index));
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    }
    const Outcome merged = run("merge shards -o merged");
    EXPECT_EQ(merged.exitCode, 0) << merged.err;
    EXPECT_EQ(merged.lastLine(), "2 passed, 0 failed, 0 skipped");
    EXPECT_EQ(run(fmt::format("run {} --shard 1/3 -k nothing", kCpu)).exitCode, 4);
}

TEST_F(ShardTest, anAttemptThatWasCutOffKeepsItsNameAndIsNoShard)
{
    writeCases();
    // Stopped by its first failure, whichever part that is in.
    for (int index = 1; index <= 2; ++index)
        run(fmt::format("run {} -o shards --shard {}/2 --attempt first -x", kCpu, index));
    int parts = 0;
    for (const std::string& name : listShards("shards"))
        parts += name.ends_with(".first.part") ? 1 : 0;
    EXPECT_EQ(parts, 1);
    const Outcome missing = run("merge shards -o merged");
    EXPECT_EQ(missing.exitCode, 2);
    EXPECT_NE(missing.err.find("1 of 2 shards is missing"), std::string::npos) << missing.err;
    EXPECT_EQ(run("merge shards -o merged --partial").exitCode, 1);

    for (int index = 1; index <= 2; ++index)
        run(fmt::format("run {} -o shards --shard {}/2 --attempt second", kCpu, index));
    const Outcome merged = run("merge shards -o merged");
    EXPECT_EQ(merged.lastLine(), "29 passed, 2 failed, 1 skipped") << merged.err;
    EXPECT_NE(merged.err.find(".first.part is left out"), std::string::npos) << merged.err;
    const Outcome again = run(fmt::format("run {} -o shards --shard 1/2 --attempt second", kCpu));
    EXPECT_EQ(again.exitCode, 2);
    EXPECT_NE(again.err.find("is there already"), std::string::npos) << again.err;
}

TEST_F(ShardTest, enginesNameThePartOnRequestAlone)
{
    writeCases();
    const Outcome whole = run(fmt::format("run {} -v", kCpu), "CI_NODE_INDEX=2 CI_NODE_TOTAL=4");
    EXPECT_EQ(whole.lastLine(), "29 passed, 2 failed, 1 skipped");
    const Outcome told = run("run --backend cpu64 --no-report", "CI_NODE_INDEX=2 CI_NODE_TOTAL=4");
    EXPECT_NE(
        told.err.find("gitlab names a part of several (CI_NODE_INDEX=2, CI_NODE_TOTAL=4), and this run takes all"),
        std::string::npos)
        << told.err;
    const Outcome part = run(fmt::format("run {} --shard auto -o shards", kCpu), "CI_NODE_INDEX=2 CI_NODE_TOTAL=4");
    EXPECT_NE(part.err.find("part 2 of 4 (gitlab: CI_NODE_INDEX=2, CI_NODE_TOTAL=4): "), std::string::npos) << part.err;
    EXPECT_EQ(listShards("shards").size(), 1u);
    EXPECT_TRUE(listShards("shards")[0].starts_with("shard-2-of-4."));
    run(fmt::format("run {} --shard auto -o bazel", kCpu),
        "TEST_SHARD_INDEX=0 TEST_TOTAL_SHARDS=2 TEST_SHARD_STATUS_FILE=status");
    EXPECT_TRUE(fs::exists(folder_ / "status"));
    EXPECT_EQ(run(fmt::format("run {} --shard auto", kCpu)).exitCode, 2);
}

TEST_F(ShardTest, aFileThatACaseNamesIsPartOfThePlan)
{
    writeCases();
    const char* const kMore = "backends = [\"cpu64\"]\n[projection]\nmodel = \"own\"\ntracer = \"mine.glsl\"";
    writeCase("cases/own.toml", "own", kMore);
    writeFile("cases/mine.glsl", "OwnHit traceOwn(OwnRay ray)\n{\n    return ownEnd(kHitReasonSky, vec2(0.0));\n}\n");
    for (int index = 1; index <= 2; ++index)
        run(fmt::format("run {} -o shards --shard {}/2 --attempt first", kCpu, index));
    EXPECT_EQ(run("merge shards -o merged --no-report").exitCode, 1);
    // Whichever part the case is in, the other one has to hear of it.
    writeFile("cases/mine.glsl", readFile("cases/mine.glsl") + "// an edit\n");
    for (int index = 1; index <= 2; ++index) {
        run(fmt::format("run {} -o edited --shard {}/2 --attempt second", kCpu, index));
        const int other = 3 - index;
        const Outcome mixed = run(fmt::format(
            "merge shards/shard-{}-of-2.first edited/shard-{}-of-2.second -o mixed --no-report", other, index));
        EXPECT_EQ(mixed.exitCode, 2);
        EXPECT_NE(mixed.err.find("the files of the cases differ"), std::string::npos) << mixed.err;
    }
}

TEST_F(ShardTest, whatIsNoShardIsToldInOneLine)
{
    writeFile("empty/readme", "");
    for (const char* wrong : {"merge", "merge nowhere", "merge empty", "merge cases -o x"}) {
        const Outcome outcome = run(wrong);
        EXPECT_EQ(outcome.exitCode, 2) << wrong;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    }
}

TEST_F(ShardTest, ctestRunsEachCaseWithItsTagsAsLabels)
{
    writeCase("cases/a.toml", "set/a", "tags = [\"quick\", \"two-words\"]\nbackends = [\"cpu64\"]");
    writeCase("cases/b.toml", "set/b", "tags = [\"quick\"]\nbackends = [\"cpu64\"]", kFails);
    writeCase("cases/c.toml", "c", "backends = [\"cpu64\"]");
    EXPECT_EQ(run("list --ctest tests").out, "3 tests; ctest --test-dir tests\n");
    const auto ctest = [&](const std::string& arguments) {
        const std::string command =
            fmt::format("cd '{}' && CROSSRAY_CACHE='{}' ctest --test-dir tests {} >ctest.out 2>&1", folder_.string(),
                        fs::absolute("cli-test-cache").string(), arguments);
        return std::system(command.c_str()) == 0;
    };
    EXPECT_TRUE(ctest("--print-labels"));
    EXPECT_NE(readFile("ctest.out").find("two-words"), std::string::npos) << readFile("ctest.out");
    EXPECT_TRUE(ctest("-L 'two-words' --no-tests=error")) << readFile("ctest.out");
    EXPECT_NE(readFile("ctest.out").find("tests passed, 0 tests failed out of 1"), std::string::npos);
    EXPECT_FALSE(ctest("-L quick")); // b fails
    EXPECT_NE(readFile("ctest.out").find("1 tests failed out of 2"), std::string::npos) << readFile("ctest.out");
    EXPECT_TRUE(fs::exists(folder_ / "tests/out/set/b/planes/set/b/cpu64.exr"));
}

// The lines of docs/integration.md, as another project has them.
TEST_F(ShardTest, anotherProjectHasItsCasesAmongItsTests)
{
    writeCase("project/cases/a.toml", "set/a", "tags = [\"quick\"]\nbackends = [\"cpu64\"]");
    writeCase("project/cases/b.toml", "set/b", "tags = [\"slow\"]\nbackends = [\"cpu64\"]", kFails);
    std::ifstream document(fs::path(CROSSRAY_SOURCE_DIR) / "docs/integration.md");
    std::string lines, line;
    while (std::getline(document, line) && line != "```cmake") {
    }
    while (std::getline(document, line) && line != "```")
        lines += line + "\n";
    ASSERT_NE(lines.find("list"), std::string::npos);
    writeFile("project/CMakeLists.txt",
              "cmake_minimum_required(VERSION 3.25)\nproject(other LANGUAGES NONE)\nenable_testing()\n" + lines);
    const auto shell = [&](const std::string& command) {
        return std::system(fmt::format("cd '{}' && CROSSRAY_CACHE='{}' {} >shell.out 2>&1", folder_.string(),
                                       fs::absolute("cli-test-cache").string(), command)
                               .c_str()) == 0;
    };
    ASSERT_TRUE(
        shell(fmt::format("cmake -G Ninja -S project -B b -D CMAKE_PROGRAM_PATH='{}'", fs::absolute(".").string())))
        << readFile("shell.out");
    EXPECT_TRUE(shell("ctest --test-dir b -L quick --no-tests=error")) << readFile("shell.out");
    EXPECT_FALSE(shell("ctest --test-dir b"));
    EXPECT_NE(readFile("shell.out").find("1 tests failed out of 2"), std::string::npos) << readFile("shell.out");
    EXPECT_TRUE(fs::exists(folder_ / "b/cases/out/set/b/planes/set/b/cpu64.exr"));
}
