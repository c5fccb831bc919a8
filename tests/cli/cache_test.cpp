// Verdicts that are known already: the cache of all runs, and an interrupted run that goes on.
#include "tests/cli/program.h"

#include <fmt/format.h>

#include <csignal>
#include <filesystem>
#include <thread>

namespace {

namespace fs = std::filesystem;

class CacheTest : public CliTest {
  protected:
    std::string answeredBy(const std::string& name, const std::string& runFolder = "out/last") const
    {
        const nlohmann::json run = readRun(runFolder);
        for (const nlohmann::json& testCase : run["cases"]) {
            if (testCase["name"] == name) return testCase["answeredBy"];
        }
        return "not there";
    }
};

} // namespace

TEST_F(CacheTest, theSecondRunIsAnsweredFromTheFirst)
{
    writeCase("cases/a.toml", "a");
    writeCase("cases/b.toml", "b", "", kFails);
    const Outcome first = run("run --backend cpu64,lavapipe --progress lines");
    EXPECT_EQ(first.lastLine(), "2 passed, 2 failed, 0 skipped");
    EXPECT_EQ(answeredBy("a"), "");
    const Outcome second = run("run --backend cpu64,lavapipe --progress lines");
    EXPECT_EQ(second.lastLine(), "2 passed, 2 failed, 0 skipped");
    EXPECT_EQ(second.exitCode, 1);
    EXPECT_EQ(answeredBy("a"), "cache");
    EXPECT_EQ(answeredBy("b"), "") << "what failed runs again, for its planes";
    EXPECT_NE(second.out.find("2 backends, from the cache"), std::string::npos) << second.out;
    EXPECT_NE(second.out.find("1 case answered from the cache"), std::string::npos) << second.out;

    run("run --backend cpu64,lavapipe --no-cache");
    EXPECT_EQ(answeredBy("a"), "");
    run("run --backend cpu64,lavapipe --planes all");
    EXPECT_EQ(answeredBy("a"), "") << "planes are not kept in the cache";
    run("run --backend cpu64,lavapipe --validate");
    EXPECT_EQ(answeredBy("a"), "") << "nobody has validated it";
    run("run --backend cpu64");
    EXPECT_EQ(answeredBy("a"), "cache");
}

TEST_F(CacheTest, anEditedCaseRunsAgain)
{
    writeCase("cases/a.toml", "a");
    run("run --backend cpu64");
    writeFile("cases/a.toml", readFile("cases/a.toml") + "# an edit\n");
    run("run --backend cpu64");
    EXPECT_EQ(answeredBy("a"), "");
    run("run --backend cpu64");
    EXPECT_EQ(answeredBy("a"), "cache");
}

TEST_F(CacheTest, anEditedShaderRunsTheCasesThatIncludeIt)
{
    fs::copy(fs::absolute(CROSSRAY_SOURCE_DIR) / "shaders", folder_ / "shaders", fs::copy_options::recursive);
    writeCase("cases/a.toml", "a");
    const std::string command = "run --backend lavapipe --shaders shaders";
    run(command);
    run(command);
    EXPECT_EQ(answeredBy("a"), "cache");
    const auto edit = [&](const std::string& file) { writeFile(file, readFile(file) + "\n// an edit\n"); };
    edit("shaders/entry/depth_pyramid.comp"); // no ray is cast
    run(command);
    EXPECT_EQ(answeredBy("a"), "cache");
    edit("shaders/crossray/core/view.glsl");
    run(command);
    EXPECT_EQ(answeredBy("a"), "");
}

TEST_F(CacheTest, aCacheThatCannotBeWrittenIsNoError)
{
    writeCase("cases/a.toml", "a");
    writeFile("taken", "a file");
    EXPECT_EQ(run("run --backend cpu64 --cache-dir taken").exitCode, 0);
    EXPECT_EQ(run("run --backend cpu64 --cache-dir taken").exitCode, 0);
    EXPECT_EQ(answeredBy("a"), "");
    EXPECT_EQ(readFile("taken"), "a file");
}

TEST_F(CacheTest, statsSayWhatIsThereAndClearEmptiesIt)
{
    writeCase("cases/a.toml", "a");
    run("run --backend cpu64");
    const Outcome stats = run("cache stats");
    EXPECT_NE(stats.out.find("results       1 files"), std::string::npos) << stats.out;
    EXPECT_NE(stats.out.find("of at most 1024.0 MiB"), std::string::npos) << stats.out;
    EXPECT_EQ(run("cache clear nonsense").exitCode, 2);
    EXPECT_EQ(run("cache clear results").exitCode, 0);
    EXPECT_NE(run("cache stats").out.find("results       0 files"), std::string::npos);
    run("run --backend cpu64");
    EXPECT_EQ(answeredBy("a"), "");
    EXPECT_EQ(run("cache").exitCode, 2);
    EXPECT_EQ(run("--cache-size 0 cache stats").exitCode, 2);
}

TEST_F(CacheTest, anInterruptedRunGoesOnWhereItWasKilled)
{
    for (int i = 0; i < 60; ++i) {
        const std::string name = fmt::format("case_{:02}", i);
        writeCase("cases/" + name + ".toml", name, "", i % 10 == 0 ? kFails : kHolds);
    }
    // Killed outright, as by a machine that is taken away.
    const Outcome killed = runWhile("run --backend cpu64 --no-cache --timeout 60 --repeat 40 -j1", [&](int process) {
        const fs::path journal = folder_ / "out/last/finished.jsonl";
        for (int i = 0; i < 6000; ++i) {
            std::error_code failure;
            if (const auto size = fs::file_size(journal, failure); !failure && size > 20'000) break;
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        kill(process, SIGKILL);
    });
    EXPECT_NE(killed.exitCode, 0);
    EXPECT_TRUE(readRun()["interrupted"]);

    const Outcome resumed = run("run --backend cpu64 --no-cache --timeout 60 --repeat 40 --resume");
    EXPECT_EQ(resumed.exitCode, 1) << resumed.err;
    EXPECT_EQ(resumed.lastLine(), "54 passed, 6 failed, 0 skipped");
    const nlohmann::json json = readRun();
    int taken = 0, takenFailures = 0;
    for (const nlohmann::json& testCase : json["cases"]) {
        if (testCase["answeredBy"] != "interrupted run") continue;
        ++taken;
        if (testCase["backends"][0]["verdict"] != "fail") continue;
        ++takenFailures;
        EXPECT_TRUE(fs::exists(folder_ / "out/last" / testCase["backends"][0]["planes"].get<std::string>()));
    }
    EXPECT_EQ(json["cases"].size(), 60u);
    EXPECT_GT(taken, 3);
    EXPECT_GT(takenFailures, 0);
    EXPECT_FALSE(fs::exists(folder_ / "out/last/finished.jsonl"));

    const Outcome again = run("run --backend cpu64 --resume");
    EXPECT_EQ(again.exitCode, 2);
    EXPECT_EQ(again.err, "crossray: --resume: the run in out/last has ended; allowed is one that was interrupted\n");
    EXPECT_EQ(run("run --backend cpu64 --resume -o nowhere").exitCode, 2);
}
