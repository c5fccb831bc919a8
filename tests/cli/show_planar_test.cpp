// The two questions about a planar probe that shows nothing, answered by `crossray show`.
#include "tests/cli/program.h"

#include <fmt/format.h>

namespace {

class ShowPlanarTest : public CliTest {
  protected:
    // A mirror floor seen from 2 m above, with a planar probe on it.
    std::string show(const std::string& influence, const std::string& mirror) const
    {
        writeFile(
            "cases/floor.toml",
            fmt::format("schema = 1\nname = \"floor\"\nsummary = \"A floor.\"\n[camera]\neye = [0, 2, 3]\n"
                        "target = [0, 0, 0]\n[scene]\nsize = [16, 8]\nprimitives = [{{ shape = \"plane\", normal = "
                        "[0, 1, 0], material = \"mirror\" }}]\n[[probe]]\nkind = \"planar\"\n"
                        "influence = {{ shape = \"box\", {} }}\nmirror = {{ {} }}\n"
                        "[[expect]]\noutput = \"HitSuccess\"\nconstant = \"no_raycast\"\nwhere = \"all\"\n",
                        influence, mirror));
        const Outcome outcome = run("show floor");
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        return outcome.out;
    }
};

bool says(const std::string& text, const std::string& sentence)
{
    return text.find(sentence) != std::string::npos;
}

} // namespace

TEST_F(ShowPlanarTest, aProbeThatFitsIsSaidToFit)
{
    const std::string text = show("half_extents = [100, 1, 100]", "normal = [0, 1, 0]");
    EXPECT_TRUE(says(text, "1: planar, influence box at (0, 0, 0), half extents (100, 1, 100)\n")) << text;
    EXPECT_TRUE(says(text, "mirror at (0, 0, 0), normal (0, 1, 0), capture 16x8\n")) << text;
    EXPECT_TRUE(says(text, "The influence volume overlaps the receiver: ")) << text;
    EXPECT_TRUE(says(text, "The mirror plane's normal is parallel to the surface's: 0 degrees apart at most.\n"))
        << text;
    EXPECT_TRUE(says(text, "The camera is 2 m in front of the mirror plane.\n")) << text;
}

TEST_F(ShowPlanarTest, anInfluenceThatMissesTheReceiverIsNamed)
{
    const std::string text = show("half_extents = [100, 1, 100], center = [0, 1.5, 0]", "normal = [0, 1, 0]");
    EXPECT_TRUE(says(text, "The influence volume does not overlap the receiver: none of its ")) << text;
    EXPECT_TRUE(says(text, "the nearest is 0.5 m away. The probe shows nothing.\n")) << text;
}

TEST_F(ShowPlanarTest, aPlaneThatIsNotParallelIsNamedWithItsAngle)
{
    const std::string text = show("half_extents = [100, 1, 100]", "rotation = [-60, 0, 0]");
    EXPECT_TRUE(says(text, "The mirror plane's normal is not parallel to the surface's: 30 to 30 degrees apart. The "
                           "probe does not show what the surface reflects.\n"))
        << text;
}
