// `crossray report`, and the pages at the end of `crossray run`, from outside.
#include "tests/cli/program.h"

#include <algorithm>

namespace fs = std::filesystem;

namespace {

// Fails on cpu64 alone.
constexpr const char* kFailsOnOne =
    "output = \"HitSuccess\"\nconstant = \"hit\"\nbackends = [\"cpu64\"]\n"
    "[[expect]]\noutput = \"HitSuccess\"\nconstant = \"no_raycast\"\nwhere = \"all\"\nbackends = [\"cpu32\"]\n";

class ReportTest : public CliTest {
  protected:
    bool exists(const std::string& file) const { return fs::exists(folder_ / file); }
};

} // namespace

TEST_F(ReportTest, runEndsWithPagesUnlessToldOtherwise)
{
    writeCase("cases/a.toml", "dir/a", "", kFails);
    const Outcome outcome = run("run --backend cpu64");
    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_NE(outcome.out.find("out/last/report/index.html"), std::string::npos) << outcome.out;
    EXPECT_NE(readFile("out/last/report/index.html").find("dir/a"), std::string::npos);
    EXPECT_TRUE(exists("out/last/report/data/cases-0.js"));

    const Outcome without = run("run --backend cpu64 --no-report");
    EXPECT_EQ(without.out.find("report"), std::string::npos) << without.out;
    EXPECT_FALSE(exists("out/last/report/index.html")) << "the page of the run before";
}

TEST_F(ReportTest, aFailureKeepsThePlanesOfAllBackendsAndWhichPixelsCount)
{
    writeCase("cases/a.toml", "a", "", kFailsOnOne);
    writeCase("cases/b.toml", "b");
    EXPECT_EQ(run("run --backend cpu64,cpu32").exitCode, 1);
    for (const char* file : {"a/cpu64.exr", "a/cpu32.exr", "a/expected.exr"})
        EXPECT_TRUE(exists(std::string("out/last/planes/") + file)) << file;
    EXPECT_FALSE(exists("out/last/planes/b"));
    const std::string expected = readFile("out/last/planes/a/expected.exr");
    EXPECT_NE(expected.find("HitSuccess@0"), std::string::npos);
    EXPECT_NE(expected.find("mask@0"), std::string::npos); // `where` is "traced" there, and the plane is no mirror
    EXPECT_EQ(expected.find("mask@0,1"), std::string::npos);
}

TEST_F(ReportTest, writesAFolderOrAFileAgain)
{
    writeCase("cases/a.toml", "a", "", kFails);
    run("run --backend cpu64");
    const std::string page = readFile("out/last/report/index.html");
    const Outcome again = run("report");
    EXPECT_EQ(again.exitCode, 0) << again.err;
    EXPECT_EQ(again.lastLine().substr(0, 27), "out/last/report/index.html:") << again.out;
    EXPECT_EQ(readFile("out/last/report/index.html"), page);
    EXPECT_EQ(run("report out/last/run.json -o elsewhere").exitCode, 0);
    EXPECT_EQ(readFile("elsewhere/index.html"), page);

    EXPECT_EQ(run("report out/last --single").exitCode, 0);
    EXPECT_EQ(run("report --single -o sent/a.html").exitCode, 0);
    EXPECT_EQ(readFile("sent/a.html"), readFile("out/last/report.html"));
    EXPECT_GT(readFile("sent/a.html").size(), page.size());
}

TEST_F(ReportTest, showsTheTraceThatItIsGiven)
{
    writeCase("cases/a.toml", "a", "", kFails);
    run("run --backend cpu64");
    writeFile("trace.json", run("trace a --pixel 1,2 --backend cpu64 --json").out);
    const Outcome outcome = run("report --trace trace.json out/last");
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_NE(readFile("out/last/report/data/trace-0.js").find("\"trace-0\""), std::string::npos);
    EXPECT_TRUE(exists("out/last/report/data/trace-1.js")); // the run's own
}

TEST_F(ReportTest, aRunKeepsTheTraceOfAFailuresWorstPixelAndThePageHasIt)
{
    writeCase("cases/a.toml", "dir/a", "", kFails);
    writeCase("cases/b.toml", "b");
    const Outcome outcome = run("run --backend cpu64,cpu32");
    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_EQ(outcome.out.find("not traced"), std::string::npos) << outcome.out;
    EXPECT_FALSE(exists("out/last/planes/b"));
    const nlohmann::json json = readRun();
    for (const auto& result : json["cases"][1]["backends"]) {
        const std::string backend = result["backend"], file = "planes/dir/a/" + backend + ".trace.json";
        EXPECT_EQ(result["trace"], file);
        const auto trace = nlohmann::json::parse(readFile("out/last/" + file));
        EXPECT_EQ(trace["backends"].size(), backend == "cpu64" ? 1u : 2u);
        EXPECT_EQ(trace["backends"][0]["backend"], backend);
        const auto& worst = result["expectations"][0]["comparison"]["worst"];
        EXPECT_EQ(trace["pixel"], nlohmann::json({worst["x"], worst["y"]}));
    }
    EXPECT_TRUE(exists("out/last/report/data/trace-1.js"));

    EXPECT_EQ(run("run --backend cpu64,cpu32 --planes none").exitCode, 1);
    EXPECT_FALSE(exists("out/last/planes"));
    EXPECT_FALSE(exists("out/last/report/data/trace-0.js"));
    EXPECT_EQ(readRun()["cases"][1]["backends"][0]["trace"], "");
}

TEST_F(ReportTest, aRunSaysHowManyFailuresItHasNotTraced)
{
    for (int i = 0; i < 42; ++i) {
        const std::string name = "a" + std::to_string(i);
        writeCase("cases/" + name + ".toml", name, "", kFails);
    }
    const Outcome outcome = run("run --backend cpu64");
    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_NE(outcome.out.find("not traced: 2 failures: a run keeps 40 traces at most\n"), std::string::npos);
    EXPECT_EQ(outcome.lastLine(), "0 passed, 42 failed, 0 skipped");
    EXPECT_TRUE(exists("out/last/report/data/trace-39.js"));
    EXPECT_FALSE(exists("out/last/report/data/trace-40.js"));
}

TEST_F(ReportTest, saysInOneLineWhatIsWrong)
{
    writeCase("cases/a.toml", "a", "", kFails);
    run("run --backend cpu64");
    writeFile("old.json", "{\"schema\": \"crossray-run/0\"}");
    writeFile("bad.json", "{}");
    writeFile("mine/data/photo.jpg", "mine");
    for (const char* arguments : {"report nothing", "report old.json", "report --trace bad.json",
                                  "report --trace none.json", "report -o mine", "report a b"}) {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exitCode, 2) << arguments << outcome.err;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << arguments << ": " << outcome.err;
    }
    EXPECT_NE(run("report old.json").err.find("crossray-run/1"), std::string::npos);
    EXPECT_EQ(readFile("mine/data/photo.jpg"), "mine");
}
