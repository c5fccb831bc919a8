#include "harness/base/temporary_folder.h"

#include <gtest/gtest.h>

#include <fstream>

namespace crossray {
namespace {

TEST(TemporaryFolder, eachIsItsOwnAndLeavesNothing)
{
    std::filesystem::path path;
    {
        const TemporaryFolder first("test"), second("test");
        path = first.path();
        EXPECT_NE(first.path(), second.path());
        std::filesystem::create_directories(path / "deep/er");
        std::ofstream(path / "deep/er/file") << "content";
        EXPECT_TRUE(std::filesystem::exists(path / "deep/er/file"));
    }
    EXPECT_FALSE(std::filesystem::exists(path));
}

} // namespace
} // namespace crossray
