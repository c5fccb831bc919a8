// Which values a parameter takes, where a sweep finds its edges and what it says of them; devices are functions here.
#include "harness/base/error.h"
#include "harness/sweep/sweep.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <set>

using namespace crossray;

namespace {

std::string refusalOf(const auto& action)
{
    try {
        action();
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

SweepPlan planOf(const std::string& range, bool isInteger = false)
{
    SweepPlan plan;
    plan.caseName = "refraction/a";
    plan.parameter = "material.ior";
    plan.range = SweepRange::parse(range);
    plan.keys.isInteger = isInteger;
    return plan;
}

// Ten rays at 0, 10, ..., 90 degrees, of which those at `angle` and more are totally reflected.
SweepRow rowOf(double value, double angle)
{
    SweepRow row;
    row.value = value;
    row.pixels = {10, 1, {}, {}};
    double reflected = 0;
    for (int i = 0; i < 10; ++i) {
        reflected += 10 * i >= angle;
        row.pixels.kinds.push_back(10 * i >= angle ? 8 : 100);
        row.pixels.incidence.push_back(static_cast<float>(10 * i));
    }
    for (const char* backend : {"cpu32", "cpu64"}) {
        SweepCell cell;
        cell.backend = backend;
        cell.errors = {{"RayDirWS", "analytic refraction_box", "degrees", 0, 1e-6, 1e-6, 10, 0, true, {}}};
        if (reflected > 0) cell.classes["no raycast: total internal reflection"] = reflected / 10;
        if (reflected < 10) cell.classes["hit"] = 1 - reflected / 10;
        row.cells.push_back(cell);
    }
    return row;
}

const std::vector<std::string> kBackends{"cpu32", "cpu64"};

} // namespace

TEST(SweepRange, takesBothEndsAndEqualSteps)
{
    EXPECT_EQ(SweepRange::parse("0.5..2.5:5").values(false), (std::vector<double>{0.5, 1, 1.5, 2, 2.5}));
    EXPECT_EQ(SweepRange::parse("1..0:3").values(false), (std::vector<double>{1, 0.5, 0}));
    EXPECT_EQ(SweepRange::parse("0..1").values(false).size(), 25u);
    const std::vector<double> decades = SweepRange::parse("1e1..1e4:4:log").values(false);
    for (size_t i = 0; i < 4; ++i)
        EXPECT_NEAR(decades[i], std::pow(10, 1 + static_cast<double>(i)), 1e-9);
}

TEST(SweepRange, roundsIntegersAndTakesEachOnce)
{
    EXPECT_EQ(SweepRange::parse("0..3:20").values(true), (std::vector<double>{0, 1, 2, 3}));
    EXPECT_EQ(SweepRange::parse("1..8:8:log").values(true), (std::vector<double>{1, 2, 3, 4, 6, 8}));
}

TEST(SweepRange, saysWhatIsAllowed)
{
    for (const char* text :
         {"1", "1..", "..2", "1..1", "0..1:1", "0..1:2000", "0..1:x", "0..1:5:log", "a..b", "0..inf"}) {
        const std::string refusal = refusalOf([&] { SweepRange::parse(text); });
        EXPECT_NE(refusal.find("FROM..TO[:STEPS][:log]"), std::string::npos) << text << ": " << refusal;
    }
}

TEST(SweepKeys, areNumbersOfTheCaseFormat)
{
    EXPECT_FALSE(SweepKeys::parse("material.ior").isInteger);
    EXPECT_TRUE(SweepKeys::parse("projection.max_iterations").isInteger);
    EXPECT_TRUE(SweepKeys::parse("scene.size.0").isInteger);
    EXPECT_FALSE(SweepKeys::parse("scene.primitives.3.rotation.1").isInteger);
    EXPECT_FALSE(SweepKeys::parse("scene.primitives.3.rotation.degrees").isInteger);
    EXPECT_EQ(SweepKeys::parse("camera.eye.1,camera.target.1").paths.size(), 2u);
}

TEST(SweepKeys, unknownOnesNameTheAllowed)
{
    for (const char* text : {"material.iro", "refraction.ior", "scene.size", "material.ior.0", "projection.model",
                             "timeout", "expect.0.tolerance.degrees", "", "camera.eye.1,nothing"}) {
        const std::string refusal = refusalOf([&] { SweepKeys::parse(text); });
        EXPECT_NE(refusal.find("material.ior, "), std::string::npos) << text << ": " << refusal;
        EXPECT_NE(refusal.find("scene.primitives.N.center.N"), std::string::npos) << text;
        EXPECT_EQ(refusal.find('\n'), std::string::npos) << text;
    }
    EXPECT_NE(refusalOf([] { SweepKeys::parse("material.iro"); }).find("did you mean \"material.ior\""),
              std::string::npos);
}

TEST(SweepCase, followsTheParameterThroughAllChecks)
{
    SweepPlan plan = planOf("0.5..2.5");
    plan.file = CROSSRAY_SOURCE_DIR "/cases/refraction/critical_angle_box.toml";
    plan.caseName = "refraction/critical_angle_box";
    plan.keys = SweepKeys::parse("material.ior");
    const Case testCase = makeCaseAt(plan, 1.25);
    EXPECT_EQ(testCase.material.ior, 1.25);
    for (const char* name : {"HitSuccess", "HitReason", "IterationCount", "RayDirWS"}) {
        EXPECT_EQ(std::count_if(testCase.outputs.begin(), testCase.outputs.end(),
                                [&](const OutputInfo& output) { return output.name == name; }),
                  1)
            << name;
    }
    EXPECT_NE(refusalOf([&] { makeCaseAt(plan, 0); }).find("above 0, at most 10"), std::string::npos);
    plan.overrides["material.thickness"] = "3";
    EXPECT_EQ(makeCaseAt(plan, 1.25).material.thickness, 3);
}

TEST(SweepCase, keepsTheSubCase)
{
    SweepPlan plan = planOf("0.5..2.5");
    plan.file = CROSSRAY_SOURCE_DIR "/cases/refraction/total_internal_reflection.toml";
    plan.caseName = "refraction/total_internal_reflection[refraction_model=thin]";
    plan.keys = SweepKeys::parse("material.ior");
    EXPECT_EQ(makeCaseAt(plan, 0.5).material.refractionModel, RefractionModel::kThin);
    plan.caseName = "refraction/total_internal_reflection";
    EXPECT_NE(refusalOf([&] { makeCaseAt(plan, 0.5); }).find("3 cases"), std::string::npos);
}

TEST(SweepEdge, isBisectedToItsWidthAndTold)
{
    const SweepResult result =
        runSweep(planOf("0.5..2.5:11"), kBackends,
                 [](double v, const std::vector<std::string>&) { return rowOf(v, v < 0.866 ? 60 : 100); });
    ASSERT_EQ(result.edges.size(), 1u);
    const SweepEdge& edge = result.edges[0];
    EXPECT_EQ(edge.kind, EdgeKind::kClasses);
    EXPECT_LE(edge.low, 0.866);
    EXPECT_GE(edge.high, 0.866);
    EXPECT_LE(edge.high - edge.low, 2e-3);
    EXPECT_FALSE(edge.isGradual);
    EXPECT_NE(edge.sentence.find("40 % of the rays turn from \"no raycast: total internal reflection\" into \"hit\", "
                                 "seen at 60 to 90 degrees"),
              std::string::npos)
        << edge.sentence;
    EXPECT_EQ(result.rows.size(), 13u); // and the rows on either side
    EXPECT_TRUE(std::is_sorted(result.rows.begin(), result.rows.end(),
                               [](const SweepRow& a, const SweepRow& b) { return a.value < b.value; }));
}

TEST(SweepEdge, ofAChangeThatGoesOnHasABeginningAndAnEnd)
{
    const auto measure = [](double v, const std::vector<std::string>&) {
        return rowOf(v, 100 - 100 * std::clamp((v - 3) / 4, 0.0, 1.0));
    };
    const SweepResult result = runSweep(planOf("0..20:21"), kBackends, measure);
    ASSERT_EQ(result.edges.size(), 2u);
    EXPECT_NEAR(result.edges[0].low, 3.4, 0.03); // the first of ten rays goes at 90 degrees
    EXPECT_NEAR(result.edges[1].high, 7, 0.03);
}

TEST(SweepEdge, ofAChangeUpToTheEndOfTheSweepIsItsOtherEndAlone)
{
    const auto measure = [](double v, const std::vector<std::string>&) {
        return rowOf(v, 100 - 100 * std::clamp((v - 3) / 4, 0.0, 1.0));
    };
    const SweepResult begins = runSweep(planOf("0..5.5:12"), kBackends, measure);
    ASSERT_EQ(begins.edges.size(), 1u);
    EXPECT_NEAR(begins.edges[0].low, 3.4, 0.03);
    const SweepResult ends = runSweep(planOf("5..20:16"), kBackends, measure);
    ASSERT_EQ(ends.edges.size(), 1u);
    EXPECT_NEAR(ends.edges[0].high, 7, 0.03);
}

TEST(SweepEdge, ofIntegersLiesBetweenNeighbours)
{
    const SweepResult result =
        runSweep(planOf("1..1000:10:log", true), kBackends,
                 [](double v, const std::vector<std::string>&) { return rowOf(v, v < 137 ? 60 : 100); });
    ASSERT_EQ(result.edges.size(), 1u);
    EXPECT_EQ(result.edges[0].low, 136);
    EXPECT_EQ(result.edges[0].high, 137);
}

TEST(SweepEdge, countsDownToo)
{
    const SweepResult result = runSweep(planOf("1..0:5"), kBackends, [](double v, const std::vector<std::string>&) {
        return rowOf(v, v < 0.3 ? 60 : 100);
    });
    ASSERT_EQ(result.edges.size(), 1u);
    EXPECT_GE(result.edges[0].low, 0.3);
    EXPECT_LT(result.edges[0].high, 0.3);
    EXPECT_EQ(result.rows.front().value, 1);
}

TEST(SweepEdge, ofEachKind)
{
    const auto measure = [](double v, const std::vector<std::string>&) {
        SweepRow row = rowOf(v, 60);
        if (v > 9) {
            row.refused = "a.toml:3: too much";
            row.cells.clear();
            return row;
        }
        if (v > 1) row.cells[0].notFinite = 3, row.cells[0].notFiniteOutputs = "HitDepth";
        if (v > 3) row.cells[0].differs = 0.25;
        if (v > 5) row.cells[0].errors[0].passed = false, row.cells[0].errors[0].failed = 0.5;
        if (v > 7) row.cells[0].failure = "crash: signal 11";
        return row;
    };
    const SweepResult result = runSweep(planOf("0..10:21"), kBackends, measure);
    std::string found;
    for (const SweepEdge& edge : result.edges)
        found += std::string(nameOf(edge.kind)) + "=" + std::to_string(static_cast<int>(std::lround(edge.low))) + " ";
    EXPECT_EQ(found, "finiteness=1 disagreement=3 tolerance=5 failure=7 refused=9 ");
    EXPECT_NE(result.edges[4].sentence.find("too much"), std::string::npos);
    EXPECT_NE(result.edges[0].sentence.find("on cpu32: 3 values of HitDepth are NaN or infinite"), std::string::npos);
    EXPECT_NE(result.edges[3].sentence.find("crash: signal 11"), std::string::npos);
    EXPECT_NE(result.edges[2].sentence.find("50 % of the pixels beyond it"), std::string::npos);
    EXPECT_NE(result.edges[1].sentence.find("not cpu64's on 25 % of the rays"), std::string::npos);
}

TEST(SweepEdge, isNoneWhereNothingIsCompared)
{
    const SweepResult result = runSweep(planOf("0..1:5"), kBackends, [](double v, const std::vector<std::string>&) {
        SweepRow row = rowOf(v, 60);
        if (v > 0.5) row.cells[0].errors[0].compared = 0;
        return row;
    });
    EXPECT_TRUE(result.edges.empty());
    EXPECT_EQ(nlohmann::json::parse(formatSweepJson(result))["values"].back()["backends"][0]["errors"].size(), 0u);
}

TEST(SweepEdge, ofANoiseToAndFroIsItsFirstAndItsLast)
{
    const SweepResult result =
        runSweep(planOf("0..10:11", true), kBackends, [](double v, const std::vector<std::string>&) {
            SweepRow row = rowOf(v, 60);
            row.cells[0].differs = std::fmod(v, 2) == 1 ? 0.1 : 0;
            return row;
        });
    ASSERT_EQ(result.edges.size(), 2u);
    EXPECT_EQ(result.edges[0].low, 0);
    EXPECT_EQ(result.edges[1].high, 10);
}

TEST(SweepEdge, namesAllBackendsThatJumpThere)
{
    const SweepResult result = runSweep(planOf("0..1:5"), kBackends, [](double v, const std::vector<std::string>&) {
        SweepRow row = rowOf(v, 60);
        for (SweepCell& cell : row.cells)
            cell.notFinite = v > 0.6 ? 1 : 0;
        return row;
    });
    ASSERT_EQ(result.edges.size(), 1u);
    EXPECT_NE(result.edges[0].sentence.find(" on cpu32, cpu64: "), std::string::npos) << result.edges[0].sentence;
}

TEST(SweepEdge, ofTheErrorAloneIsFoundWhereNothingElseJumps)
{
    const SweepResult jump = runSweep(planOf("0..1:11"), kBackends, [](double v, const std::vector<std::string>&) {
        SweepRow row = rowOf(v, 60);
        row.cells[0].errors[0].max = v < 0.42 ? 1e-5 : 1e-2;
        return row;
    });
    ASSERT_EQ(jump.edges.size(), 1u);
    EXPECT_EQ(jump.edges[0].kind, EdgeKind::kError);
    EXPECT_NEAR(jump.edges[0].low, 0.42, 2e-3);
    const SweepResult rounding = runSweep(planOf("0..1:11"), kBackends, [](double v, const std::vector<std::string>&) {
        SweepRow row = rowOf(v, 60);
        row.cells[0].errors[0].max = v < 0.42 ? 0 : 5e-6;
        return row;
    });
    EXPECT_TRUE(rounding.edges.empty());
}

TEST(Sweep, ofRefusedValuesAloneIsAnError)
{
    const std::string refusal = refusalOf([] {
        runSweep(planOf("0..1"), kBackends, [](double v, const std::vector<std::string>&) {
            return SweepRow{v, "no such index", false, {}, {}};
        });
    });
    EXPECT_NE(refusal.find("every value is refused: no such index"), std::string::npos);
}

TEST(SweepReport, hasEveryNumber)
{
    SweepResult result = runSweep(planOf("0.5..2.5:3"), kBackends, [](double v, const std::vector<std::string>&) {
        SweepRow row = rowOf(v, v < 0.866 ? 60 : 100);
        row.cells[0].errors[0].max = std::numeric_limits<double>::infinity();
        if (v > 2) row.refused = "a <bad> \"value\"", row.cells.clear();
        return row;
    });
    result.id = "ior";
    const auto json = nlohmann::json::parse(formatSweepJson(result));
    EXPECT_EQ(json["schema"], "crossray-sweep/1");
    EXPECT_EQ(json["values"][0]["backends"][0]["errors"][0]["max"], "inf");
    EXPECT_EQ(json["values"][0]["backends"][1]["classes"]["hit"], 0.6);
    EXPECT_EQ(json["values"].back()["refused"], "a <bad> \"value\"");
    EXPECT_EQ(json["edges"].size(), result.edges.size());
    const std::string csv = formatSweepCsv(result);
    EXPECT_EQ(
        csv.find(
            "\"material.ior\",at edge,backend,state,\"[1] RayDirWS against analytic refraction_box: max (degrees)\""),
        0u)
        << csv;
    EXPECT_NE(csv.find("\n0.5,0,cpu64,answered,1e-06,1e-06,0,0.6,0.4,0,0,0,0\n"), std::string::npos) << csv;
    EXPECT_NE(csv.find("\"refused: a <bad> \"\"value\"\"\""), std::string::npos) << csv;
    const std::string table = formatSweepTable(result);
    EXPECT_NE(table.find("refused: a <bad>"), std::string::npos);
    EXPECT_NE(table.find("edge: at material.ior 0.866"), std::string::npos) << table;
    const std::string svg = formatSweepSvg(result);
    EXPECT_NE(svg.find("a &lt;bad&gt;"), std::string::npos);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("inf "), std::string::npos);
    for (const char* part : {"RayDirWS against analytic refraction_box: degrees", "cpu32", "share of the rays"})
        EXPECT_NE(svg.find(part), std::string::npos) << part;
}

TEST(SweepList, isReadAndRefused)
{
    const auto read = [](const std::string& text) {
        const std::string file = testing::TempDir() + "sweep_list_test.toml";
        std::ofstream(file) << text;
        return readSweepList(file);
    };
    const std::string good = "[[sweep]]\nid = \"a\"\ntitle = \"T\"\ncase = \"c\"\nparameter = \"material.ior\"\n"
                             "range = \"0..1\"\nshows = \"S\"\nwhy = \"W\"\n";
    const std::vector<ListedSweep> sweeps = read(good + "set = { \"camera.depth\" = \"standard\" }\n");
    ASSERT_EQ(sweeps.size(), 1u);
    EXPECT_EQ(sweeps[0].overrides.at("camera.depth"), "standard");
    EXPECT_NE(refusalOf([&] { read(good + good); }).find("twice"), std::string::npos);
    EXPECT_NE(refusalOf([&] { read(good + "wy = 1\n"); }).find(":9:1: unknown key \"wy\""), std::string::npos);
    EXPECT_NE(refusalOf([&] { read("[[sweep]]\nid = \"a\"\n"); }).find("lacks \"title\""), std::string::npos);
    EXPECT_NE(refusalOf([&] { read("[[sweep]]\nid = 3\n"); }).find("a string is allowed"), std::string::npos);
    EXPECT_NE(refusalOf([&] { read("x = 3\n"); }).find("allowed: [[sweep]]"), std::string::npos);
}

// `crossray sweep --all -o reports/published/sweeps` has been run since the list was changed.
TEST(SweepList, isWhatIsPublished)
{
    namespace fs = std::filesystem;
    const fs::path source = CROSSRAY_SOURCE_DIR, folder = source / "reports/published/sweeps";
    std::ifstream stream(folder / "README.md");
    const std::string page{std::istreambuf_iterator<char>(stream), {}};
    std::set<std::string> ids;
    for (const ListedSweep& sweep : readSweepList(source / "cases/sweeps.toml")) {
        ids.insert(sweep.id);
        for (const char* extension : {".svg", ".csv"})
            EXPECT_TRUE(fs::is_regular_file(folder / (sweep.id + extension))) << sweep.id << extension;
        const size_t start = page.find("## " + sweep.title + "\n\n![" + sweep.title + "](" + sweep.id + ".svg)\n");
        ASSERT_NE(start, std::string::npos) << sweep.id;
        const std::string section = page.substr(start, page.find("\n## ", start) - start);
        for (const std::string& part : {"`crossray sweep " + sweep.testCase + " ", "(" + sweep.id + ".csv)",
                                        "\n**Shows.** " + sweep.shows + "\n", "\n**Why.** " + sweep.why + "\n"})
            EXPECT_NE(section.find(part), std::string::npos) << part << "\n" << section;
    }
    for (const auto& entry : fs::directory_iterator(folder)) {
        const std::string id = entry.path().stem().string();
        EXPECT_TRUE(id == "README" || ids.contains(id)) << entry.path();
    }
}
