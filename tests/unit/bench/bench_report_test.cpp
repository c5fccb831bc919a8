#include "harness/bench/bench_report.h"

#include <gtest/gtest.h>

#include <filesystem>

using namespace crossray;

namespace {

BenchPoint makePoint(const std::string& name, double error, double reads, double milliseconds)
{
    BenchPoint point;
    point.method = name;
    point.kind = name.substr(0, name.find(' '));
    for (const char* figure : {"Wrong", "Missed", "False", "HitDepth", "HitPositionSS"})
        point.errors[figure] = error;
    point.counters = {{"Fetches", reads}, {"FetchesOf32", 2 * reads}, {"Iterations", reads}, {"IterationsOf32", reads}};
    point.time = {milliseconds, 0.9 * milliseconds, 1.1 * milliseconds, milliseconds / 2};
    return point;
}

BenchResult makeResult()
{
    BenchScene scene;
    scene.name = "room";
    scene.effect = "reflection";
    scene.width = 64;
    scene.height = 36;
    scene.points = {makePoint("proxy box", 0.3, 1, 2), makePoint("hiz fine", 0.008, 30, 8),
                    makePoint("hiz coarse", 0.02, 20, 6), makePoint("hiz dear", 0.008, 40, 5)};
    BenchResult result;
    result.command = "crossray bench room";
    result.fingerprint = {"lavapipe", "Vulkan", "llvmpipe", "Mesa", "15", "cpu"};
    result.scenes = {scene};
    return result;
}

} // namespace

TEST(BenchReport, ABudgetIsBoundsOnErrors)
{
    const auto terms = parseBudget("HitDepth<=0.01,Missed<=5e-2");
    ASSERT_EQ(terms.size(), 2U);
    EXPECT_EQ(terms[0].error, "HitDepth");
    EXPECT_DOUBLE_EQ(terms[0].bound, 0.01);
    EXPECT_EQ(terms[1].error, "Missed");
    EXPECT_DOUBLE_EQ(terms[1].bound, 0.05);
    for (const char* bad : {"", "HitDepth", "HitDepth<0.1", "HitDepth<=", "<=1", "HitDepth<=x", "HitDepth<=-1",
                            "HitDepth<=1,", "HitDepth<=nan"})
        EXPECT_THROW(parseBudget(bad), InputError) << bad;
}

TEST(BenchReport, AdviceIsTheCheapestWithinTheBudget)
{
    const BenchScene scene = makeResult().scenes[0];
    EXPECT_EQ(chooseMethod(scene, parseBudget("HitDepth<=0.5"))->method, "proxy box");
    EXPECT_EQ(chooseMethod(scene, parseBudget("HitDepth<=0.05"))->method, "hiz coarse");
    EXPECT_EQ(chooseMethod(scene, parseBudget("HitDepth<=0.01"))->method, "hiz fine") << "by reads, not by time";
    EXPECT_EQ(chooseMethod(scene, parseBudget("HitDepth<=0.5,Missed<=0.01"))->method, "hiz fine");
    EXPECT_EQ(chooseMethod(scene, parseBudget("HitDepth<=0.001")), nullptr);
    EXPECT_THROW(chooseMethod(scene, parseBudget("Beauty<=1")), InputError);
}

TEST(BenchReport, WhatIsWrittenIsRead)
{
    const BenchResult result = makeResult();
    const std::string file = "bench_report_test.json";
    writeTextFile(file, formatBenchJson(result));
    const BenchResult read = readBenchJson(file);
    EXPECT_EQ(read.command, result.command);
    EXPECT_EQ(read.fingerprint.cpu, "cpu");
    ASSERT_EQ(read.scenes.size(), 1U);
    ASSERT_EQ(read.scenes[0].points.size(), 4U);
    EXPECT_EQ(read.scenes[0].points[1].errors, result.scenes[0].points[1].errors);
    EXPECT_EQ(read.scenes[0].points[1].counters, result.scenes[0].points[1].counters);
    EXPECT_TRUE(compareBenches(read, result, 0.05).empty());
    writeTextFile(file, "{}");
    EXPECT_THROW(readBenchJson(file), InputError);
    EXPECT_THROW(readBenchJson("no such file"), InputError);
    std::filesystem::remove(file);
    EXPECT_NE(formatBenchCsv(result).find("\"room\",\"hiz fine\",hiz,Fetches,30\n"), std::string::npos);
    EXPECT_NE(formatBenchTable(result.scenes[0]).find("hiz coarse"), std::string::npos);
}

TEST(BenchReport, ComparisonTellsMovesFromLosses)
{
    const BenchResult before = makeResult();
    BenchResult after = before;
    after.scenes[0].points[0].counters["Fetches"] = 1.01; // moved, and no loss
    auto changes = compareBenches(before, after, 0.05);
    ASSERT_EQ(changes.size(), 1U);
    EXPECT_FALSE(changes[0].isLoss);
    after.scenes[0].points[0].counters["Fetches"] = 1.1;
    EXPECT_TRUE(compareBenches(before, after, 0.05)[0].isLoss);
    EXPECT_FALSE(compareBenches(before, after, 0.2)[0].isLoss);
    after = before;
    after.scenes[0].points[2].errors["HitDepth"] = 0.01; // better
    ASSERT_EQ(compareBenches(before, after, 0.05).size(), 1U);
    EXPECT_FALSE(compareBenches(before, after, 0.05)[0].isLoss);
    after = before;
    after.scenes[0].points.pop_back();
    EXPECT_TRUE(compareBenches(before, after, 0.05)[0].isLoss);
}

TEST(BenchReport, TimesAreLostOnlyApartFromTheirSpreadOnOneDevice)
{
    const BenchResult before = makeResult();
    BenchResult after = before;
    after.scenes[0].points[1].time = {8.8, 8.0, 9.6, 4.4}; // its fastest is within what was seen before
    EXPECT_TRUE(compareBenches(before, after, 0.05).empty());
    after.scenes[0].points[1].time = {16, 15, 17, 8};
    ASSERT_EQ(compareBenches(before, after, 0.05).size(), 1U);
    EXPECT_TRUE(compareBenches(before, after, 0.05)[0].isLoss);
    after.fingerprint.cpu = "another";
    ASSERT_EQ(compareBenches(before, after, 0.05).size(), 1U);
    EXPECT_FALSE(compareBenches(before, after, 0.05)[0].isLoss);
}

TEST(BenchReport, EachSceneHasItsCharts)
{
    const std::vector<Chart> charts = makeBenchCharts(makeResult());
    ASSERT_EQ(charts.size(), 2U);
    EXPECT_EQ(charts[0].points.size(), 4U);
    EXPECT_TRUE(charts[1].points.back().isBound);
    EXPECT_EQ(charts[0].id, "projection_room");
}
