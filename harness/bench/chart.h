// Charts of error against cost: both axes logarithmic, the Pareto front drawn, its points named, dominated ones pale.
// As SVG that needs nothing else, and as CSV and JSON.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace crossray {

struct ChartPoint {
    std::string name;
    double cost = 0;
    double error = 0;     // 0 gets a band of its own below the axis
    bool isBound = false; // no method, but a limit that none passes: drawn as a ring, no part of the front
    bool isOwn = false;   // a person's own: in a colour of its own, wherever it lies
};

struct Chart {
    std::string id;    // file name without extension
    std::string title; // family and scene
    std::string costLabel, errorLabel;
    std::vector<ChartPoint> points;
    bool isOfCurves = false; // points of one name are a curve, in order of cost; there is no front
};

// Which points no other dominates (cost and error both at most, one of them less). Bounds and values that are not
// finite are never on it; of equal points all are.
std::vector<bool> findParetoFront(std::span<const ChartPoint> points);

// Of a chart's points; none where it is of curves.
std::vector<bool> findChartFront(const Chart& chart);

std::string formatChartSvg(const Chart& chart);
std::string formatChartsCsv(std::span<const Chart> charts);
std::string formatChartsJson(std::span<const Chart> charts);

// Writes DIR/ID.svg of each chart; the folder is made. Throws InputError when a file cannot be written.
void writeCharts(const std::string& folder, std::span<const Chart> charts);
void writeTextFile(const std::string& path, const std::string& text); // throws InputError

// How often what was said to be so sure is right: the diagonal, and a dot for each bin of each series, its area by the
// number of hits.
struct ReliabilityDot {
    double confidence = 0, right = 0, count = 0;
};
struct ReliabilitySeries {
    std::string name;
    std::vector<ReliabilityDot> dots;
};
std::string formatReliabilitySvg(const std::string& title, std::span<const ReliabilitySeries> series);

} // namespace crossray
