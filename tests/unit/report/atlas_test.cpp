// The atlas as a page of a report: what the build took of the repository, and what a report takes of that.
#include "harness/base/error.h"
#include "harness/report/atlas.h"
#include "tests/unit/report/report_fixture.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <iterator>
#include <regex>

using namespace crossray;

namespace {

const std::filesystem::path kSource = CROSSRAY_SOURCE_DIR;

std::string readAll(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    EXPECT_TRUE(stream) << file;
    return {std::istreambuf_iterator<char>(stream), {}};
}

constexpr AtlasFile kFiles[] = {
    {"docs/a.md", "# A\n\n</script> [b](b.svg) [c](../cases/d/c.toml), [e](../cases/e.toml)"},
    {"docs/sweeps.md", "# S"},
    {"docs/b.svg", "<svg/>"}};

nlohmann::json readIndex(const std::string& page)
{
    const std::string open = "id=\"data-index\">";
    const size_t start = page.find(open) + open.size();
    return nlohmann::json::parse(page.substr(start, page.find("</script>", start) - start));
}

} // namespace

TEST(Atlas, isTheDocumentWithEveryPictureThatItLinks)
{
    const auto files = atlasFiles();
    ASSERT_GT(files.size(), 30u);
    EXPECT_EQ(files[0].name, "docs/stability.md");
    EXPECT_EQ(files[1].name, "reports/published/sweeps/README.md");
    std::map<std::string, std::string_view> contents;
    for (const AtlasFile& file : files) {
        EXPECT_TRUE(file.content == readAll(kSource / file.name)) << file.name; // their difference is no help
        EXPECT_TRUE(contents.emplace(file.name, file.content).second) << file.name << " is there twice";
    }
    const std::string text(files[0].content);
    static const std::regex kPicture(R"(\]\(([^)#]+\.(svg|png))\))");
    int found = 0;
    for (std::sregex_iterator match(text.begin(), text.end(), kPicture), end; match != end; ++match, ++found) {
        const auto name = (std::filesystem::path("docs") / (*match)[1].str()).lexically_normal();
        EXPECT_TRUE(contents.contains(name.generic_string())) << name;
    }
    EXPECT_GT(found, 30);
    const std::set<std::string> cases = findAtlasCases(files);
    EXPECT_GT(cases.size(), 100u);
    for (const std::string& name : cases)
        EXPECT_TRUE(std::filesystem::exists(kSource / "cases" / (name + ".toml"))) << name;
}

TEST(Atlas, isInAReportAsTwoPieces)
{
    const ReportFixture fixture;
    ReportOptions options;
    EXPECT_EQ(readIndex(fixture.make(options).at("index.html"))["atlas"], "");
    options.atlas = kFiles;
    const auto files = fixture.make(options);
    const nlohmann::json index = readIndex(files.at("index.html"));
    EXPECT_EQ(index["atlas"], "atlas");
    EXPECT_EQ(index["atlasPictures"], "atlas-pictures");
    EXPECT_EQ(index["atlasCases"], nlohmann::json({"d/c", "e"}));
    const std::string texts = files.at("data/atlas.js");
    EXPECT_EQ(texts.find("</script>"), std::string::npos);
    const nlohmann::json read =
        nlohmann::json::parse(texts.substr(texts.find('['), texts.rfind(");") - texts.find('[')));
    EXPECT_EQ(read[0], nlohmann::json({{"name", "docs/a.md"}, {"text", kFiles[0].content}}));
    EXPECT_EQ(read.size(), 2u);
    EXPECT_NE(files.at("data/atlas-pictures.js").find("\"docs/b.svg\""), std::string::npos);
    EXPECT_NE(files.at("data/atlas-pictures.js").find("image/svg+xml"), std::string::npos);
}

TEST(Atlas, isNamedWhereASingleFileHasNoRoom)
{
    const ReportFixture fixture;
    ReportOptions options;
    options.isSingle = true;
    ReportSummary without;
    fixture.make(options, &without);
    std::string large(200'000, 'x'); // of one letter, so that only a text is large
    const AtlasFile files[] = {{"docs/a.md", large}, {"docs/b.svg", large}};
    options.atlas = files;
    options.maxBytes = without.bytes + 150'000;
    ReportSummary cut;
    const nlohmann::json index = readIndex(fixture.make(options, &cut).at("index.html"));
    EXPECT_EQ(index["atlas"], "");
    EXPECT_EQ(cut.leftOut, std::vector<std::string>{"the atlas of where methods fail"});
    options.maxBytes = kMaxSingleBytes;
    EXPECT_EQ(readIndex(fixture.make(options).at("index.html"))["atlasPictures"], "atlas-pictures");
}

TEST(Atlas, showsTextsAndPicturesAlone)
{
    const AtlasFile files[] = {{"docs/a.toml", ""}};
    EXPECT_THROW(makeAtlasTexts(files), std::logic_error);
}
