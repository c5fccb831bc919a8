// Broken variants of the committed cases: each is read or refused with a position, and nothing else happens.
#include "tests/unit/case/case_files.h"

#include <array>
#include <random>
#include <sstream>

using namespace crossray;

using Mutation = CaseFiles;

namespace {

std::string textOf(const std::filesystem::path& file)
{
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

constexpr std::array<std::string_view, 16> kSplinters{
    "nan", "[]",           "{}",          "= ",   "\n[expand]\n", "-1",   "1e999",      "9223372036854775807",
    "\"",  "[[expect]]\n", "use = [1]\n", "true", "'''",          "\xff", "2031-02-03", "expect = 1\n"};

std::string mutate(std::string text, std::mt19937& random)
{
    const auto pick = [&](size_t count) { return std::uniform_int_distribution<size_t>(0, count - 1)(random); };
    for (size_t changes = 1 + pick(3); changes > 0 && !text.empty(); --changes) {
        const size_t at = pick(text.size());
        switch (pick(4)) {
        case 0:
            text.erase(at, 1 + pick(20));
            break;
        case 1:
            text.insert(at, kSplinters[pick(kSplinters.size())]);
            break;
        case 2:
            text[at] = static_cast<char>(32 + pick(95));
            break;
        default:
            text.insert(at, text.substr(pick(text.size()), pick(60)));
            break;
        }
    }
    return text;
}

} // namespace

TEST_F(Mutation, isReadOrRefusedWithAPosition)
{
    std::filesystem::copy_file(std::string(CROSSRAY_SOURCE_DIR) + "/cases/presets.toml", folder_ / "presets.toml");
    const std::vector<std::filesystem::path> files = findCaseFiles(std::string(CROSSRAY_SOURCE_DIR) + "/cases");
    std::mt19937 random(20240607);
    size_t refused = 0, accepted = 0;
    for (int round = 0; round < 3000; ++round) {
        const std::string text = mutate(textOf(files[static_cast<size_t>(round) % files.size()]), random);
        try {
            read(text);
            ++accepted;
        } catch (const InputError& error) {
            ++refused;
            EXPECT_FALSE(error.position().file.empty()) << error.what() << "\n" << text;
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
        }
    }
    EXPECT_GT(refused, 1000u);
    EXPECT_GT(accepted, 100u);
}
