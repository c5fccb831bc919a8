// `crossray bake` from outside.
#include "tests/cli/program.h"

#include <fmt/format.h>

namespace fs = std::filesystem;

namespace {

class BakeTest : public CliTest {
  protected:
    // A room of one colour with a baked probe; `more` are further lines of [probe.environment].
    void writeRoom(const std::string& more, const std::string& end = "") const
    {
        writeFile("cases/room.toml",
                  "schema = 1\nname = \"room\"\nsummary = \"A room.\"\n[scene]\nsize = [8, 8]\n"
                  "primitives = [{ shape = \"box\", half_extents = [3, 3, 3], color = [0.5, 0.25, 1] },\n"
                  "{ shape = \"plane\", center = [0, 0, -2], half_extents = [1, 1], material = \"mirror\" }]\n"
                  "[[probe]]\ninfluence = { shape = \"box\", half_extents = [3, 3, 3] }\n[probe.environment]\n"
                  "capture = \"baked\"\n" +
                      more + "[[expect]]\noutput = \"HitSuccess\"\nconstant = \"no_raycast\"\nwhere = \"all\"\n" + end);
    }
};

} // namespace

TEST_F(BakeTest, writesTheCubemapThatTheCaseReads)
{
    writeRoom("size = 4\n");
    const Outcome outcome = run("bake room");
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "cases/room.probe1.exr: six faces of 4x4, 3 levels\n");
    EXPECT_EQ(readFile("cases/room.probe1.exr").substr(0, 4), "\x76\x2f\x31\x01");
    for (const auto& entry : fs::directory_iterator(folder_ / "cases")) // nothing is left beside it
        EXPECT_TRUE(entry.path().filename() == "room.toml" || entry.path().filename() == "room.probe1.exr");
    const Outcome again = run("bake cases/room.toml -o other/room.exr");
    EXPECT_EQ(again.exitCode, 0) << again.err;
    EXPECT_EQ(readFile("other/room.exr"), readFile("cases/room.probe1.exr"));
    EXPECT_EQ(run("diff other/room.exr cases/room.probe1.exr").exitCode, 0);
}

TEST_F(BakeTest, subCasesShareAFileWhileTheySeeTheSame)
{
    writeRoom("size = 4\n", "[expand]\nmaterial.roughness = [0.0, 0.5]\n");
    EXPECT_EQ(run("bake room").exitCode, 0);
    writeRoom("size = 4\n", "[expand]\nprobe.0.environment.bounces = [0, 1]\n");
    const Outcome different = run("bake room");
    EXPECT_EQ(different.exitCode, 2);
    EXPECT_NE(different.err.find("cases/room.toml:11:11: room[bounces=1], probe 1, shows something else"),
              std::string::npos)
        << different.err;
    writeRoom("size = 4\nfile = \"x.exr\"\n",
              "[expand]\nprobe.0.environment.file = [\"baked/a.exr\", \"baked/b.exr\"]\n");
    EXPECT_EQ(run("bake room").exitCode, 0);
    EXPECT_EQ(readFile("cases/baked/a.exr"), readFile("cases/baked/b.exr"));
}

TEST_F(BakeTest, nothingToBakeExitsFour)
{
    writeCase("cases/a.toml", "a");
    const Outcome outcome = run("bake a");
    EXPECT_EQ(outcome.exitCode, 4);
    EXPECT_NE(outcome.err.find("a has nothing to bake"), std::string::npos) << outcome.err;
    EXPECT_EQ(run("bake missing").exitCode, 4);
    EXPECT_EQ(run("bake").exitCode, 2);
}
