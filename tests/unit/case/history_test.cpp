// [history], [material.thickness_map] and the poison of [scene]: what they say, and what is refused.
#include "harness/case/case.h"

#include "harness/base/temporary_folder.h"

#include <gtest/gtest.h>

#include <fstream>

using namespace crossray;

namespace {

constexpr const char* kHistoryHead = "schema = 1\nname = \"a\"\nsummary = \"S.\"\n";
constexpr const char* kTail = "[scene]\nprimitives = [{ shape = \"sphere\", radius = 1 }]\n"
                              "[[expect]]\noutput = \"HitSuccess\"\nconstant = \"hit\"\n";

Case readText(const std::string& tables)
{
    const TemporaryFolder folder("crossray-history");
    const std::filesystem::path file = folder.path() / "a.toml";
    std::ofstream(file) << kHistoryHead << tables << kTail;
    return readCaseFile(file).at(0);
}

std::string refusalOf(const std::string& tables)
{
    try {
        readText(tables);
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

} // namespace

TEST(CaseHistory, isThisFramesCameraWhereNothingIsSaid)
{
    EXPECT_FALSE(readText("").history);
    const Case still = readText("[camera]\neye = [1, 2, 3]\nfov = 50\n[history]\n");
    ASSERT_TRUE(still.history);
    EXPECT_EQ(still.history->camera.worldFromView, still.camera.worldFromView);
    EXPECT_EQ(still.history->camera.fovYDegrees, 50.0);
    EXPECT_EQ(still.history->reprojection, Reprojection::kMotionVectors);
    EXPECT_EQ(still.history->poison, HistoryPoison::kNone);
    // One key moves the camera and leaves the others as they are.
    const Case moved = readText("[camera]\neye = [1, 2, 3]\n[history]\neye = [1, 2, 4]\nlevels = 3\n"
                                "moved = [{ primitive = 0, by = [0, 1, 0] }]\n");
    EXPECT_EQ(glm::dvec3(moved.history->camera.worldFromView[3]), glm::dvec3(1, 2, 4));
    EXPECT_EQ(moved.history->camera.width, moved.camera.width);
    EXPECT_EQ(moved.history->levels, 3);
    ASSERT_EQ(moved.history->moved.size(), 1u);
    EXPECT_EQ(moved.history->moved[0].by, glm::dvec3(0, 1, 0));
}

TEST(CaseHistory, refusesWhatGivesNoFrame)
{
    EXPECT_NE(refusalOf("[history]\neye = [0, 0, -1]\n").find("give no view"), std::string::npos);
    EXPECT_NE(refusalOf("[history]\nup = [0, 0, 1]\n").find("give no view"), std::string::npos);
    EXPECT_NE(refusalOf("[history]\nmoved = [{ primitive = 1, by = [0, 0, 0] }]\n").find("below 1"), std::string::npos);
    EXPECT_NE(refusalOf("[history]\npoison = \"zero\"\n").find("none, nan, infinity, negative"), std::string::npos);
}

TEST(CasePoison, isOfTheSceneAndOffWhereNothingIsSaid)
{
    EXPECT_EQ(readText("").poison, GBufferPoison{});
    const std::string file = std::string(kHistoryHead) +
                             "[scene]\npoison = \"huge\"\npoison_channel = \"normal\"\n"
                             "poison_every = 3\nprimitives = [{ shape = \"sphere\", radius = 1 }]\n"
                             "[[expect]]\noutput = \"HitSuccess\"\nconstant = \"hit\"\n";
    const TemporaryFolder folder("crossray-poison");
    std::ofstream(folder.path() / "a.toml") << file;
    const GBufferPoison expected{TexelPoison::kHuge, PoisonedChannel::kNormal, 3};
    EXPECT_EQ(readCaseFile(folder.path() / "a.toml").at(0).poison, expected);
}

TEST(CaseThicknessMap, isAGradientOrAFile)
{
    const std::string glass = "[material]\nrefraction_model = \"box\"\n[material.thickness_map]\n";
    const Case gradient = readText(glass + "from = 1\nto = 2\naxis = \"y\"\n");
    ASSERT_TRUE(gradient.material.thicknessMap);
    EXPECT_EQ(gradient.material.thicknessMap->to, 2.0);
    EXPECT_EQ(gradient.material.thicknessMap->axis, 1);
    EXPECT_NE(refusalOf(glass + "axis = \"y\"\n").find("one of them is allowed"), std::string::npos);
    EXPECT_NE(refusalOf(glass + "from = 1\n").find("one of them is allowed"), std::string::npos);
    EXPECT_NE(refusalOf(glass + "from = 1\nto = 1\nfile = \"t.exr\"\n").find("one of them is allowed"),
              std::string::npos);
    EXPECT_NE(refusalOf(glass + "file = \"t.exr\"\n").find("no such file"), std::string::npos);
}
