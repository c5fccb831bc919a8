#include "harness/bench/chart.h"

#include "tests/unit/count_of.h"

#include <gtest/gtest.h>

#include <limits>

using namespace crossray;

TEST(Chart, TheFrontIsWhatNoPointDominates)
{
    const std::vector<ChartPoint> points{{"cheap", 1, 0.5},    {"worse", 2, 0.6},
                                         {"dear", 10, 0.01},   {"twin", 10, 0.01},
                                         {"dearer", 11, 0.01}, {"bound", 0.5, 0, true},
                                         {"none", 1e9, 0.001}, {"nan", std::numeric_limits<double>::quiet_NaN(), 0}};
    const std::vector<bool> front{true, false, true, true, false, false, true, false};
    EXPECT_EQ(findParetoFront(points), front);
}

TEST(Chart, EveryPointIsDrawnAndNamed)
{
    Chart chart{"id", "A < B & C", "reads a ray", "wrong share", {}};
    for (int i = 0; i < 12; ++i)
        chart.points.push_back({"method " + std::to_string(i), 1.0 + 3.0 * i, 0.5 / (1 + i)});
    chart.points.push_back({"exact", 100, 0});
    const std::string svg = formatChartSvg(chart);
    EXPECT_EQ(countOf(svg, "<circle"), 13U);
    for (const ChartPoint& point : chart.points)
        EXPECT_EQ(countOf(svg, ">" + point.name + "<"), 2U) << point.name << ": beside its dot, and under the pointer";
    EXPECT_NE(svg.find("A &lt; B &amp; C"), std::string::npos);
    EXPECT_NE(svg.find(">0</text>"), std::string::npos) << "the band of errors of 0";
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("inf"), std::string::npos);
}

TEST(Chart, NamesThatFindNoPlaceAreNumbered)
{
    Chart chart{"id", "crowd", "reads a ray", "wrong share", {{"far", 1, 1}}};
    for (int i = 0; i < 20; ++i)
        chart.points.push_back({"one of a crowd, " + std::to_string(i), 100 + 0.01 * i, 0.1});
    const std::string svg = formatChartSvg(chart);
    for (const ChartPoint& point : chart.points)
        EXPECT_EQ(countOf(svg, ">" + point.name + "<"), 2U) << point.name;
    const size_t keyed = countOf(svg, "font-weight=\"bold\"");
    EXPECT_GT(keyed, 8U);
    for (size_t i = 1; i <= keyed; ++i) {
        EXPECT_EQ(countOf(svg, "\"stroke\">" + std::to_string(i) + "</text>"), 1U) << i << " beside its dot";
        EXPECT_EQ(countOf(svg, "\"bold\">" + std::to_string(i) + "</tspan>"), 1U) << i << " in the key";
    }
    EXPECT_EQ(countOf(svg, "width=\"880\""), 0U) << "the key has a column of its own";
}

TEST(Chart, AChartOfNothingAndOfOnePointAreCharts)
{
    EXPECT_NE(formatChartSvg({"id", "empty", "", "", {}}).find("</svg>"), std::string::npos);
    const std::string one = formatChartSvg({"id", "one", "", "", {{"only", 1, 0}}});
    EXPECT_EQ(countOf(one, "<circle"), 1U);
    EXPECT_EQ(one.find("nan"), std::string::npos);
}

TEST(Chart, CurvesAreNamedOnceAndHaveNoFront)
{
    Chart chart{"id", "curves", "roughness", "error", {}, true};
    for (const double x : {0.1, 0.5, 1.0}) {
        chart.points.push_back({"one", x, 0.1 * x});
        chart.points.push_back({"two", x, 0.1 * x}); // on the same line
    }
    const std::string svg = formatChartSvg(chart);
    EXPECT_EQ(countOf(svg, "<circle"), 6U);
    EXPECT_EQ(countOf(svg, ">one<"), 1U);
    EXPECT_EQ(countOf(svg, ">two<"), 1U);
    EXPECT_EQ(formatChartsCsv(std::vector<Chart>{chart}).find(",1,0\n"), std::string::npos) << "no front";
}

TEST(Chart, NumbersComeAsCsvAndJson)
{
    const std::vector<Chart> charts{{"room", "Room", "ms", "share", {{"a", 2, 0.25}, {"b", 3, 0.5}}}};
    EXPECT_NE(formatChartsCsv(charts).find("room,\"a\",2,0.25,1,0\n"), std::string::npos);
    EXPECT_NE(formatChartsCsv(charts).find("room,\"b\",3,0.5,0,0\n"), std::string::npos);
    EXPECT_NE(formatChartsJson(charts).find("\"crossray-charts/1\""), std::string::npos);
    EXPECT_NE(formatChartsJson(charts).find("\"front\": false"), std::string::npos);
}

TEST(Chart, AReliabilityDiagramHasADotABin)
{
    const std::vector<ReliabilitySeries> series{{"a", {{0.5, 0.4, 100}, {0.9, 0.95, 10}}}, {"b", {{0.7, 0.7, 1}}}};
    EXPECT_EQ(countOf(formatReliabilitySvg("t", series), "fill-opacity"), 3U);
}
