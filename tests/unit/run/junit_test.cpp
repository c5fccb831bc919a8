#include "harness/run/junit.h"

#include <gtest/gtest.h>
#include <pugixml.hpp>

#include <algorithm>

using namespace crossray;

namespace {

RunResult makeRun()
{
    RunResult run;
    for (const Verdict verdict : allVerdicts()) {
        CaseResult& testCase = run.cases.emplace_back();
        testCase.name = std::string("case/") + std::string(nameOf(verdict));
        testCase.position = {"cases/a.toml", 3, 1};
        BackendResult& result = testCase.backends.emplace_back();
        result.backend = "osmesa";
        result.verdict = verdict;
        result.reason = "a <b> & \"c\" \x01 100 %\nsecond";
    }
    return run;
}

} // namespace

TEST(Junit, countsAreThoseOfItsTests)
{
    pugi::xml_document document;
    ASSERT_TRUE(document.load_string(formatJunit(makeRun()).c_str()));
    const pugi::xml_node suite = document.child("testsuites").child("testsuite");
    EXPECT_STREQ(suite.attribute("name").value(), "osmesa");
    EXPECT_EQ(suite.attribute("tests").as_int(), 9);
    EXPECT_EQ(suite.attribute("failures").as_int(), 3); // fail, unknown-pass, missing-golden
    EXPECT_EQ(suite.attribute("errors").as_int(), 3);   // error, crash, timeout
    EXPECT_EQ(suite.attribute("skipped").as_int(), 2);  // skip, known-fail
    EXPECT_EQ(suite.select_nodes("testcase[failure]").size(), 3u);
    EXPECT_EQ(suite.select_nodes("testcase[error]").size(), 3u);
}

TEST(GithubAnnotations, areOneLineEachAndEscaped)
{
    const std::string lines = formatGithubAnnotations(makeRun());
    EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 6);
    EXPECT_NE(lines.find("::error file=cases/a.toml,line=3,title=fail case/fail osmesa::"), std::string::npos) << lines;
    EXPECT_NE(lines.find("100 %25%0Asecond"), std::string::npos) << lines;
}
