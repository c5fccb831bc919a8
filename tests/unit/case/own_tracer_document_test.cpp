// docs/own-tracer.md against what it describes: the example, and the interface.
#include "tests/unit/case/documents.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <regex>
#include <string>

namespace {

} // namespace

TEST(OwnTracerDocument, showsTheExampleAsItIs)
{
    const std::string example = readAll("cases/own/pixel_walk.glsl");
    EXPECT_NE(readAll("docs/own-tracer.md").find("```glsl\n" + example + "```\n"), std::string::npos);
    EXPECT_LT(std::count(example.begin(), example.end(), '\n'), 40);
}

TEST(OwnTracerDocument, namesEveryFunctionOfTheInterface)
{
    const std::string document = readAll("docs/own-tracer.md");
    const std::string source = readAll("shaders/pass/own_interface.glsl");
    const std::regex definition(R"(\n(?:\w+) (own\w+)\()");
    int found = 0;
    for (std::sregex_iterator match(source.begin(), source.end(), definition), end; match != end; ++match) {
        const std::string name = (*match)[1];
        if (name == "ownRecordRead") continue; // for the pixel's record; it asks nothing
        ++found;
        EXPECT_NE(document.find("`" + name + "("), std::string::npos) << name;
    }
    EXPECT_EQ(found, 14);
    // And each that it names is there.
    const std::regex named("`(own\\w+)\\(");
    for (std::sregex_iterator match(document.begin(), document.end(), named), end; match != end; ++match)
        EXPECT_NE(source.find(" " + (*match)[1].str() + "("), std::string::npos) << (*match)[1];
}
