// The cases of the repository, as data: each can be read, bears its place as its name, and says something checkable.
#include "harness/case/case.h"

#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <set>

using namespace crossray;

namespace {

const std::filesystem::path kRoot = std::filesystem::path(CROSSRAY_SOURCE_DIR) / "cases";

} // namespace

TEST(CommittedCases, canAllBeReadUnderTheirOwnNames)
{
    std::vector<Case> cases;
    for (const std::filesystem::path& file : findCaseFiles(kRoot)) {
        std::vector<Case> own;
        ASSERT_NO_THROW(own = readCaseFile(file)) << file;
        const std::string place = std::filesystem::relative(file, kRoot).replace_extension().generic_string();
        for (const Case& c : own)
            EXPECT_EQ(c.name.substr(0, c.name.find('[')), place);
        cases.insert(cases.end(), own.begin(), own.end());
    }
    std::set<std::string> names;
    for (const Case& c : cases)
        EXPECT_TRUE(names.insert(c.name).second) << c.name << " is taken twice";
    EXPECT_GE(cases.size(), 40u);
}

TEST(CommittedCases, stateTheirClaimAndAreTagged)
{
    for (const std::filesystem::path& file : findCaseFiles(kRoot)) {
        const Case c = readCaseFile(file).at(0);
        EXPECT_TRUE(c.summary.ends_with('.')) << file;
        EXPECT_FALSE(c.tags.empty()) << file;
        EXPECT_EQ(c.mustFail, c.name.starts_with("must_fail/")) << file;
    }
}

// What a kept verdict depends on: whatever a committed case names as a file has to be in the list.
TEST(CommittedCases, everyFileThatACaseNamesIsListed)
{
    const std::regex named("\"([^\"]+\\.(exr|json|glsl|comp))\"");
    size_t found = 0;
    for (const std::filesystem::path& file : findCaseFiles(CROSSRAY_SOURCE_DIR "/cases")) {
        std::ifstream stream(file);
        const std::string text((std::istreambuf_iterator<char>(stream)), {});
        std::set<std::filesystem::path> listed;
        for (const Case& testCase : readCaseFile(file)) {
            for (const std::filesystem::path& one : listFiles(testCase))
                listed.insert(std::filesystem::weakly_canonical(one));
        }
        EXPECT_TRUE(listed.contains(std::filesystem::weakly_canonical(file))) << file;
        for (std::sregex_iterator match(text.begin(), text.end(), named), end; match != end; ++match, ++found) {
            const auto path = std::filesystem::weakly_canonical(file.parent_path() / (*match)[1].str());
            EXPECT_TRUE(listed.contains(path)) << file << " names " << path;
        }
    }
    EXPECT_GT(found, 20u);
}
