#include "harness/cli/command_line.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

using namespace crossray;

TEST(CommandLine, everyVerbAndOptionIsDocumented)
{
    std::ifstream stream(CROSSRAY_SOURCE_DIR "/docs/cli.md");
    std::ostringstream content;
    content << stream.rdbuf();
    const std::string document = content.str();
    const std::vector<std::string> options = listOptions();
    EXPECT_GT(options.size(), 30u);
    for (const std::string& option : options) {
        const std::string word = option.substr(option.rfind(' ') + 1);
        const bool isOption = word.starts_with("-");
        const bool found = isOption ? document.find("`" + word) != std::string::npos
                                    : document.find("**" + word) != std::string::npos ||
                                          document.find("## " + word + "\n") != std::string::npos;
        EXPECT_TRUE(found) << option << " is not in docs/cli.md";
    }
}
