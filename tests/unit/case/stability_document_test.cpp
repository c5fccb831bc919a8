// docs/stability.md, the atlas, against the cases, sweeps and pictures that it links.
#include "tests/unit/case/documents.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

constexpr int kSituations = 64;

// Targets of links and pictures, as paths from docs/ without the anchor.
std::vector<std::string> linksOf(const std::string& text)
{
    static const std::regex kLink(R"(\]\(([^)#]+)(?:#[^)]*)?\))");
    std::vector<std::string> links;
    for (std::sregex_iterator match(text.begin(), text.end(), kLink), end; match != end; ++match)
        links.push_back((*match)[1]);
    return links;
}

// The rows of the atlas: those whose first cell is a list of situations, or a dash.
std::vector<std::string> situationRowsOf(const std::string& text)
{
    static const std::regex kRow(R"(\| (-|\d+(, \d+)*) \| .*)");
    std::vector<std::string> rows;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) {
        if (std::regex_match(line, kRow)) rows.push_back(line);
    }
    return rows;
}

std::set<int> numbersOf(const std::string& row)
{
    static const std::regex kNumber(R"(\d+)");
    const std::string cell = row.substr(2, row.find(" | ") - 2);
    std::set<int> numbers;
    for (std::sregex_iterator match(cell.begin(), cell.end(), kNumber), end; match != end; ++match)
        numbers.insert(std::stoi(match->str()));
    return numbers;
}

} // namespace

TEST(StabilityDocument, linksWhatIsThere)
{
    const std::vector<std::string> links = linksOf(readAll("docs/stability.md"));
    EXPECT_GT(links.size(), 150U);
    for (const std::string& link : links)
        EXPECT_TRUE(std::filesystem::is_regular_file(kSource / "docs" / link)) << link;
}

TEST(StabilityDocument, namesNoCaseThatIsNotThere)
{
    static const std::regex kNamed("`((?:reflection|stability|refraction|probe|planar|color)/\\w+)`");
    const std::string text = readAll("docs/stability.md");
    int found = 0;
    for (std::sregex_iterator match(text.begin(), text.end(), kNamed), end; match != end; ++match, ++found)
        EXPECT_TRUE(std::filesystem::exists(kSource / "cases" / ((*match)[1].str() + ".toml"))) << (*match)[1];
    EXPECT_GT(found, 0);
}

TEST(StabilityDocument, everyRowHasACaseAndSixCells)
{
    const std::vector<std::string> rows = situationRowsOf(readAll("docs/stability.md"));
    EXPECT_GT(rows.size(), 50U);
    for (const std::string& row : rows) {
        EXPECT_NE(row.find("](../cases/"), std::string::npos) << row;
        EXPECT_EQ(std::count(row.begin(), row.end(), '|'), 7) << row;
    }
}

TEST(StabilityDocument, everySituationHasARow)
{
    std::set<int> reached;
    for (const std::string& row : situationRowsOf(readAll("docs/stability.md")))
        reached.merge(numbersOf(row));
    for (int number = 1; number <= kSituations; ++number)
        EXPECT_TRUE(reached.contains(number)) << number;
    EXPECT_EQ(reached.size(), static_cast<size_t>(kSituations));
}

TEST(StabilityDocument, aRowsCasesBearItsNumbers)
{
    for (const std::string& row : situationRowsOf(readAll("docs/stability.md"))) {
        std::string cases;
        for (const std::string& link : linksOf(row)) {
            if (link.starts_with("../cases/")) cases += readAll("docs/" + link);
        }
        for (const int number : numbersOf(row))
            EXPECT_NE(cases.find("\"stability-" + std::to_string(number) + "\""), std::string::npos)
                << number << ": " << row;
    }
}

TEST(StabilityDocument, everyNumberedCaseIsReached)
{
    std::set<std::string> linked;
    for (const std::string& link : linksOf(readAll("docs/stability.md")))
        linked.insert(std::filesystem::path(link).filename().string());
    static const std::regex kNumbered(R"(\d\d_\w+\.toml)");
    for (const auto& entry : std::filesystem::directory_iterator(kSource / "cases/stability")) {
        const std::string name = entry.path().filename().string();
        if (std::regex_match(name, kNumbered)) {
            EXPECT_TRUE(linked.contains(name)) << name;
        }
    }
}

TEST(StabilityDocument, everyPictureIsShownWithItsCommand)
{
    const std::string text = readAll("docs/stability.md");
    int found = 0;
    for (const auto& entry : std::filesystem::directory_iterator(kSource / "docs/images/stability")) {
        const std::string name = "images/stability/" + entry.path().filename().string();
        EXPECT_NE(text.find("](" + name + ")"), std::string::npos) << name;
        EXPECT_NE(text.find("--image docs/" + name), std::string::npos) << name;
        ++found;
    }
    EXPECT_GT(found, 0);
}
