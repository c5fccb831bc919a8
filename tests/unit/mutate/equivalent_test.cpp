#include "harness/mutate/equivalent.h"

#include "harness/base/temporary_folder.h"

#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>

namespace crossray {
namespace {

namespace fs = std::filesystem;

fs::path write(const TemporaryFolder& folder, const std::string& text)
{
    const fs::path file = folder.path() / "equivalent.toml";
    std::ofstream(file) << text;
    return file;
}

std::string errorOf(const std::string& text)
{
    const TemporaryFolder folder("crossray-mutate");
    try {
        readEquivalents(write(folder, text));
    } catch (const InputError& error) {
        const std::string what = error.what();
        return what.substr(what.find("equivalent.toml"));
    }
    return {};
}

constexpr const char* kText = "float f(float a)\n{\n    return a < 0.0 ? 0.0 : a;\n}\n";

TEST(Equivalents, areFoundByFileFunctionAndLines)
{
    const TemporaryFolder folder("crossray-mutate");
    const auto list =
        readEquivalents(write(folder, "[[equivalent]]\nfile = \"x.glsl\"\nfunction = \"f\"\nreason = \"-0 is 0\"\n"
                                      "edits = [[\"return a < 0.0 ? 0.0 : a;\", \"return a <= 0.0 ? 0.0 : a;\"]]\n"));
    ASSERT_EQ(list.size(), 1u);
    const auto mutations = findMutations("x.glsl", kText);
    EXPECT_NO_THROW(checkEquivalents(list, mutations));
    EXPECT_EQ(
        std::count_if(mutations.begin(), mutations.end(), [&](const Mutation& one) { return list[0].matches(one); }),
        1);
    // The line has moved: the entry stays. It has changed: the entry is to go.
    EXPECT_NO_THROW(checkEquivalents(list, findMutations("x.glsl", std::string("\n\n") + kText)));
    EXPECT_THROW(
        checkEquivalents(list, findMutations("x.glsl", "float f(float a) { return a; }\nfloat g() { return 1.0; }")),
        InputError);
    EXPECT_NO_THROW(checkEquivalents(list, findMutations("other.glsl", kText)));
}

TEST(Equivalents, refuseWhatTheyDoNotKnow)
{
    const std::string head = "[[equivalent]]\nfile = \"x\"\nfunction = \"f\"\n";
    EXPECT_EQ(errorOf("[[other]]\n"), "equivalent.toml:1:3: unknown key \"other\"; allowed: [[equivalent]]");
    EXPECT_EQ(errorOf(head + "edits = [[\"a\", \"b\"]]\n"),
              "equivalent.toml:1:1: [[equivalent]] lacks \"reason\"; required are file, function, reason, edits");
    EXPECT_EQ(errorOf(head + "reason = \"r\"\nedits = [[\"a\"]]\n"),
              "equivalent.toml:5:10: an edit is [\"line before\", \"line after\"]");
    EXPECT_EQ(errorOf(head + "reason = \"\"\nedits = [[\"a\", \"b\"]]\n"), "equivalent.toml:1:1: the reason is empty");
    EXPECT_EQ(errorOf(head + "reason = 1\n"), "equivalent.toml:4:10: \"reason\" is an integer; a string is allowed");
    EXPECT_EQ(errorOf(head + "reason = \"r\"\nwhy = \"w\"\nedits = [[\"a\", \"b\"]]\n"),
              "equivalent.toml:5:1: unknown key \"why\" in [[equivalent]]; allowed: file, function, reason, edits");
}

// The committed list fits the library as it is.
TEST(Equivalents, ofTheLibraryAllStillMatch)
{
    const fs::path root = fs::path(CROSSRAY_SOURCE_DIR) / "shaders";
    const auto list = readEquivalents(fs::path(CROSSRAY_SOURCE_DIR) / "tests/mutation/equivalent.toml");
    std::set<std::string> files;
    for (const EquivalentMutant& entry : list)
        files.insert(entry.file);
    for (const std::string& file : files) {
        std::ifstream stream(root / file);
        ASSERT_TRUE(stream) << file;
        std::stringstream text;
        text << stream.rdbuf();
        EXPECT_NO_THROW(checkEquivalents(list, findMutations(file, text.str()))) << file;
    }
}

} // namespace
} // namespace crossray
