// The logic of the pages in node, where there is one; tests/web/browser has the pages in a browser.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <string>

namespace {

// A stub that only says how to install the program counts as none.
bool isInstalled(const std::string& program)
{
    return std::system((program + " --version >/dev/null 2>&1").c_str()) == 0;
}

} // namespace

TEST(WebLogic, holdsInNode)
{
    if (!isInstalled("node")) GTEST_SKIP() << "node is not installed";
    const std::string command = "node --test " CROSSRAY_SOURCE_DIR "/tests/web/*.test.mjs 2>&1";
    FILE* const pipe = popen(command.c_str(), "r");
    ASSERT_NE(pipe, nullptr);
    std::string output(1 << 16, '\0');
    output.resize(fread(output.data(), 1, output.size(), pipe));
    EXPECT_EQ(pclose(pipe), 0) << output;
}
