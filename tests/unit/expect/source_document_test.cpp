// docs/case-format.md lists the closed forms and the truth quantities: row by row what the code has.
#include "harness/expect/expect.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <fstream>

using namespace crossray;

namespace {

std::vector<std::string> readRows(const std::string& heading)
{
    std::ifstream stream(std::string(CROSSRAY_SOURCE_DIR) + "/docs/case-format.md");
    EXPECT_TRUE(stream);
    std::vector<std::string> rows;
    bool isInside = false;
    for (std::string line; std::getline(stream, line);) {
        if (line.starts_with("#")) isInside = line == heading;
        if (isInside && line.starts_with("| `")) rows.push_back(line);
    }
    return rows;
}

std::vector<std::string> makeRows(std::span<const ClosedForm> forms)
{
    std::vector<std::string> rows;
    for (const ClosedForm& form : forms) {
        rows.push_back(fmt::format("| `{}` | {} | {} |", form.name, fmt::join(form.outputs, ", "), form.summary));
    }
    return rows;
}

} // namespace

TEST(SourceDocument, listsTheClosedForms)
{
    EXPECT_EQ(readRows("## Closed forms"), makeRows(closedForms()));
}

TEST(SourceDocument, listsTheTruthQuantities)
{
    EXPECT_EQ(readRows("## Truth quantities"), makeRows(truthQuantities()));
}
