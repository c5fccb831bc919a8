#include "harness/run/environment.h"

#include "harness/base/error.h"

#include <gtest/gtest.h>

using namespace crossray;

namespace {

std::vector<BackendInfo> makeBackends()
{
    return {{"lavapipe", "Vulkan", true, true, ""}, {"swiftshader", "Vulkan", true, false, "install chromium-common"},
            {"osmesa", "OpenGL", true, true, ""},   {"softpipe", "OpenGL", true, true, ""},
            {"egl", "OpenGL", false, true, ""},     {"cpu32", "none", true, true, ""},
            {"cpu64", "none", true, true, ""}};
}

using Names = std::vector<std::string>;

} // namespace

TEST(BackendChoice, takesTheDefaultOnesThatAreThere)
{
    const BackendChoice choice = chooseBackends({}, makeBackends());
    EXPECT_EQ(choice.names, (Names{"lavapipe", "osmesa", "softpipe", "cpu32", "cpu64"}));
    EXPECT_EQ(choice.notes, (Names{"without swiftshader: install chromium-common"}));
}

TEST(BackendChoice, allMeansAllThatAreThere)
{
    EXPECT_EQ(chooseBackends(Names{"all"}, makeBackends()).names,
              (Names{"lavapipe", "osmesa", "softpipe", "egl", "cpu32", "cpu64"}));
}

TEST(BackendChoice, keepsOneOrderAndEachOnce)
{
    EXPECT_EQ(chooseBackends(Names{"cpu64", "lavapipe", "cpu64"}, makeBackends()).names, (Names{"lavapipe", "cpu64"}));
    EXPECT_EQ(chooseBackends(Names{"vulkan:Radeon", "cpu64"}, makeBackends()).names, (Names{"cpu64", "vulkan:Radeon"}));
}

TEST(BackendChoice, refusesWhatIsUnknownOrMissing)
{
    EXPECT_THROW(chooseBackends(Names{"metal"}, makeBackends()), InputError);
    EXPECT_THROW(chooseBackends(Names{"vulkan:"}, makeBackends()), InputError);
    EXPECT_THROW(chooseBackends(Names{"swiftshader"}, makeBackends()), EnvironmentError);
    std::vector<BackendInfo> known = makeBackends();
    known[0].found = false; // lavapipe
    EXPECT_THROW(chooseBackends({}, known), EnvironmentError);
}

TEST(BackendChoice, surfacelessEglStandsInForOsmesa)
{
    std::vector<BackendInfo> known = makeBackends();
    known[2].found = false; // osmesa
    EXPECT_EQ(chooseBackends({}, known).names, (Names{"lavapipe", "softpipe", "egl", "cpu32", "cpu64"}));
    known[4].found = false; // egl
    EXPECT_THROW(chooseBackends({}, known), EnvironmentError);
}

TEST(Commit, ofAFolderOutsideARepositoryIsEmpty)
{
    EXPECT_EQ(findCommit("/nonexistent/it's").hash, "");
}
