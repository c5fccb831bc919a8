#include "harness/base/temporary_folder.h"
#include "harness/cli/command_line.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>

using namespace crossray;

namespace {

// What a shell command prints.
std::string printed(const std::string& command)
{
    const auto close = [](FILE* stream) { pclose(stream); };
    const std::unique_ptr<FILE, decltype(close)> pipe(popen(command.c_str(), "r"), close);
    std::string text;
    char buffer[4096];
    while (const size_t count = fread(buffer, 1, sizeof(buffer), pipe.get()))
        text.append(buffer, count);
    return text;
}

bool isInstalled(const std::string& program)
{
    return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

class ManualTest : public testing::Test {
  protected:
    std::string write(const std::string& name, const std::string& text) const
    {
        std::ofstream(folder_.path() / name) << text;
        return (folder_.path() / name).string();
    }

    // What bash offers after the words, the last of which is being typed.
    std::vector<std::string> complete(const std::string& words) const
    {
        const std::string script = write("completion", formatCompletion(describeCommandLine(), Shell::kBash));
        // The program itself is stood in for: its cases are known then.
        const std::string offered =
            printed("bash -c 'crossray() { printf \"hiz/plane  A claim.\\nproxy/box  A claim.\\n\"; }; cd " +
                    folder_.path().string() + "; . " + script + "; COMP_WORDS=(" + words +
                    "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _crossray; printf \"%s\\n\" \"${COMPREPLY[@]}\"' 2>&1");
        std::vector<std::string> lines;
        for (size_t begin = 0; begin < offered.size();) {
            const size_t end = std::min(offered.find('\n', begin), offered.size());
            if (end > begin) lines.push_back(offered.substr(begin, end - begin));
            begin = end + 1;
        }
        return lines;
    }

    TemporaryFolder folder_{"manual-test"};
};

using Words = std::vector<std::string>;

} // namespace

TEST_F(ManualTest, thePageHasEachVerbAndOption)
{
    const std::string page = formatManual(describeCommandLine(), "1.2.3", "");
    for (const std::string& option : listOptions()) {
        std::string word = option.substr(option.rfind(' ') + 1);
        for (size_t at = word.find('-'); at != std::string::npos; at = word.find('-', at + 2))
            word.insert(at, "\\");
        EXPECT_NE(page.find(word), std::string::npos) << option;
    }
    EXPECT_EQ(page.find("request\\-fd"), std::string::npos); // of the hidden verb
    EXPECT_NE(page.find("\"crossray 1.2.3\""), std::string::npos);
}

TEST_F(ManualTest, roffHasNothingToSayAgainstThePage)
{
    if (!isInstalled("groff")) GTEST_SKIP() << "groff is not installed";
    const std::string file = write("crossray.1", formatManual(describeCommandLine(), "1.2.3", ""));
    EXPECT_EQ(printed("groff -man -ww -z -Tutf8 " + file + " 2>&1"), "");
    EXPECT_NE(printed("groff -man -Tascii -P-c -P-b -P-u " + file).find("crossray bench tracers"), std::string::npos);
}

TEST_F(ManualTest, textOfThePageIsNoCommand)
{
    CommandDescription program{"p", "p: .what 'it' does \\ here", {}, {}};
    program.verbs.push_back({"v", ".TH 'x", {{{"--o"}, "N", "'.so /etc/passwd", false, false}}, {}});
    const std::string page = formatManual(program, "\"1\"", "");
    EXPECT_NE(page.find("\\- \\&.what 'it' does \\e here\n"), std::string::npos) << page;
    EXPECT_NE(page.find("\n\\&.TH 'x.\n"), std::string::npos) << page;
    EXPECT_NE(page.find("\n\\&'.so /etc/passwd.\n"), std::string::npos) << page;
}

TEST_F(ManualTest, bashOffersVerbsOptionsWordsAndCases)
{
    EXPECT_EQ(complete("crossray sw"), Words{"sweep"});
    EXPECT_EQ(complete("crossray run --vali"), Words{"--validate"});
    EXPECT_EQ(complete("crossray --color a"), (Words{"always", "auto"}));
    EXPECT_EQ(complete("crossray run --planes no"), Words{"none"});
    EXPECT_EQ(complete("crossray run --backend sw"), Words{"swiftshader"});
    EXPECT_EQ(complete("crossray run hi"), Words{"hiz/plane"});
    EXPECT_EQ(complete("crossray bench tra"), Words{"tracers"});
    EXPECT_EQ(complete("crossray bench tracers --see"), Words{"--seeds"});
    EXPECT_EQ(complete("crossray completion z"), Words{"zsh"});
    EXPECT_EQ(complete("crossray worke"), Words{});
    write("picture.png", "");
    EXPECT_EQ(complete("crossray show proxy/box --image pic"), Words{"picture.png"});
}

TEST_F(ManualTest, bashTakesItsScript)
{
    EXPECT_EQ(printed("bash -n " + write("c", formatCompletion(describeCommandLine(), Shell::kBash)) + " 2>&1"), "");
}

TEST_F(ManualTest, zshTakesItsScript)
{
    if (!isInstalled("zsh")) GTEST_SKIP() << "zsh is not installed";
    EXPECT_EQ(printed("zsh -n " + write("c", formatCompletion(describeCommandLine(), Shell::kZsh)) + " 2>&1"), "");
}

TEST_F(ManualTest, fishOffersVerbsAndWords)
{
    if (!isInstalled("fish")) GTEST_SKIP() << "fish is not installed";
    const std::string script = write("c.fish", formatCompletion(describeCommandLine(), Shell::kFish));
    const auto offers = [&](const std::string& line) {
        return printed("HOME=" + folder_.path().string() + " fish -N -c 'function crossray; end; source " + script +
                       "; complete -C \"" + line + "\"' 2>&1");
    };
    EXPECT_EQ(offers("crossray swe"), "sweep\tRun a parameter of a case through the edge where its method fails\n");
    EXPECT_EQ(offers("crossray run --planes no").substr(0, 5), "none\t");
    EXPECT_EQ(offers("crossray bench tracers --see").substr(0, 8), "--seeds\t");
}

TEST_F(ManualTest, choicesAreWordsAlone)
{
    EXPECT_EQ((OptionDescription{{}, "auto|on|off", "", false, false}.choices()), (Words{"auto", "on", "off"}));
    EXPECT_TRUE((OptionDescription{{}, "CASE|DIR|GLOB", "", false, false}.choices().empty()));
    EXPECT_TRUE((OptionDescription{{}, "N", "", false, false}.choices().empty()));
}
