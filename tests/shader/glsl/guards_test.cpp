// No operation of the library that some input has no answer to stands without the test of that input, and no loop in
// the shaders relies on a driver to end it. guards.toml names them all; this holds it to the code, in both directions.
#include "tests/shader/glsl/glsl_code.h"

#include "harness/case/node.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <regex>
#include <set>

using namespace crossray;
namespace fs = std::filesystem;

namespace {

const fs::path kSource = CROSSRAY_SOURCE_DIR;
// Mesa 22.3.6 ends every loop there, and says nothing.
constexpr int kMesasLimit = 65535;

template <class Find>
std::vector<GlslPlace> findInFolder(const fs::path& folder, const Find& find)
{
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        const fs::path extension = entry.path().extension();
        if (extension == ".glsl" || extension == ".comp") files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    std::vector<GlslPlace> places;
    for (const fs::path& file : files) {
        const auto found = find(lexGlsl(readSource(file)), fs::relative(file, folder).generic_string());
        places.insert(places.end(), found.begin(), found.end());
    }
    return places;
}

// "Suite.name" of every test of the shader library as C++.
std::set<std::string> listShaderTests()
{
    std::set<std::string> names;
    const std::regex test(R"((?:TEST|TEST_F|RC_GTEST_PROP)\(\s*(\w+),\s*(\w+))");
    for (const auto& entry : fs::directory_iterator(kSource / "tests/shader")) {
        if (entry.path().extension() != ".cpp") continue;
        const std::string text = readSource(entry.path());
        for (std::sregex_iterator it(text.begin(), text.end(), test), end; it != end; ++it)
            names.insert(it->str(1) + "." + it->str(2));
    }
    return names;
}

// What stands in the table and what stands in the code, counted: two alike in one function need two lines.
using Key = std::string; // "file function: code"
Key keyOf(const std::string& file, const std::string& function, const std::string& code)
{
    return file + " " + function + ": " + code;
}

std::map<Key, int> countPlaces(const std::vector<GlslPlace>& places)
{
    std::map<Key, int> counts;
    for (const GlslPlace& place : places)
        ++counts[keyOf(place.file, place.function, place.code)];
    return counts;
}

const std::string& textOf(const Node& entry, std::string_view key)
{
    static const std::string empty;
    const Node* node = entry.find(key);
    return node ? node->text : empty;
}

std::map<Key, int> countEntries(const Node& list)
{
    std::map<Key, int> counts;
    for (const Node& entry : list.items)
        ++counts[keyOf(textOf(entry, "file"), textOf(entry, "function"), textOf(entry, "code"))];
    return counts;
}

void compare(const std::map<Key, int>& code, const std::map<Key, int>& table)
{
    for (const auto& [key, count] : code) {
        const auto found = table.find(key);
        EXPECT_EQ(found == table.end() ? 0 : found->second, count)
            << "without an entry in tests/shader/guards.toml: " << key;
    }
    for (const auto& [key, count] : table)
        EXPECT_TRUE(code.contains(key)) << "tests/shader/guards.toml names what is not in the code: " << key;
}

Node readGuards()
{
    return readTomlFile(kSource / "tests/shader/guards.toml");
}

} // namespace

TEST(Guards, TheLexerSeesOperationsAndNothingElse)
{
    const auto codeOf = [](const char* text) {
        std::string codes;
        for (const GlslPlace& place : findHazards(lexGlsl(text), "f"))
            codes += place.function + ": " + place.code + "\n";
        return codes;
    };
    EXPECT_EQ(codeOf("// a / b\n/* c / d\n */\n#define HALF(x) (x / y)\nfloat f(float x) { return x / 2.0 + x / -4 + x "
                     "/ 1e-3; }"),
              "");
    EXPECT_EQ(codeOf("float f(vec2 x) { return x.y / g(x).z[1] + 1.0 / 0.0; }"), "f: / g(x).z[1]\nf: / 0.0\n");
    EXPECT_EQ(codeOf("void f() { if (a) { b /= (c - 1.0) * d; } }\nint g() { return i % n; }"),
              "f: /= (c - 1.0)\ng: % n\n");
    EXPECT_EQ(codeOf("vec3 f(vec3 v) { float sqrt_ = 1.0; return normalize(v) * sqrt(max(v.x, -1.0)); }"),
              "f: normalize(v)\nf: sqrt(max(v.x, -1.0))\n");
    EXPECT_EQ(codeOf("float f() { return pow(log(x), y / z); }"), "f: pow(log(x), y / z)\nf: log(x)\nf: / z\n");
    const auto loops =
        findLoops(lexGlsl("void f() { for (int i = 0; i < n; ++i) while (g(i)) { } do { } while (h); }"), "f");
    ASSERT_EQ(loops.size(), 4u);
    EXPECT_EQ(loops[0].code, "int i = 0; i < n; ++i");
    EXPECT_EQ(loops[1].code, "g(i)");
}

TEST(Guards, EachOperationHasItsTest)
{
    const Node guards = readGuards();
    const std::vector<GlslPlace> hazards = findInFolder(kSource / "shaders/crossray", findHazards);
    ASSERT_GT(hazards.size(), 50u);
    compare(countPlaces(hazards), countEntries(*guards.find("operation")));
    const std::set<std::string> tests = listShaderTests();
    for (const Node& entry : guards.find("operation")->items) {
        const std::string& test = textOf(entry, "test");
        EXPECT_NE(test.empty(), textOf(entry, "why").empty())
            << entry.place.position().format() << ": \"test\" or \"why\"";
        if (!test.empty()) {
            EXPECT_TRUE(tests.contains(test))
                << entry.place.position().format() << ": there is no test \"" << test << '"';
        }
        EXPECT_FALSE(textOf(entry, "input").empty())
            << entry.place.position().format() << ": \"input\" says what is degenerate";
    }
}

TEST(Guards, EachLoopHasABoundOfItsOwn)
{
    const Node guards = readGuards();
    const std::vector<GlslPlace> loops = findInFolder(kSource / "shaders", findLoops);
    ASSERT_GT(loops.size(), 20u);
    compare(countPlaces(loops), countEntries(*guards.find("loop")));
    std::string all;
    for (const auto& entry : fs::recursive_directory_iterator(kSource / "shaders")) {
        if (entry.path().extension() == ".glsl") all += readSource(entry.path());
    }
    for (const Node& entry : guards.find("loop")->items) {
        const std::string where = entry.place.position().format();
        const Node* most = entry.find("most");
        ASSERT_TRUE(most != nullptr && most->kind == NodeKind::kInteger) << where << ": \"most\" is missing";
        EXPECT_GT(most->integer, 0) << where;
        EXPECT_LT(most->integer, kMesasLimit) << where;
        EXPECT_FALSE(textOf(entry, "why").empty()) << where << ": \"why\" says what bounds it";
        // A bound that is a constant or a number of the code is that number.
        std::smatch bound;
        const std::string& code = textOf(entry, "code");
        if (!std::regex_search(code, bound, std::regex(R"(; \w+ < (k\w+|\d+);)"))) continue;
        std::smatch constant;
        const std::string name = bound[1];
        const bool isNamed = std::regex_search(all, constant, std::regex("const int " + name + " = (\\d+);"));
        ASSERT_TRUE(isNamed || std::isdigit(static_cast<unsigned char>(name[0])) != 0) << where << ": " << name;
        EXPECT_EQ(most->integer, std::stoi(isNamed ? constant[1].str() : name)) << where;
    }
}
