// The figures of the yardstick as files.
#pragma once

#include "harness/bench/chart.h"
#include "harness/bench/tracer_yardstick.h"

#include <string>

namespace crossray {

// Options that are JSON's head; `scene` is a case's name where one was measured, else empty.
struct TracerReportHead {
    YardstickOptions options;
    double thickness = 0;
    std::string scene;
    std::vector<std::string> own; // names of the person's own tracers
};

std::string formatTracerJson(const TracerReportHead& head, std::span<const MeasuredTracer> rows);
// One line a tracer: the means, then the worst scene's figures.
std::string formatTracerCsv(std::span<const MeasuredTracer> rows);

// Wrong answers against reads, against the reads of the slowest of 32 neighbours, and missed against false hits.
std::vector<Chart> makeTracerCharts(const TracerReportHead& head, std::span<const MeasuredTracer> rows);
// Of the first tracer that has a confidence: SVG.
std::string formatTracerReliability(const TracerReportHead& head, std::span<const MeasuredTracer> rows);

} // namespace crossray
