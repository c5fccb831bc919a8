#include "harness/report/report.h"
#include "harness/base/error.h"
#include "harness/base/temporary_folder.h"
#include "harness/report/page.h"
#include "harness/report/plane_data.h"
#include "harness/scene/exr.h"
#include "tests/unit/count_of.h"
#include "tests/unit/report/report_fixture.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <random>

using namespace crossray;

namespace {

constexpr const char* kTrace =
    R"({"schema": "crossray-trace/1", "case": "hiz/far_depth", "pixel": [1, 1], "backends": [{"backend": "osmesa"}]})";

// The JSON between a data element's tags.
nlohmann::json readPiece(const std::string& page, const std::string& name)
{
    const std::string open = fmt::format("<script type=\"application/json\" id=\"data-{}\">", name);
    const size_t start = page.find(open);
    if (start == std::string::npos) return {};
    const size_t end = page.find("</script>", start);
    return nlohmann::json::parse(page.substr(start + open.size(), end - start - open.size()));
}

nlohmann::json readScript(const std::string& script)
{
    const size_t comma = script.find(", ");
    return nlohmann::json::parse(script.substr(comma + 2, script.rfind(");") - comma - 2));
}

} // namespace

// What was measured of conditioning lies beside the planes of its case, and goes with them.
TEST(Report, takesTheConditioningThatTheRunKeptOfACase)
{
    ReportFixture fixture;
    const std::string file = "planes/hiz/far_depth/conditioning.exr";
    fixture.planes[file] = {Plane("HitDepth@condition", 4, 2, 1, 0.0)};
    ReportOptions options;
    options.hasFile = [&](const std::string& asked) { return asked == file; };
    const auto files = fixture.make(options);
    const auto index = readPiece(files.at("index.html"), "index");
    const auto piece =
        readScript(files.at("data/" + index["cases"][0]["planes"]["conditioning"].get<std::string>() + ".js"));
    EXPECT_EQ(piece["planes"][0]["name"], "HitDepth@condition");
    EXPECT_FALSE(index["cases"][1].contains("planes"));
    EXPECT_FALSE(
        readPiece(ReportFixture().make({}).at("index.html"), "index")["cases"][0]["planes"].contains("conditioning"));
}

TEST(Report, folderHoldsThePageAndItsDataPieceByPiece)
{
    const auto files = ReportFixture().make({});
    const auto index = readPiece(files.at("index.html"), "index");
    EXPECT_EQ(index["schema"], kReportSchema);
    EXPECT_EQ(index["run"]["counts"]["failed"], 2);
    EXPECT_EQ(index["cases"].size(), 3u);
    const auto& failed = index["cases"][0];
    EXPECT_EQ(failed["results"][1]["output"], "HitDepth");
    EXPECT_EQ(failed["results"][1]["kind"], "beyond tolerance");
    EXPECT_EQ(failed["results"][1]["pixel"], nlohmann::json({1, 1}));
    EXPECT_FALSE(failed["results"][0].contains("reason"));

    const auto details = readScript(files.at("data/" + failed["details"].get<std::string>() + ".js"));
    EXPECT_EQ(details[0]["backends"][1]["expectations"][0]["tolerance"], "0.001 relative");
    const auto planes = readScript(files.at("data/" + failed["planes"]["osmesa"].get<std::string>() + ".js"));
    EXPECT_EQ(planes["width"], 4);
    EXPECT_EQ(planes["planes"][0]["name"], "HitDepth");
    EXPECT_EQ(files.size(), 1u + 3u + 3u); // details of two failures and of what passed; planes of three sources
}

TEST(Report, sameInputsGiveTheSameBytes)
{
    const ReportFixture fixture;
    ReportOptions options;
    options.traces = {{"a.json", kTrace}};
    EXPECT_EQ(fixture.make(options), fixture.make(options));
    options.isSingle = true;
    EXPECT_EQ(fixture.make(options), fixture.make(options));
}

TEST(Report, namesThatCloseAScriptCloseNone)
{
    ReportFixture fixture;
    const std::string hostile = "</script><img src=x onerror=alert(1)><!--";
    fixture.run.cases[0].name = hostile;
    fixture.run.cases[0].summary = hostile;
    fixture.run.cases[0].backends[1].backend = hostile;
    fixture.run.cases[0].backends[1].reason = "\xff\xfe" + hostile; // no UTF-8 either
    fixture.run.started = hostile;
    ReportOptions options;
    const auto plain = ReportFixture().make(options), files = fixture.make(options);
    const std::string& page = files.at("index.html");
    EXPECT_EQ(countOf(page, "</script"), countOf(plain.at("index.html"), "</script"));
    EXPECT_EQ(page.find("<img"), std::string::npos);
    EXPECT_EQ(readPiece(page, "index")["cases"][0]["name"], hostile);
    for (const auto& [name, content] : files) {
        if (name == "index.html") continue;
        EXPECT_EQ(content.find('<'), std::string::npos) << name;
    }
    options.isSingle = true;
    EXPECT_EQ(countOf(fixture.make(options).at("index.html"), "</script"),
              countOf(ReportFixture().make(options).at("index.html"), "</script"));
}

TEST(Report, singleFileHoldsAllAndAsksForNothing)
{
    ReportOptions options;
    options.isSingle = true;
    ReportSummary summary;
    const auto files = ReportFixture().make(options, &summary);
    ASSERT_EQ(files.size(), 1u);
    const std::string& page = files.begin()->second;
    EXPECT_EQ(summary.bytes, page.size());
    EXPECT_TRUE(summary.leftOut.empty());
    const auto index = readPiece(page, "index");
    for (const auto& [source, piece] : index["cases"][0]["planes"].items())
        EXPECT_TRUE(readPiece(page, piece).is_object()) << source;
    EXPECT_TRUE(readPiece(page, index["cases"][1]["details"]).is_array());
    for (const char* part : {"http:", "https:", "<link rel=\"stylesheet\"", "fetch(", "XMLHttpRequest", "src=\"data/"})
        EXPECT_EQ(page.find(part), std::string::npos) << part;
}

// Expected planes and failures come first; the rest is named.
TEST(Report, singleFileStaysWithinItsBoundAndSaysWhatIsLeftOut)
{
    ReportFixture fixture;
    std::mt19937 random(1);
    std::uniform_real_distribution<double> noise(0.0, 1.0);
    for (auto& [file, planes] : fixture.planes) {
        for (Plane& plane : planes) {
            plane = Plane(plane.name, 160, 120, plane.channels);
            for (double& value : plane.values)
                value = noise(random);
        }
    }
    ReportOptions options;
    options.isSingle = true;
    ReportSummary whole, cut;
    fixture.make(options, &whole);
    EXPECT_TRUE(whole.leftOut.empty());
    options.maxBytes = whole.bytes - 100'000;
    const std::string page = fixture.make(options, &cut).at("index.html");
    EXPECT_LE(page.size(), options.maxBytes);
    ASSERT_EQ(cut.leftOut.size(), 1u);
    EXPECT_EQ(cut.leftOut[0], "planes of hiz/far_depth: cpu64");
    const auto index = readPiece(page, "index");
    EXPECT_EQ(index["leftOut"][0], cut.leftOut[0]);
    EXPECT_TRUE(index["cases"][0]["planes"].contains("osmesa"));
    EXPECT_FALSE(index["cases"][0]["planes"].contains("cpu64"));
    options.maxBytes = 1000;
    EXPECT_THROW(fixture.make(options), InputError);
}

TEST(Report, singleFileKeepsTheListWhenTheDetailsOfPassesDoNotFit)
{
    ReportFixture fixture;
    for (int i = 0; i < 3000; ++i)
        fixture.addPass(fmt::format("many/case_{}", i));
    ReportOptions options;
    options.isSingle = true;
    ReportSummary whole, cut;
    fixture.make(options, &whole);
    options.maxBytes = whole.bytes * 6 / 10;
    const std::string page = fixture.make(options, &cut).at("index.html");
    EXPECT_LE(page.size(), options.maxBytes);
    ASSERT_FALSE(cut.leftOut.empty());
    EXPECT_EQ(cut.leftOut[0], "expectations of 3001 cases that passed");
    const auto index = readPiece(page, "index");
    EXPECT_EQ(index["cases"][1]["details"], "");
    EXPECT_NE(index["cases"][0]["details"], "");
}

TEST(Report, tracesAreOfTheirSchemaOrRefused)
{
    const ReportFixture fixture;
    ReportOptions options;
    options.traces = {{"a.json", kTrace}};
    const auto files = fixture.make(options);
    const auto index = readPiece(files.at("index.html"), "index");
    EXPECT_EQ(index["traces"][0]["case"], "hiz/far_depth");
    EXPECT_EQ(index["traces"][0]["y"], 1);
    EXPECT_TRUE(files.contains("data/trace-0.js"));
    for (const char* text : {"", "{", "[]", R"({"schema": "crossray-trace/2"})", R"({"schema": "crossray-trace/1"})"}) {
        options.traces = {{"bad.json", text}};
        try {
            fixture.make(options);
            ADD_FAILURE() << text;
        } catch (const InputError& error) {
            EXPECT_TRUE(std::string(error.what()).starts_with("bad.json: is no crossray-trace/1")) << error.what();
        }
    }
}

TEST(Report, aSingleFileLeavesOutTheRunsLongTracesAndNotThoseAPersonGave)
{
    const ReportFixture fixture;
    ReportOptions options;
    options.isSingle = true;
    options.maxBytes = 1'000'000;
    const std::string rest = std::string(kTrace).substr(1);
    options.traces = {{"given", R"({"x": ")" + std::string(300'000, 'a') + "\"," + rest},
                      {"long", R"({"x": ")" + std::string(300'000, 'b') + "\"," + rest, true}};
    ReportSummary summary;
    const std::string page = fixture.make(options, &summary).at("index.html");
    EXPECT_EQ(readPiece(page, "index")["traces"].size(), 1u);
    EXPECT_NE(page.find("aaaa"), std::string::npos);
    EXPECT_EQ(page.find("bbbb"), std::string::npos);
    ASSERT_FALSE(summary.leftOut.empty());
    EXPECT_EQ(summary.leftOut[0], "trace of hiz/far_depth: pixel 1, 1");

    options.traces = {{"short", kTrace, true}};
    EXPECT_EQ(readPiece(fixture.make(options).at("index.html"), "index")["traces"].size(), 1u);
}

TEST(Report, benchesAreOfTheirSchemaOrRefused)
{
    const ReportFixture fixture;
    ReportOptions options;
    options.benches = {{"bench.json", R"({"schema": "crossray-bench/1", "scenes": ["</script>"]})"}};
    const auto files = fixture.make(options);
    EXPECT_EQ(readPiece(files.at("index.html"), "index")["benches"][0]["piece"], "bench-0");
    EXPECT_EQ(readScript(files.at("data/bench-0.js"))["scenes"][0], "</script>");
    for (const char* text : {"", "[]", "{}", R"({"schema": "crossray-bench/2"})", R"({"schema": 1})"}) {
        options.benches = {{"bad.json", text}};
        EXPECT_THROW(fixture.make(options), InputError) << text;
    }
}

TEST(Report, equalAnswersAreStoredOnce)
{
    const ReportFixture fixture;
    const auto files = fixture.make({});
    const auto index = readPiece(files.at("index.html"), "index");
    const auto& names = index["cases"][0]["planes"];
    const auto first = readScript(files.at("data/" + names["osmesa"].get<std::string>() + ".js"));
    const auto other = readScript(files.at("data/" + names["cpu64"].get<std::string>() + ".js"));
    EXPECT_TRUE(first["planes"][1].contains("data"));
    EXPECT_EQ(other["planes"][1]["same"], "osmesa");
    EXPECT_TRUE(other["planes"][0].contains("data"));
}

TEST(Report, emptyRunHasAPage)
{
    const RunResult run;
    std::string page;
    makeReport(
        run, {}, [](const std::string&) { return std::vector<Plane>{}; },
        [&](const std::string&, std::string_view content) { page = content; });
    EXPECT_EQ(readPiece(page, "index")["cases"].size(), 0u);
}

TEST(Report, writesBesideTheRunAndReplacesAnEarlierReport)
{
    ReportFixture fixture;
    const TemporaryFolder folder("crossray_report_test");
    for (const auto& [file, planes] : fixture.planes) {
        std::filesystem::create_directories((folder.path() / file).parent_path());
        writeExr(folder.path() / file, planes);
    }
    const auto target = folder.path() / "report";
    std::filesystem::create_directories(target / "data");
    std::ofstream(target / "data/planes-99-0.js") << "old";
    const ReportSummary summary = writeReport(fixture.run, folder.path(), target, {});
    EXPECT_FALSE(std::filesystem::exists(target / "data/planes-99-0.js"));
    EXPECT_TRUE(std::filesystem::exists(target / "index.html"));
    EXPECT_EQ(summary.files, 9u); // the atlas is two of them

    fixture.run.cases[0].backends[1].traceFile = "planes/hiz/far_depth/osmesa.trace.json";
    EXPECT_THROW(writeReport(fixture.run, folder.path(), target, {}), InputError) << "run.json names what is not there";
    std::ofstream(folder.path() / "planes/hiz/far_depth/osmesa.trace.json") << kTrace;
    EXPECT_EQ(writeReport(fixture.run, folder.path(), target, {}).files, 10u);
    EXPECT_TRUE(std::filesystem::exists(target / "data/trace-0.js"));

    std::ofstream(target / "data/mine.txt") << "mine";
    EXPECT_THROW(writeReport(fixture.run, folder.path(), target, {}), InputError);
    EXPECT_TRUE(std::filesystem::exists(target / "data/mine.txt"));
}

TEST(Page, base64)
{
    EXPECT_EQ(encodeBase64(""), "");
    EXPECT_EQ(encodeBase64("f"), "Zg==");
    EXPECT_EQ(encodeBase64("fo"), "Zm8=");
    EXPECT_EQ(encodeBase64("foo"), "Zm9v");
    EXPECT_EQ(encodeBase64("\xff\xfe\xfd\xfc"), "//79/A==");
}
