// The other verbs from outside.
#include "tests/cli/program.h"

#include <fmt/format.h>

namespace fs = std::filesystem;

namespace {

using VerbTest = CliTest;

} // namespace

TEST_F(VerbTest, listPrintsNamesAndSummaries)
{
    writeCase("cases/a.toml", "hiz/a", "tags = [\"slow\"]");
    writeCase("cases/b.toml", "b");
    const Outcome text = run("list");
    EXPECT_EQ(text.exitCode, 0);
    EXPECT_EQ(text.out, "hiz/a  A plane of the test.\nb      A plane of the test.\n");
    const auto json = nlohmann::json::parse(run("list --json --tag slow").out);
    ASSERT_EQ(json.size(), 1u);
    EXPECT_EQ(json[0]["name"], "hiz/a");
    EXPECT_EQ(json[0]["file"], "cases/a.toml");
}

TEST_F(VerbTest, showSaysWhatWillRunAndWhatIsSkipped)
{
    writeCase("cases/a.toml", "a", "backends = [\"cpu64\"]");
    const Outcome outcome = run("show a");
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("plane at (0, 0, -4)"), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find("HitSuccess: constant"), std::string::npos);
    EXPECT_NE(outcome.out.find("cases/a.toml:9:1"), std::string::npos);
    EXPECT_NE(outcome.out.find("cpu32        skipped: the case does not name this backend"), std::string::npos);
    EXPECT_EQ(run("show missing").exitCode, 4);
    const Outcome wrong = run("show a --image a.jpg");
    EXPECT_EQ(wrong.exitCode, 2);
    EXPECT_EQ(wrong.err, "crossray: --image a.jpg: allowed is FILE.png, or - for the terminal alone\n");
}

TEST_F(VerbTest, showDrawsOneCaseIntoAFileAndIntoTheTerminal)
{
    writeCase("cases/two/a.toml", "two/a");
    writeCase("cases/two/b.toml", "two/b");
    EXPECT_EQ(run("show two --image a.png").exitCode, 2);
    EXPECT_FALSE(std::filesystem::exists(folder_ / "a.png"));
    EXPECT_EQ(run("show two/a --backend cpu64 --image -").exitCode, 2); // no terminal
    const Outcome file = run("show two/a --backend cpu64 --image a.png");
    EXPECT_EQ(file.exitCode, 0) << file.err;
    EXPECT_EQ(readFile("a.png").substr(1, 3), "PNG");
    EXPECT_EQ(file.out.find("\u2580"), std::string::npos);
    const Outcome shown = run("--color always show two/a --backend cpu64 --image -");
    EXPECT_EQ(shown.exitCode, 0) << shown.err;
    EXPECT_NE(shown.out.find("\u2580"), std::string::npos);
}

TEST_F(VerbTest, whatCannotBeIsSaidBeforeAnythingRuns)
{
    writeCase("cases/a.toml", "a", "",
              "output = \"RayDirWS\"\nanalytic = \"reflection_mirorr\"\ntolerance = { degrees = 1 }\n");
    const Outcome unknown = run("list");
    EXPECT_EQ(unknown.exitCode, 2);
    EXPECT_NE(unknown.err.find("cases/a.toml:"), std::string::npos) << unknown.err;
    EXPECT_NE(unknown.err.find("unknown closed form \"reflection_mirorr\"; allowed are"), std::string::npos);

    writeCase("cases/a.toml", "a");
    writeFile("taken", "a file");
    const Outcome taken = run("run a --output taken");
    EXPECT_EQ(taken.exitCode, 2);
    EXPECT_EQ(taken.err, "crossray: --output taken: that is a file; allowed is a folder, or what is not there yet\n");
    EXPECT_EQ(readFile("taken"), "a file");
    const Outcome budget = run("bench a --backend cpu64 --budget 'Nonsense<=1'");
    EXPECT_EQ(budget.exitCode, 2);
    EXPECT_NE(budget.err.find("has no error \"Nonsense\"; allowed are"), std::string::npos) << budget.err;
}

TEST_F(VerbTest, compileSpeaksEachLanguage)
{
    const std::vector<std::pair<std::string, std::string>> targets{{"glsl", "#version 450"},
                                                                   {"essl", "#version 3"},
                                                                   {"hlsl", "numthreads"},
                                                                   {"msl", "#include <metal_stdlib>"},
                                                                   {"spirv", "OpEntryPoint"}};
    for (const auto& [target, text] : targets) {
        const Outcome outcome = run(fmt::format("compile entry/depth_pyramid.comp --target {}", target));
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        EXPECT_NE(outcome.out.find(text), std::string::npos) << target;
    }
    EXPECT_EQ(run("compile depth_pyramid.comp --target spirv -o a.spv").exitCode, 0);
    EXPECT_EQ(readFile("a.spv").substr(0, 4), "\x03\x02\x23\x07");
    EXPECT_EQ(run("compile depth_pyramid.comp --target cobol").exitCode, 2);
    EXPECT_EQ(run("compile depth_pyramid.comp --spec NoSuchConstant=1").exitCode, 2);
    EXPECT_EQ(run("compile depth_pyramid.comp --spec x").exitCode, 2);
    EXPECT_EQ(run("compile nothing.comp").exitCode, 2);
}

TEST_F(VerbTest, compileNamesTheLineOfTheSource)
{
    writeFile("broken.comp", "#version 450\nlayout(local_size_x = 1) in;\nvoid main()\n{\n    float x = nowhere;\n}\n");
    const Outcome outcome = run("compile broken.comp");
    EXPECT_EQ(outcome.exitCode, 2);
    EXPECT_NE(outcome.err.find("broken.comp:5:"), std::string::npos) << outcome.err;
}

TEST_F(VerbTest, diffFindsChangedVerdictsAndPlanes)
{
    writeCase("cases/a.toml", "a");
    writeCase("cases/b.toml", "b");
    run("run --backend cpu64 --planes all -o one");
    run("run --backend cpu64 --planes all -o two");
    const Outcome same = run("diff one two/run.json");
    EXPECT_EQ(same.exitCode, 0) << same.out << same.err;
    writeCase("cases/b.toml", "b", "", kFails);
    writeFile("cases/a.toml", "schema = 1\nname = \"a\"\nsummary = \"Now a mirror.\"\n[scene]\nsize = [8, 8]\n"
                              "primitives = [{ shape = \"plane\", center = [0, 0, -4], normal = [0, 0, 1], material = "
                              "\"mirror\" }]\n[projection]\nmodel = \"proxy_infinite\"\n"
                              "[[expect]]\noutput = \"HitSuccess\"\nconstant = \"hit\"\nwhere = \"all\"\n");
    run("run --backend cpu64 --planes all -o two");
    const Outcome changed = run("diff one two");
    EXPECT_EQ(changed.exitCode, 1);
    EXPECT_NE(changed.out.find("b  cpu64  pass -> fail"), std::string::npos) << changed.out;
    EXPECT_NE(changed.out.find("HitSuccess"), std::string::npos);
    EXPECT_EQ(nlohmann::json::parse(run("diff one two --json").out)["changes"].size(), 2u);
    EXPECT_EQ(run("diff one missing").exitCode, 2);
    EXPECT_EQ(run("diff one two/planes/a/cpu64.exr").exitCode, 2);
}

TEST_F(VerbTest, doctorNamesEachBackendAndTheFolders)
{
    const Outcome outcome = run("doctor");
    for (const char* name :
         {"lavapipe", "osmesa", "softpipe", "swiftshader", "egl", "cpu32", "cpu64", "glslang", "shaders"})
        EXPECT_NE(outcome.out.find(name), std::string::npos) << name;
    EXPECT_EQ(outcome.exitCode, 0) << outcome.out;
}

TEST_F(VerbTest, foldersThatAreNotThereExitTwo)
{
    EXPECT_EQ(run("list --cases nowhere").exitCode, 2);
    EXPECT_EQ(run("list --shaders nowhere").exitCode, 2);
}

TEST_F(VerbTest, helpAndVersionExitZero)
{
    EXPECT_EQ(run("--help").exitCode, 0);
    EXPECT_EQ(run("run --help").exitCode, 0);
    EXPECT_EQ(run("--version").out, "0.1.0\n");
    EXPECT_EQ(run("--help").out.find("worker"), std::string::npos);
}
