// docs/shader-library.md against the cases: a row for every setting of a shader, with cases that set it; a row for
// every claim of the documents, with cases that bear its tag.
#include "harness/case/case.h"
#include "tests/unit/case/documents.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

using namespace crossray;

namespace {

constexpr int kClaimCount = 20;

// What a row of the document names: words in backticks, in the order of its cells.
struct Row {
    std::string subject;
    std::vector<std::string> places;
};

std::vector<std::string> quotedWords(const std::string& text)
{
    std::vector<std::string> words;
    for (size_t from = 0;;) {
        const size_t open = text.find('`', from);
        const size_t close = open == std::string::npos ? open : text.find('`', open + 1);
        if (close == std::string::npos) return words;
        words.push_back(text.substr(open + 1, close - open - 1));
        from = close + 1;
    }
}

// The rows of all tables whose header's first cell is `subject`.
std::vector<Row> readRows(const std::string& subject)
{
    std::ifstream stream(kSource / "docs/shader-library.md");
    EXPECT_TRUE(stream);
    std::vector<Row> rows;
    bool inTable = false;
    for (std::string line; std::getline(stream, line);) {
        if (line.starts_with("| " + subject + " |")) {
            inTable = true;
        } else if (!line.starts_with("|")) {
            inTable = false;
        } else if (inTable && !line.starts_with("|--")) {
            const size_t end = line.find('|', 1);
            const std::string last = line.substr(line.rfind('|', line.size() - 2));
            const std::string first = line.substr(1, end - 1);
            const std::vector<std::string> quoted = quotedWords(first);
            const size_t digit = first.find_first_of("0123456789");
            rows.push_back({quoted.empty() && digit != std::string::npos
                                ? first.substr(digit, first.find(' ', digit) - digit)
                            : quoted.empty() ? ""
                                             : quoted[0],
                            quotedWords(last)});
        }
    }
    return rows;
}

// Every dotted key below `node`; places in a list are left out: "probe.influence.shape".
void collectKeys(const std::string& path, const toml::node& node, std::set<std::string>& keys)
{
    if (!path.empty()) keys.insert(path);
    // [environment] stands in several tables.
    const size_t environment = path.rfind(".environment.");
    if (environment != std::string::npos) keys.insert(path.substr(environment + 1));
    if (const toml::table* table = node.as_table()) {
        for (const auto& [key, value] : *table)
            collectKeys(path.empty() ? std::string(key.str()) : path + "." + std::string(key.str()), value, keys);
    }
    if (const toml::array* array = node.as_array()) {
        for (const toml::node& element : *array) {
            if (element.is_table()) collectKeys(path, element, keys);
        }
    }
}

bool isNumber(const std::string& word)
{
    return !word.empty() && std::all_of(word.begin(), word.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
}

std::string withoutNumbers(const std::string& path)
{
    std::string kept;
    for (size_t from = 0; from <= path.size();) {
        const size_t dot = std::min(path.find('.', from), path.size());
        const std::string word = path.substr(from, dot - from);
        if (!isNumber(word)) kept += (kept.empty() ? "" : ".") + word;
        from = dot + 1;
    }
    return kept;
}

// What a case sets: in its file, by its presets, and in its parameter lists.
std::set<std::string> settingsOf(const std::filesystem::path& file)
{
    static const toml::table presets = toml::parse_file((kSource / "cases/presets.toml").string());
    const toml::table text = toml::parse_file(file.string());
    std::set<std::string> found;
    collectKeys("", text, found);
    if (const toml::array* used = text["use"].as_array()) {
        for (const toml::node& name : *used) {
            const toml::node* preset = presets["preset"][name.value_or("")].node();
            if (preset) collectKeys("", *preset, found);
        }
    }
    if (const toml::table* expand = text["expand"].as_table()) {
        std::set<std::string> paths;
        collectKeys("", *expand, paths);
        for (const std::string& path : paths)
            found.insert(withoutNumbers(path));
    }
    return found;
}

// Tables of the case format whose keys say what the scene and the judge do, not what a shader does.
bool isShaderSetting(const CaseKey& key)
{
    static const std::set<std::string> kTopLevel{"trace", "probe_profile", "dominant_direction", "hierarchy"};
    static const std::vector<std::string> kOthers{"camera", "scene",         "gbuffer", "expect",
                                                  "expand", "known_failure", "rotation"};
    if (key.table.empty()) return kTopLevel.contains(key.key);
    const std::string root = key.table.substr(0, key.table.find('.'));
    return std::find(kOthers.begin(), kOthers.end(), root) == kOthers.end();
}

} // namespace

TEST(LibraryDocument, hasEverySettingWithCasesThatSetIt)
{
    std::set<std::string> rows;
    for (const Row& row : readRows("setting")) {
        rows.insert(row.subject); // a table of several systems has a row in each
        EXPECT_FALSE(row.places.empty()) << row.subject << " has no case";
        for (const std::string& name : row.places) {
            const std::filesystem::path file = kSource / "cases" / (name + ".toml");
            ASSERT_TRUE(std::filesystem::exists(file)) << row.subject << " names no case: " << name;
            EXPECT_TRUE(settingsOf(file).contains(row.subject)) << name << " does not set " << row.subject;
        }
    }
    for (const CaseKey& key : caseSchema()) {
        const std::string path = key.table.empty() ? key.key : key.table + "." + key.key;
        if (!isShaderSetting(key)) continue;
        const bool hasRow = rows.erase(path) > 0;
        const bool holdsOthers = key.type.find("table") != std::string::npos; // a table needs none: its keys have them
        EXPECT_TRUE(hasRow || holdsOthers) << path << " has no row";
    }
    for (const std::string& left : rows)
        ADD_FAILURE() << left << " is no setting of a shader";
}

TEST(LibraryDocument, hasEveryClaimWithCasesThatBearIt)
{
    const std::vector<Row> rows = readRows("claim");
    ASSERT_EQ(rows.size(), static_cast<size_t>(kClaimCount));
    for (int claim = 1; claim <= kClaimCount; ++claim) {
        const Row& row = rows[static_cast<size_t>(claim - 1)];
        EXPECT_EQ(row.subject, std::to_string(claim));
        EXPECT_FALSE(row.places.empty()) << claim;
        for (const std::string& place : row.places) {
            if (std::filesystem::exists(kSource / place)) continue; // a test
            const std::filesystem::path file = kSource / "cases" / (place + ".toml");
            ASSERT_TRUE(std::filesystem::exists(file)) << claim << " names no case and no file: " << place;
            const std::vector<std::string> tags = readCaseFile(file).at(0).tags;
            EXPECT_TRUE(std::find(tags.begin(), tags.end(), fmt::format("claim-{}", claim)) != tags.end()) << place;
        }
    }
}
