// docs/case-format.md and the schema are one: every row of its tables is the schema's, and no key is missing.
#include "harness/case/case.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <string>
#include <vector>

using namespace crossray;

namespace {

std::string trimmed(const std::string& text)
{
    const size_t from = text.find_first_not_of(' ');
    return from == std::string::npos ? "" : text.substr(from, text.find_last_not_of(' ') - from + 1);
}

std::vector<std::string> cellsOf(const std::string& line)
{
    std::vector<std::string> cells;
    size_t from = 1;
    for (size_t bar; (bar = line.find('|', from)) != std::string::npos; from = bar + 1) {
        cells.push_back(trimmed(line.substr(from, bar - from)));
    }
    return cells;
}

// Rows below headings such as "### [scene.sky]"; "### Top level" is the table "".
std::vector<CaseKey> readDocument(const std::string& file)
{
    std::ifstream stream(file);
    EXPECT_TRUE(stream) << file;
    std::vector<CaseKey> keys;
    std::string table = "?";
    for (std::string line; std::getline(stream, line);) {
        if (line.starts_with("#")) {
            const size_t open = line.rfind('['), close = line.find(']');
            table = line == "### Top level"     ? ""
                    : open != std::string::npos ? line.substr(open + 1, close - open - 1)
                                                : "?";
        }
        if (table == "?" || !line.starts_with("| `")) continue;
        const std::vector<std::string> cells = cellsOf(line);
        EXPECT_EQ(cells.size(), 5u) << line;
        if (cells.size() != 5) continue;
        keys.push_back({table, cells[0].substr(1, cells[0].size() - 2), cells[1], cells[2], cells[3], cells[4]});
    }
    return keys;
}

std::string rowOf(const CaseKey& key)
{
    return fmt::format("[{}] | `{}` | {} | {} | {} | {} |", key.table, key.key, key.type, key.allowed, key.defaultText,
                       key.summary);
}

} // namespace

TEST(FormatDocument, isTheSchema)
{
    const std::vector<CaseKey> document = readDocument(std::string(CROSSRAY_SOURCE_DIR) + "/docs/case-format.md");
    const std::vector<CaseKey> schema = caseSchema();
    std::map<std::string, std::string> documented;
    for (const CaseKey& key : document) {
        EXPECT_TRUE(documented.emplace(key.table + " " + key.key, rowOf(key)).second) << "twice: " << rowOf(key);
    }
    for (const CaseKey& key : schema) {
        const auto found = documented.find(key.table + " " + key.key);
        if (found == documented.end()) {
            ADD_FAILURE() << "missing in the document: " << rowOf(key);
            continue;
        }
        EXPECT_EQ(found->second, rowOf(key));
        documented.erase(found);
    }
    for (const auto& [name, row] : documented)
        ADD_FAILURE() << "not in the schema: " << row;
    EXPECT_EQ(document.size(), schema.size());
}

TEST(CaseSchema, saysSomethingAboutEveryKey)
{
    for (const CaseKey& key : caseSchema()) {
        EXPECT_FALSE(key.type.empty()) << key.key;
        EXPECT_FALSE(key.defaultText.empty()) << key.key;
        EXPECT_TRUE(key.summary.ends_with('.')) << key.key;
        EXPECT_EQ(key.summary.find('|'), std::string::npos) << key.key;
    }
}
